// lorentz convergents: the exact continued fraction of a slope.
#include <lorentz/continued_fraction.hpp>
#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/output.hpp"
#include "report/table.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {
namespace {

struct ConvergentsOptions {
  std::string slope, run = "1";
  bool json = false;
};

int run_convergents(const ConvergentsOptions& options) {
  const double rise = parse_number(options.slope), run = parse_number(options.run);
  if (run == 0) throw InputError("the run is zero: the slope is infinite");
  constexpr std::size_t kAll = 10'000;  // a quotient of two binary64 has less than 3200 terms
  const auto convergents = oracle::convergents(rise, run, kAll);
  if (options.json) {
    print(json::line_of([&](json::Members& object) {
      object.add("rise", rise, "run", run, "convergents",
                 json::objects(convergents, [](json::Members& one, const oracle::Convergent& c) {
                   one.add("a", c.a, "p", c.p, "q", c.q, "remainder", c.remainder, "remainder_exact",
                           c.remainder_exact);
                 }));
    }));
    return kDone;
  }
  report::Table table({"n", "a", "p", "q", "q m - p"});
  for (std::size_t i = 0; i < convergents.size(); ++i) {
    const auto& c = convergents[i];
    table.add(
        {std::to_string(i), c.a.decimal(), c.p.decimal(), c.q.decimal(), fmt::format("{:.6g}", c.remainder)});
  }
  print(table.text());
  return kDone;
}

}  // namespace

Command convergents_command() {
  auto options = std::make_shared<ConvergentsOptions>();
  return {
      "convergents",
      "Exact continued fraction of a slope: partial quotients, convergents p/q, signed remainders q m - p.",
      {
          {"slope", &options->slope, "TEXT",
           "the slope m, or its rise (v_2); decimal or hexadecimal, taken as a binary64", kRequired},
          {"run", &options->run, "TEXT", "the run (v_1): the slope is rise / run, exactly"},
          {"--json", &options->json, "", "one JSON object, the remainders also as exact fractions"},
      },

      "Examples:\n  lorentz convergents 0.01745240643728351 0.9998476951563913\n  lorentz convergents -0.618",
      [options] { return run_convergents(*options); }};
}

}  // namespace lorentz::cli
