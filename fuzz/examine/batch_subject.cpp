#include "fuzz/examine/batch_subject.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <lorentz/certified_batch.hpp>

namespace lorentz::fuzz {
namespace {

bool same_bits(const Flight& a, const Flight& b) {
  return a.outcome == b.outcome && a.stage == b.stage && a.time_is_rounded == b.time_is_rounded &&
         a.lattice == b.lattice && a.atom == b.atom && a.cell == b.cell &&
         std::memcmp(&a.time, &b.time, sizeof a.time) == 0;
}

// Gathers queries until their replies are wanted, or the scene changes.
template <class Engine>
class GatheringSubject : public Subject {
 public:
  void ask(const Query& query) final { ask_until(query, std::numeric_limits<double>::infinity()); }
  void ask_until(const Query& query, double max_time) final {
    const bool fits = table_.push_back(query, max_time);
    if (fits && engine_) return;
    fly();  // first those before
    table_.clear();
    replies_.push_back(engine_ ? alone(query, max_time) : Reply{Answer::unsupported_because(why_not_)});
  }
  std::vector<Reply> replies() final {
    fly();
    return std::exchange(replies_, {});
  }
  // As many as fill some vectors, and some lanes of one more.
  std::uint64_t batch_size() const final { return 100; }

 protected:
  const Engine& engine() const { return *engine_; }

 private:
  virtual Reply alone(const Query& query, double max_time) const = 0;
  virtual void fly_together(const QueryTable& table, std::vector<Reply>& replies) = 0;
  virtual std::optional<std::string> beyond(const Scene& scene) const = 0;

  void fly() {
    if (engine_ && table_.size() > 0) fly_together(table_, replies_);
    table_.clear();
  }
  void change_scene(const Scene& scene) final {
    fly();
    const auto why_not = beyond(scene);
    why_not_ = why_not.value_or("");
    engine_.reset();
    if (!why_not) engine_.emplace(scene);
  }

  std::optional<Engine> engine_;
  std::string why_not_;
  QueryTable table_;
  std::vector<Reply> replies_;
};

Flight fly_alone(const Batch& batch, const Query& query, double max_time, Batch::Time time) {
  return batch.one_at_a_time().fly(query, max_time, time);
}

class BatchSubject final : public GatheringSubject<Batch> {
 public:
  explicit BatchSubject(FlyAlone alone) : fly_alone_(std::move(alone)) {}
  bool takes_limits() const override { return true; }

 private:
  Reply alone(const Query& query, double max_time) const override {
    const Flight flight = engine().one_at_a_time().fly(query, max_time);
    return {answer_of(flight), {}, flight.stage};
  }
  std::optional<std::string> beyond(const Scene& scene) const override { return Reduction::beyond(scene); }

  void fly_together(const QueryTable& table, std::vector<Reply>& replies) override {
    flights_.resize(table.size()), rounded_.resize(table.size());
    engine().fly(table.columns(), flights_.columns());
    engine().fly(table.columns(), rounded_.columns(), Batch::Time::rounded);
    const QueryColumns columns = table.columns();
    for (std::size_t i = 0; i < table.size(); ++i) {
      const Query query = table[i];
      const double max_time = columns.max_time ? columns.max_time[i] : HUGE_VAL;
      const Flight flight = flights_[i];
      const bool same = same_bits(flight, fly_alone_(engine(), query, max_time, Batch::Time::close)) &&
                        same_bits(rounded_[i], fly_alone_(engine(), query, max_time, Batch::Time::rounded));
      if (same)
        replies.push_back({answer_of(flight), {}, flight.stage});
      else
        replies.push_back({Answer::error("a single flight has another answer"), {}, flight.stage});
    }
  }

  FlyAlone fly_alone_;
  FlightTable flights_, rounded_;
};

class CertifiedBatchSubject final : public GatheringSubject<oracle::CertifiedBatch> {
 public:
  bool takes_limits() const override { return true; }

 private:
  Reply alone(const Query& query, double max_time) const override {
    oracle::Request request;
    if (std::isfinite(max_time)) request.max_time = max_time;
    return {engine().one_at_a_time().first_hit(query, request), {}, Stage::undecided};
  }
  std::optional<std::string> beyond(const Scene&) const override { return std::nullopt; }

  void fly_together(const QueryTable& table, std::vector<Reply>& replies) override {
    flights_.resize(table.size());
    const QueryColumns columns = table.columns();
    engine().first_hits(columns, flights_.columns(), uncertain_);
    std::size_t next = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
      if (next < uncertain_.size() && uncertain_[next] == i) {
        ++next;
        replies.push_back(alone(table[i], columns.max_time ? columns.max_time[i] : HUGE_VAL));
      } else {
        const Flight flight = flights_[i];
        replies.push_back({answer_of(flight), {}, flight.stage});
      }
    }
  }

  FlightTable flights_;
  std::vector<std::size_t> uncertain_;
};

}  // namespace

std::unique_ptr<Subject> make_batch_subject(FlyAlone alone) {
  return std::make_unique<BatchSubject>(alone ? std::move(alone) : fly_alone);
}

std::unique_ptr<Subject> make_certified_batch_subject() {
  return std::make_unique<CertifiedBatchSubject>();
}

}  // namespace lorentz::fuzz
