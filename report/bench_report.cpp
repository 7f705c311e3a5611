#include "report/bench_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <lorentz/exchange.hpp>
#include "report/claim_words.hpp"
#include "report/table.hpp"
#include "src/exchange/csv_table.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::report {

using question::Count;

namespace {

std::string radius_of(const Cell& cell) {
  if (!cell.radius) return "own";
  std::string text;
  append_number(text, *cell.radius);
  return text;
}

std::string table_of(const std::vector<Cell>& cells) {
  Table table({"queries", "engine", "number", "ns", "quartiles", "undecided", "ill-posed", "wrong",
               "wrong time", "mean ulp", "99 % ulp", "max ulp"});
  std::string before;
  for (const Cell& cell : cells) {
    const std::string its = fmt::format("{}, r = {}, {}", cell.scene, radius_of(cell), cell.difficulty);
    const std::string what = its == before ? "" : its;
    before = its;
    if (!cell.skipped.empty()) {
      table.add({what, cell.engine, "-", std::string(cell.skipped), "", "", "", "", "", "", "", ""});
      continue;
    }
    const auto number = [&](Count count) { return std::to_string(cell.counts[count]); };
    table.add({what, cell.engine, std::to_string(cell.queries),
               cell.speed ? fmt::format("{:.0f}", cell.speed->ns_median) : "-",
               cell.speed ? fmt::format("{:.0f}-{:.0f}", cell.speed->ns_low, cell.speed->ns_high) : "-",
               number(Count::undecided), number(Count::ill_posed), number(Count::wrong),
               number(Count::wrong_time), fmt::format("{:.3g}", cell.ulps.mean),
               fmt::format("{:.3g}", cell.ulps.p99), fmt::format("{:.3g}", cell.ulps.max)});
  }
  return table.text();
}

// The results of one engine over all cells of the table.
class Summary {
 public:
  void add(const Cell& cell) {
    if (!cell.skipped.empty()) return void(++(cell.skipped == kTooSlow ? skipped_ : beyond_));
    if (cell.speed) {
      fastest_ = std::min(fastest_.value_or(cell.speed->ns_median), cell.speed->ns_median);
      slowest_ = std::max(slowest_, cell.speed->ns_median);
    }
    queries_ += cell.queries;
    counts_ += cell.counts;
    has_times_ |= cell.ulps.exact > 0 || !cell.ulps.counts.empty();
    max_ulp_ = std::max(max_ulp_, cell.ulps.max);
    max_condition_ = std::max(max_condition_, cell.conditions.max);
    calls_.add(cell.calls);
  }

  std::string conclusion(const std::string& name) const {
    if (queries_ == 0)
      return fmt::format("{}: too slow for {} cells of this table, {} outside of what is answered\n", name,
                         skipped_, beyond_);
    std::string text = name + ": " + wrong_text();
    const std::string others = counted_text(
        counts_, {Count::ill_posed, Count::undecided, Count::unsupported, Count::error, Count::missing});
    if (!others.empty()) text += "; " + others;
    text += '\n' + edge_text();
    if (counts_[Count::wrong_time] > 0)
      text += fmt::format("  {} of right obstacles\n", counted_text(counts_, {Count::wrong_time}));
    text += fastest_ ? fmt::format("  {:.0f} to {:.0f} ns", *fastest_, slowest_) : "  no times, for it broke";
    if (has_times_)
      text += fmt::format("; times at worst {:.3g} ulps off, {:.3g} times the condition", max_ulp_,
                          max_condition_);
    if (skipped_ > 0) text += fmt::format("; too slow for {} {}", skipped_, skipped_ == 1 ? "cell" : "cells");
    if (beyond_ > 0)
      text += fmt::format("; {} {} outside of what is answered", beyond_, beyond_ == 1 ? "cell" : "cells");
    return text + '\n';
  }

