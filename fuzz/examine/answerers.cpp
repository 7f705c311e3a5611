#include "fuzz/examine/answerers.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <lorentz/engine.hpp>
#include <lorentz/walk.hpp>
#include "question/batch_answerer.hpp"
#include "question/examine.hpp"
#include "src/engines/published/published.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::fuzz {

using question::Answerer;
using question::Reply;

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Answers one query of a scene, and adds what else the engine reports.
using Tell = std::function<Reply(const Query&, double max_time)>;

class TellingAnswerer final : public Answerer {
 public:
  TellingAnswerer(std::function<Tell(const Scene&)> make, bool takes_limits)
      : make_(std::move(make)), takes_limits_(takes_limits) {}
  void ask(const Id&, const Query& query) override { deliver(tell_(query, kNoLimit)); }
  void ask_until(const Id&, const Query& query, double max_time) override { deliver(tell_(query, max_time)); }
  bool takes_limits() const override { return takes_limits_; }

 private:
  void enter(const Scene& scene) override { tell_ = make_(scene); }

  const std::function<Tell(const Scene&)> make_;
  const bool takes_limits_;
  Tell tell_;
};

// An engine that does not support every scene; E::beyond says why not.
template <class E>
Tell if_it_does(const Scene& scene, const std::function<Reply(const E&, const Query&, double)>& tell) {
  if (const auto why_not = E::beyond(scene))
    return [why_not](const Query&, double) { return Reply{Answer::unsupported_because(*why_not)}; };
  const auto engine = std::make_shared<const E>(scene);
  return [engine, tell](const Query& query, double max_time) { return tell(*engine, query, max_time); };
}

// Walks from cell to cell, up to a time in which the flight passes about this many cells: a longer flight
// takes seconds, in which the engine could answer thousands of others.
Tell tell_classical(const Scene& scene) {
  constexpr double kCells = 10'000;
  const std::shared_ptr<const Engine> engine = make_engine("classical", scene);
  return [engine, u = scene.lattices[0].vectors[0]](const Query& query, double) -> Reply {
    const Vec& v = query.v;
    const double cells = std::hypot(u[0], u[1], u[2]) / std::hypot(v[0], v[1], v[2]);
    return {engine->first_hit(query, kCells * cells)};
  };
}

// Walks cell by cell, too, but exactly; flights through more cells than this are left undecided.
Tell tell_walk(const Scene& scene) {
  constexpr std::int64_t kCells = 200;
  const auto walk = std::make_shared<const oracle::Walk>(scene, kCells);
  return [walk](const Query& query, double max_time) -> Reply { return {walk->first_hit(query, max_time)}; };
}

// Reports the number of passes as the work of an answer.
Tell tell_published(const Scene& scene) {
  return if_it_does<Published>(
      scene, [](const Published& engine, const Query& query, double max_time) -> Reply {
        Proposals proposals;
        Answer answer = engine.first_hit_counted(query, max_time, proposals);
        return {.answer = std::move(answer), .work = static_cast<double>(proposals.passes)};
      });
}

Tell tell_certified(const Scene& scene) {
  const auto engine = std::make_shared<const oracle::Certified>(scene);
  return [engine](const Query& query, double max_time) -> Reply {
    StageTally tally;
    oracle::Request request;
    if (std::isfinite(max_time)) request.max_time = max_time;
    Answer answer = engine->first_hit(query, request, &tally);
    const Stage stage = tally.binary64        ? Stage::binary64
                        : tally.double_double ? Stage::double_double
                                              : Stage::undecided;
    return {.answer = std::move(answer), .stage = stage};
  };
}

Flight fly_prepared(const Reduction& engine, const Query& query, double max_time) {
  return engine.fly(engine.direction(query.v), query.x, query.from ? &*query.from : nullptr, max_time);
}

Flight fly_alone(const Batch& batch, const Query& query, double max_time, Batch::Time time) {
  return batch.one_at_a_time().fly(query, max_time, time);
}

