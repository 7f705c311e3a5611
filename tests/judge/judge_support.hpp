// Orders, questions and engines for the tests of examinations.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lorentz/oracle.hpp>
#include "judge/examination.hpp"
#include "question/starts/free_starts.hpp"
#include "tests/support/support.hpp"

namespace lorentz::test {

/// An order to judge this engine, in which silence is a fault.
inline judge::JudgeOrder order_of(const question::EngineInfo& engine,
                                  std::optional<std::size_t> questions = {}) {
  judge::JudgeOrder order;
  order.engine = engine, order.questions = questions, order.timeout = 60;
  return order;
}

/// Drawn questions of each of these scenes in turn, in the square or cubic lattice.
inline judge::Source drawn_in(const std::vector<int>& dimensions, std::size_t number,
                              std::uint64_t seed = 20161115) {
  const auto all = std::make_shared<std::vector<question::Question>>();
  for (const int dimension : dimensions) {
    const auto place = std::make_shared<question::Place>(unit_scene(dimension, 0.25));
    for (const Query& query : starts::free_starts(place->scene(), starts::Kind::uniform, seed, number))
      all->push_back({.place = place,
                      .query = query,
                      .exact = place->exact(query),
                      .where = "seed " + std::to_string(seed)});
  }
  return [=, next = std::size_t{0}]() mutable -> std::optional<question::Question> {
    while (next < all->size() && (*all)[next].place->is_beyond_engine()) ++next;
    return next < all->size() ? std::optional((*all)[next++]) : std::nullopt;
  };
}

/// An engine of ours that is exact but for what a fault makes of its answers; of `error` to an invalid query, too.
class Faulty final : public question::Answerer {
 public:
  using Fault = std::function<void(const Scene&, const Query&, double max_time, Answer&)>;
  explicit Faulty(Fault fault) : fault_(std::move(fault)) {}
  void ask(const Id& id, const Query& query) override { ask_until(id, query, HUGE_VAL); }
  void ask_until(const Id&, const Query& query, double max_time) override {
    answer(query, max_time, oracle_->first_hit(query));
  }
  void ask_text(const Id&, const std::string&) override { answer({}, HUGE_VAL, Answer::error("no query")); }

 private:
  void enter(const Scene& scene) override { oracle_.emplace(scene); }
  void answer(const Query& query, double max_time, Answer answer) {
    fault_(scene(), query, max_time, answer);
    deliver({answer});
  }

  Fault fault_;
  std::optional<oracle::Oracle> oracle_;
};

inline question::EngineInfo guest(const std::string& name, const Faulty::Fault& fault) {
  return question::guest_engine(
      name, [=](const question::AnswererOptions&) { return std::make_unique<Faulty>(fault); });
}

}  // namespace lorentz::test