 private:
  // Says where the engine begins to fail.
  std::string edge_text() const {
    std::optional<int> last;
    for (const auto& [decade, call] : calls_.by_decade())
      if (call.counts[Count::wrong] > 0) last = decade;
    if (!last) return "";
    std::size_t beyond = 0;
    for (const auto& [decade, call] : calls_.by_decade()) beyond += decade > *last ? call.counts.total() : 0;
    return fmt::format(
        "  wrong only where the obstacle is met or missed by less than 1e{:+03} radii, not in {} beyond\n",
        *last + 1, beyond);
  }

  std::string wrong_text() const {
    const std::size_t answers = counts_.answers(), wrong = counts_[Count::wrong];
    if (answers == 0) return "no answer to judge";
    const Share share = share_of(wrong, answers);
    if (wrong == 0)
      return fmt::format("no wrong answer in {} (0 to {:.2g} % of all, with 95 %)", answers,
                         100 * share.high);
    return fmt::format("wrong in {} of {} answers ({:.2g} to {:.2g} % of all, with 95 %)", wrong, answers,
                       100 * share.low, 100 * share.high);
  }

  std::size_t queries_ = 0, skipped_ = 0, beyond_ = 0;
  question::Counts counts_;
  bool has_times_ = false;
  std::optional<double> fastest_;
  double slowest_ = 0, max_ulp_ = 0, max_condition_ = 0;
  Calls calls_;
};

}  // namespace

std::string bench_text(const std::vector<Cell>& cells, const std::vector<std::string>& engines) {
  std::string text =
      table_of(cells) +
      "\nns: median over blocks of 16 queries (of a batch engine 1024) of a block's mean, and its "
      "quartiles; ulp: error of the time of right hits.\n\n";
  for (const std::string& engine : engines) {
    Summary summary;
    for (const Cell& cell : cells)
      if (cell.engine == engine) summary.add(cell);
    text += summary.conclusion(engine);
  }
  return text;
}

std::string bench_csv(const std::vector<Cell>& cells) {
  std::string csv =
      "scene,radius,difficulty,engine,queries,ns_mean,ns_median,ns_quartile_1,ns_quartile_3,undecided,wrong,"
      "wrong_time,mean_ulp,ulp_99_percent,max_ulp,path_mean,ill_posed,undecided_low,undecided_high,"
      "ill_posed_low,ill_posed_high,wrong_low,wrong_high,wrong_time_low,wrong_time_high,"
      "condition_99_percent,max_condition\n";
  for (const Cell& cell : cells) {
    if (!cell.skipped.empty()) continue;
    csv += fmt::format(
        "{},{},{},{},{},{},{},{},{},{:.4g},{:.4g},{:.4g},{:.6g},{}", csv_field(cell.scene), radius_of(cell),
        cell.difficulty, csv_field(cell.engine), cell.queries,
        cell.speed ? fmt::format("{:.1f},{:.1f},{:.1f},{:.1f}", cell.speed->ns_per_query,
                                 cell.speed->ns_median, cell.speed->ns_low, cell.speed->ns_high)
                   : ",,,",
        cell.counts[Count::undecided], cell.counts[Count::wrong], cell.counts[Count::wrong_time],
        cell.ulps.mean, cell.ulps.p99, cell.ulps.max, cell.mean_path, cell.counts[Count::ill_posed]);
    for (const Count count : {Count::undecided, Count::ill_posed, Count::wrong, Count::wrong_time}) {
      const Share share = share_of(cell.counts[count], cell.queries);
      csv += fmt::format(",{:.4g},{:.4g}", share.low, share.high);
    }
    csv += fmt::format(",{:.4g},{:.4g}\n", cell.conditions.p99, cell.conditions.max);
  }
  return csv;
}

std::string bench_json(const std::vector<Cell>& cells, const std::string& manifest, const Claim& claim) {
  constexpr const char* kNewLine = "\n";
  return json::line_of([&](json::Members& page) {
    page.add("format", 1, "kind", "bench", "title", "Speed against error", "manifest", json::Raw{manifest});
    page.add("cells", json::array(cells, json::append<Cell>, kNewLine));
    add_claim(page, claim);
  });
}

}  // namespace lorentz::report