bool same_bits(const Flight& a, const Flight& b) {
  return a.outcome == b.outcome && a.stage == b.stage && a.time_is_rounded == b.time_is_rounded &&
         a.lattice == b.lattice && a.atom == b.atom && a.cell == b.cell &&
         std::memcmp(&a.time, &b.time, sizeof a.time) == 0;
}

class BatchBothWays final : public question::BatchAnswerer {
 public:
  explicit BatchBothWays(FlyAlone alone) : BatchAnswerer(false, {}), alone_(std::move(alone)) {}

 private:
  void fly() override {
    BatchAnswerer::fly();
    rounded_.resize(queries().size());
    if (batch()) batch()->fly(queries().columns(), rounded_.columns(), Batch::Time::rounded);
  }
  Reply reply_to(std::size_t i) const override {
    if (!batch()) return BatchAnswerer::reply_to(i);
    const Query query = queries()[i];
    if (!same_bits(flight(i), alone_(*batch(), query, limit(i), Batch::Time::close)) ||
        !same_bits(rounded_[i], alone_(*batch(), query, limit(i), Batch::Time::rounded)))
      return {.answer = Answer::error("a single flight has another answer"), .stage = flight(i).stage};
    return {.answer = answer_of(flight(i)), .stage = flight(i).stage};
  }

  const FlyAlone alone_;
  FlightTable rounded_;
};

}  // namespace

std::unique_ptr<Answerer> reduction_both_ways(FlyPrepared prepared) {
  if (!prepared) prepared = fly_prepared;
  const auto tell = [prepared](const Reduction& engine, const Query& query, double max_time) -> Reply {
    const Flight flight = engine.fly(query, max_time);
    Answer answer = answer_of(flight);
    const bool same = same_answer(answer, answer_of(prepared(engine, query, max_time)));
    if (!same) answer = Answer::error("a prepared direction gives another answer");
    return {.answer = std::move(answer), .stage = flight.stage};
  };
  return std::make_unique<TellingAnswerer>(
      [tell](const Scene& scene) { return if_it_does<Reduction>(scene, tell); }, true);
}

std::unique_ptr<Answerer> batch_both_ways(FlyAlone alone) {
  return std::make_unique<BatchBothWays>(alone ? std::move(alone) : fly_alone);
}

question::MakeAnswerer answerer_maker(const question::EngineInfo& engine,
                                      const question::AnswererOptions& options) {
  if (engine.name == "reduction") return [](const auto&) { return reduction_both_ways(); };
  if (engine.name == "batch") return [](const auto&) { return batch_both_ways(); };
  constexpr struct {
    const char* engine;
    Tell (*tell)(const Scene&);
    bool takes_limits;
  } kTelling[] = {{"classical", tell_classical, false},
                  {"published", tell_published, false},
                  {"certified", tell_certified, true},
                  {"walk", tell_walk, true}};
  for (const auto& one : kTelling)
    if (one.engine == engine.name)
      return [one](const auto&) { return std::make_unique<TellingAnswerer>(one.tell, one.takes_limits); };
  return [engine, options](const std::function<bool()>& enough) {
    question::AnswererOptions its = options;
    its.enough = enough;
    return engine.answerer(its);
  };
}

std::vector<Reply> replies_to(const question::Source& source, Answerer& answerer) {
  std::vector<Reply> replies;
  std::vector<std::pair<std::size_t, question::Question>> not_asked;
  question::ask_all(source, answerer, [&](const question::Question& question, Reply& reply) {
    if (!reply.was_asked()) not_asked.emplace_back(replies.size(), question);
    replies.push_back(std::move(reply));
  });
  for (const auto& [i, question] : not_asked) {
    if (answerer.is_hopeless()) break;
    answerer.try_again();
    question::ask_all(question::all_of({&question, 1}), answerer,
                      [&, i = i](const question::Question&, Reply& reply) { replies[i] = std::move(reply); });
    if (!replies[i].was_asked()) break;  // the time is over
  }
  return replies;
}

}  // namespace lorentz::fuzz
