// The engines of this program as answerers.
#include <algorithm>
#include <optional>
#include <vector>

#include "question/scene_engine.hpp"

namespace lorentz::question {
namespace {

class OwnAnswerer final : public Answerer {
 public:
  OwnAnswerer(const Traits& traits, MakeSceneEngine make, const AnswererOptions& options)
      : traits_(traits), make_(std::move(make)), request_(options.request), jobs_(options.jobs) {}

  void ask(const Id& id, const Query& query) override { ask_until(id, query, kForEver); }

  void ask_until(const Id&, const Query& query, double max_time) override {
    const double limit = std::min(max_time, limit_of(request_));
    if (!gathers_) return ask_alone(query, limit);
    if (!queries_.push_back(query, limit)) {  // `from` is too far away for the columns
      drain();
      ask_alone(query, limit);
    } else if (queries_.size() == 2 * traits_.together) {
      drain();
    }
  }

  bool takes_limits() const override { return traits_.takes_limits; }
  // Several full vectors, and some lanes of one more.
  std::uint64_t batch_size() const override { return traits_.together > 0 ? 100 : 1; }

  void drain() override {
    if (queries_.size() == 0) return;
    flights_.resize(queries_.size());
    const QueryColumns columns = queries_.columns();
    engine_->fly_together(columns, flights_.columns(), rest_, jobs_);
    const bool flights_are_enough = !request_.detail && request_.digits == 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      const bool is_left = next < rest_.size() && rest_[next] == i;
      next += is_left;
      const Flight flight = flights_[i];
      if (flights_are_enough && !is_left && flight.outcome != Outcome::error)
        deliver({.answer = answer_of(flight), .stage = flight.stage});
      else
        ask_alone(queries_[i], columns.max_time.empty() ? kForEver : columns.max_time[i]);
    }
    queries_.clear();
  }

 private:
  void enter(const Scene& scene) override {
    drain();
    engine_.emplace(make_(scene));
    gathers_ = traits_.together > 0 && engine_->flies_together();
  }

  void ask_alone(const Query& query, double limit) {
    oracle::Request request = request_;
    if (limit < kForEver) request.max_time = limit;
    engine_->ask(query, request, reply_);
    deliver(reply_);
  }

  const Traits traits_;
  const MakeSceneEngine make_;
  const oracle::Request request_;
  const int jobs_;
  std::optional<SceneEngine> engine_;
  bool gathers_ = false;
  QueryTable queries_;
  FlightTable flights_;
  std::vector<std::size_t> rest_;
  Reply reply_;
};

}  // namespace

std::unique_ptr<Answerer> own_answerer(const Traits& traits, MakeSceneEngine make,
                                       const AnswererOptions& options) {
  return std::make_unique<OwnAnswerer>(traits, std::move(make), options);
}

}  // namespace lorentz::question
