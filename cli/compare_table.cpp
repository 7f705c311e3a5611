#include "cli/compare_table.hpp"

#include <fmt/format.h>

#include <lorentz/margin.hpp>
#include "cli/numbers.hpp"
#include "cli/table.hpp"

namespace lorentz::cli {

using namespace compare;

double tolerance(const std::optional<std::string>& text) {
  const double ulps = positive_number(text, "--ulps").value_or(oracle::kDefaultUlps);
  if (ulps > oracle::kLargestMargin)
    throw InputError(
        fmt::format("--ulps: {} is above {}, up to which margins are known", ulps, oracle::kLargestMargin));
  return ulps;
}

namespace {

std::string share(std::size_t part, std::size_t whole) {
  if (part == 0 || whole == 0) return std::to_string(part);
  return fmt::format("{} ({:.3g} %)", part, 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string nanoseconds(double ns) {
  return ns == 0 ? "-" : fmt::format("{:.0f}", ns);
}

}  // namespace

std::string table_of(const std::vector<Tally>& tallies, bool judged) {
  if (!judged) {
    Table table({"engine", "queries", "ns/query", "ns median"});
    for (const Tally& t : tallies)
      table.add({t.name, std::to_string(t.queries), nanoseconds(t.ns_per_query), nanoseconds(t.ns_median)});
    return table.text();
  }
  Table table({"engine", "queries", "agree", "ill-posed", "wrong", "in time only", "undecided", "unsupported",
               "error", "missing", "max ulp", "mean ulp", "ns/query", "ns median"});
  for (const Tally& t : tallies) {
    const std::size_t judged_answers = t.agree + t.ill_posed + t.wrong;
    table.add({t.name, std::to_string(t.queries), std::to_string(t.agree), std::to_string(t.ill_posed),
               share(t.wrong, judged_answers), std::to_string(t.wrong_time), std::to_string(t.undecided),
               std::to_string(t.unsupported), std::to_string(t.error), std::to_string(t.missing),
               t.timed_hits ? fmt::format("{:.3g}", t.max_ulp) : "-",
               t.timed_hits ? fmt::format("{:.3g}", t.mean_ulp()) : "-", nanoseconds(t.ns_per_query),
               nanoseconds(t.ns_median)});
  }
  return table.text();
}

}  // namespace lorentz::cli
