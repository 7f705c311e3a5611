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
  report::Table table(titles_counted(Counted::examinations, {"engine", "queries"},
                                     {"max ulp", "mean ulp", "ns/query", "ns median"}));
  for (const Tally& t : tallies) {
    const auto text = [&](Count count, std::size_t number) {
      return count == Count::wrong || count == Count::wrong_time ? share(number, t.counts.answers())
                                                                 : std::to_string(number);
    };
    const auto ulps = [&](double number) { return t.timed_hits ? fmt::format("{:.3g}", number) : "-"; };
    table.add(cells_counted(t.counts, Counted::examinations, {t.name, std::to_string(t.queries)},
                            {ulps(t.max_ulp()), ulps(t.mean_ulp()), nanoseconds(t.speed.ns_per_query),
                             nanoseconds(t.speed.ns_median)},
                            text));
  }
  return table.text();
}

std::string others_of(const Tally& t) {
  return counted_text(t.counts,
                      {Count::ill_posed, Count::undecided, Count::unsupported, Count::error, Count::missing});
}

std::string verdict_of(const Tally& t) {
  const std::size_t answers = t.counts.answers();
  const std::string others = t[Count::agree] + t[Count::wrong] == t.queries ? "" : "; " + others_of(t);
  if (answers == 0) return fmt::format("{}: no answer to judge{}", t.name, others);
  std::string text = t[Count::wrong]
                         ? fmt::format("{}: wrong in {} of {} answers", t.name, t[Count::wrong], answers)
                         : fmt::format("{}: no wrong answer in {} (with 95 %: in fewer than {:.2g} % of all)",
                                       t.name, answers, 100 * report::bound_of_none(answers));
  text += others;
  if (const std::size_t others_of_time = t[Count::other_quantity]; others_of_time > 0)
    text += fmt::format("; in {} the time is another quantity", others_of_time);
  if (t.speed.own_ns)
    text += fmt::format("; over all of its calls its process counted {:.3g} ns a query", *t.speed.own_ns);
  if (t[Count::wrong_time] == 0) return text;
  return text + fmt::format(
                    "\n  {} of right obstacles: off by {:.3g} ulps (median), {:.3g} (99 %), {:.3g} "
                    "(largest);\n"
                    "  {:.3g}, {:.3g}, {:.3g} times what an ulp in each input makes of them",
                    counted_text(t.counts, {Count::wrong_time}), quantile(t.wrong_ulps, 0.5),
                    quantile(t.wrong_ulps, 0.99), quantile(t.wrong_ulps, 1),
                    quantile(t.wrong_conditions, 0.5), quantile(t.wrong_conditions, 0.99),
                    quantile(t.wrong_conditions, 1));
}

}  // namespace lorentz::cli
