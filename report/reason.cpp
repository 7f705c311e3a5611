#include "report/reason.hpp"

#include <fmt/format.h>

#include <cmath>

#include <lorentz/verdict.hpp>
#include "src/exchange/exchange_write.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::report {
namespace {

Dispute about_start(const oracle::Approach& approach, const std::string& name) {
  const char* side = approach.start_gap < 0 ? "inside" : "outside of";
  return {approach.start_gap,
          fmt::format("x lies {} {} by {:.6g} of its radii", side, name, std::fabs(approach.start_gap))};
}

Dispute about_line(const oracle::Approach& approach, const std::string& name, const char* then) {
  const char* does = approach.gap < 0 ? "meets" : "misses";
  return {approach.gap,
          fmt::format("the line {} {} by {:.6g} of its radii{}", does, name, std::fabs(approach.gap), then)};
}

}  // namespace

std::string ulps_text(double ulps) {
  return ulps < oracle::kLargestMargin ? fmt::format("{:.6g} ulps", ulps) : "2^20 ulps or more";
}

std::string name_of(const ObstacleId& obstacle, const Components& count) {
  return fmt::format("lattice {}, atom {}, cell ({})", obstacle.lattice, obstacle.atom,
                     decimals(components(obstacle.cell, count.of_cells(obstacle.lattice))));
}

std::string decision_text(const oracle::HardestDecision& decision, const Components& count) {
  const std::string name = name_of(decision.obstacle, count);
  if (decision.margin >= oracle::kLargestMargin)
    return "No decision is hard: inputs moved by 2^20 ulps give the same answer (to first order).";
  const std::string answer =
      fmt::format("{}, by {}.", decision.yes ? "Yes" : "No", ulps_text(decision.margin));
  switch (decision.kind) {
    case oracle::DecisionKind::containing:
      return fmt::format("The hard decision: does {} contain x? {}", name, answer);
    case oracle::DecisionKind::meeting:
      return fmt::format("The hard decision: does the line meet {}? {}", name, answer);
    case oracle::DecisionKind::order:
      return fmt::format("The hard decision: is {} entered before the obstacle that is hit? No, by {}.", name,
                         ulps_text(decision.margin));
  }
  return "";
}

namespace {

// The case that the answer is wrong because of the obstacle that it names.
std::optional<Dispute> about_named(const oracle::Approach& approach, const Answer& given,
                                   const std::string& name, bool is_left) {
  if (is_left) return Dispute{approach.start_gap, name + " is the obstacle that the flight leaves"};
  if (given.outcome == Outcome::inside)
    return approach.start_gap >= 0 ? std::optional(about_start(approach, name)) : std::nullopt;
  if (approach.start_gap >= 0 && !approach.ahead)
    return Dispute{approach.start_gap, name + " lies behind the start"};
  return approach.gap >= 0 ? std::optional(about_line(approach, name, "")) : std::nullopt;
}

}  // namespace

std::optional<Dispute> dispute_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                                  const Answer& exact, const Answer& given,
                                  const std::optional<ObstacleId>& decisive) {
  const bool names = names_obstacle(given, query, scene);
  if (names && given.outcome == exact.outcome && given.obstacle == exact.obstacle) return std::nullopt;
  if (names && decisive.value_or(given.obstacle) == given.obstacle)
    if (auto dispute = about_named(margins.approach(query, given.obstacle), given,
                                   name_of(given.obstacle, scene), query.from == given.obstacle))
      return dispute;
  if (!names_obstacle(exact)) return std::nullopt;
  const ObstacleId& obstacle = decisive ? *decisive : exact.obstacle;
  const oracle::Approach approach = margins.approach(query, obstacle);
  const std::string name = name_of(obstacle, scene);
  if (exact.outcome == Outcome::inside && approach.start_gap < 0) return about_start(approach, name);
  const bool later = given.outcome == Outcome::hit;
  const char* before = obstacle == exact.obstacle ? ", and enters it first" : ", and enters it earlier";
  return about_line(approach, name, later ? before : "");
}

std::optional<ObstacleId> decisive_of(const Scene& scene, const Query& query, const Answer& exact,
                                      const Answer& given, const Claim& claim) {
  if (!names_obstacle(exact)) return std::nullopt;
  return oracle::Judge(scene, claim).judge(query, exact, given).obstacle;
}

std::vector<std::string> reason_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                                   const Answer& exact, const Answer& given,
                                   const std::optional<ObstacleId>& decisive) {
  const auto dispute = dispute_of(margins, scene, query, exact, given, decisive);
  if (!dispute) return {};
  std::vector<std::string> lines{dispute->text};
  if (const auto decision = margins.hardest_decision(query, exact))
    lines.push_back(decision_text(*decision, scene));
  return lines;
}

}  // namespace lorentz::report
