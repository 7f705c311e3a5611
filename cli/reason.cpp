#include "cli/reason.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lorentz::cli {
namespace {

std::string margin_text(double margin) {
  return margin >= oracle::kLargestMargin ? "2^20 ulps or more" : fmt::format("{:.6g} ulps", margin);
}

bool names_obstacle(const Answer& answer) {
  return answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
}

Dispute about_start(const oracle::Approach& approach, const ObstacleId& obstacle, const std::string& name) {
  const char* side = approach.start_gap < 0 ? "inside" : "outside of";
  return {obstacle, approach.start_gap,
          fmt::format("x lies {} {} by {:.6g} of its radii", side, name, std::fabs(approach.start_gap))};
}

Dispute about_line(const oracle::Approach& approach, const ObstacleId& obstacle, const std::string& name,
                   const char* then) {
  const char* does = approach.gap < 0 ? "meets" : "misses";
  return {obstacle, approach.gap,
          fmt::format("the line {} {} by {:.6g} of its radii{}", does, name, std::fabs(approach.gap), then)};
}

}  // namespace

std::string name_of(const ObstacleId& obstacle, int dimension) {
  std::string cell;
  for (int i = 0; i < dimension; ++i) cell += (i ? ", " : "") + obstacle.cell[i].decimal();
  return fmt::format("lattice {}, atom {}, cell ({})", obstacle.lattice, obstacle.atom, cell);
}

std::string decision_text(const oracle::HardestDecision& decision, int dimension) {
  const std::string name = name_of(decision.obstacle, dimension);
  if (decision.margin >= oracle::kLargestMargin)
    return "No decision is hard: inputs moved by 2^20 ulps give the same answer (to first order).";
  const std::string answer =
      fmt::format("{}, by {}.", decision.yes ? "Yes" : "No", margin_text(decision.margin));
  switch (decision.kind) {
    case oracle::DecisionKind::containing:
      return fmt::format("The hard decision: does {} contain x? {}", name, answer);
    case oracle::DecisionKind::meeting:
      return fmt::format("The hard decision: does the line meet {}? {}", name, answer);
    case oracle::DecisionKind::order:
      return fmt::format("The hard decision: is {} entered before the obstacle that is hit? No, by {}.", name,
                         margin_text(decision.margin));
  }
  return "";
}

std::optional<Dispute> dispute_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                                  const Answer& exact, const Answer& given) {
  const auto exists = [&](const ObstacleId& id) { return !flaw_of(Query{query.x, query.v, id}, scene); };
  if (names_obstacle(given) && exists(given.obstacle) &&
      (given.outcome != exact.outcome || given.obstacle != exact.obstacle)) {
    const oracle::Approach approach = margins.approach(query, given.obstacle);
    const std::string name = name_of(given.obstacle, scene.dimension);
    if (given.outcome == Outcome::inside && approach.start_gap >= 0)
      return about_start(approach, given.obstacle, name);
    if (given.outcome == Outcome::hit && approach.gap >= 0)
      return about_line(approach, given.obstacle, name, "");
    if (given.outcome == Outcome::hit && approach.start_gap >= 0 && !approach.ahead)
      return Dispute{given.obstacle, approach.gap, name + " lies behind the start"};
  }
  if (!names_obstacle(exact) ||
      (names_obstacle(given) && given.outcome == exact.outcome && given.obstacle == exact.obstacle))
    return std::nullopt;
  const oracle::Approach approach = margins.approach(query, exact.obstacle);
  const std::string name = name_of(exact.obstacle, scene.dimension);
  if (exact.outcome == Outcome::inside) return about_start(approach, exact.obstacle, name);
  const bool later = given.outcome == Outcome::hit;
  return about_line(approach, exact.obstacle, name, later ? ", and enters it first" : "");
}

std::string reason_of(const oracle::Margins& margins, const Scene& scene, const Query& query,
                      const Answer& exact, const Answer& given, const std::string& indent) {
  const auto dispute = dispute_of(margins, scene, query, exact, given);
  if (!dispute) return "";
  std::string text = indent + dispute->text + '\n';
  if (const auto decision = margins.hardest_decision(query, exact))
    text += indent + decision_text(*decision, scene.dimension) + '\n';
  return text;
}

}  // namespace lorentz::cli
