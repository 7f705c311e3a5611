#include "cli/compare_table.hpp"

#include <fmt/format.h>

#include "report/share.hpp"
#include "report/table.hpp"

namespace lorentz::cli {

using namespace question;

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
    report::Table table({"engine", "queries", "ns/query", "ns median"});
    for (const Tally& t : tallies)
      table.add({t.name, std::to_string(t.queries), nanoseconds(t.speed.ns_per_query),
                 nanoseconds(t.speed.ns_median)});
    return table.text();
  }
  report::Table table({"engine", "queries", "agree", "ill-posed", "wrong", "wrong time", "undecided",
                       "unsupported", "error", "missing", "max ulp", "mean ulp", "ns/query", "ns median"});
  for (const Tally& t : tallies) {
    const std::size_t answers = t.agree + t.ill_posed + t.wrong;
    table.add({t.name, std::to_string(t.queries), std::to_string(t.agree), std::to_string(t.ill_posed),
               share(t.wrong, answers), share(t.wrong_time, answers), std::to_string(t.undecided),
               std::to_string(t.unsupported), std::to_string(t.error), std::to_string(t.missing),
               t.timed_hits ? fmt::format("{:.3g}", t.max_ulp()) : "-",
               t.timed_hits ? fmt::format("{:.3g}", t.mean_ulp()) : "-", nanoseconds(t.speed.ns_per_query),
               nanoseconds(t.speed.ns_median)});
  }
  return table.text();
}

std::string others_of(const Tally& t) {
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(t.ill_posed, "ill-posed");
  add(t.undecided, "undecided");
  add(t.unsupported, "unsupported");
  add(t.error, t.error == 1 ? "error" : "errors");
  add(t.missing, "missing");
  return text;
}

std::string verdict_of(const Tally& t) {
  const std::size_t answers = t.agree + t.ill_posed + t.wrong;
  const std::string others = t.agree + t.wrong == t.queries ? "" : "; " + others_of(t);
  if (answers == 0) return fmt::format("{}: no answer to judge{}", t.name, others);
  std::string text = t.wrong
                         ? fmt::format("{}: wrong in {} of {} answers", t.name, t.wrong, answers)
                         : fmt::format("{}: no wrong answer in {} (with 95 %: in fewer than {:.2g} % of all)",
                                       t.name, answers, 100 * report::bound_of_none(answers));
  text += others;
  if (t.other_quantity > 0) text += fmt::format("; in {} the time is another quantity", t.other_quantity);
  if (t.speed.own_ns)
    text += fmt::format("; its own calls take {:.3g} ns a query, as it says", *t.speed.own_ns);
  if (t.wrong_time == 0) return text;
  return text + fmt::format(
                    "\n  {} of right obstacles: off by {:.3g} ulps (median), {:.3g} (99 %), {:.3g} "
                    "(largest);\n"
                    "  {:.3g}, {:.3g}, {:.3g} times what an ulp in each input makes of them",
                    t.wrong_time == 1 ? "1 wrong time" : fmt::format("{} wrong times", t.wrong_time),
                    quantile(t.wrong_ulps, 0.5), quantile(t.wrong_ulps, 0.99), quantile(t.wrong_ulps, 1),
                    quantile(t.wrong_conditions, 0.5), quantile(t.wrong_conditions, 0.99),
                    quantile(t.wrong_conditions, 1));
}

}  // namespace lorentz::cli
