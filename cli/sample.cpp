// lorentz sample: writes drawn starts as a query stream or in columns.
#include <algorithm>

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/claim_options.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "question/starts/free_starts.hpp"
#include "report/files/messages.hpp"
#include "report/files/scene_file.hpp"
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/columns_npy.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

using starts::FreeStarts;

namespace {

struct SampleOptions {
  std::string scene = "square", kind = "uniform", format = "ndjson", precision = "binary64";
  std::uint64_t count = 1000, seed = starts::kDefaultSeed;
  std::optional<double> radius;
};

// `with_from`: the starts leave obstacles.
void append_front(std::string& out, const SampleOptions& options, const Scene& scene, bool with_from) {
  if (options.format == "ndjson") append_scene_line(out, scene);
  if (options.format == "csv") append_csv_query_names(out, scene.dimension, with_from);
  if (options.format == "npy") out += npy_query_header(options.count, scene.dimension, with_from);
}

void append_rows(std::string& out, const std::string& format, const QueryRows& rows, std::uint64_t first,
                 const Scene& scene) {
  if (format == "csv") return append_csv_queries(out, rows, scene);
  if (format == "npy") return append_npy_queries(out, rows, scene.dimension);
  for (std::size_t i = 0; i < rows.count; ++i)
    append_query_line(out, std::to_string(first + i), rows.query(i, scene.dimension), scene);
}

int run_sample(const SampleOptions& options) {
  constexpr std::uint64_t kRowsTogether = 1024;
  const auto kind = starts::kind_named(options.kind, "--kind");
  index_of_name(options.format, {"ndjson", "csv", "npy"}, "--format");  // throws if it is none of them
  const NumberFormat precision = number_format_named(options.precision);
  const Scene scene = rounded_scene(load_scene(options.scene, options.radius), precision, options.scene);
  const FreeStarts starts(scene, kind, options.seed, precision);
  const question::Listener listener = terminal();
  Output output;
  QueryRows rows;
  append_front(output.buffer(), options, scene, kind == starts::Kind::surface);
  for (std::uint64_t first = 0; first < options.count; first += rows.count) {
    rows.resize(std::min(kRowsTogether, options.count - first), scene.dimension,
                kind == starts::Kind::surface);
    for (std::size_t i = 0; i < rows.count; ++i) rows.set(i, starts[first + i], scene.dimension);
    append_rows(output.buffer(), options.format, rows, first, scene);
    output.flush_if_due();
    question::report(listener, "drawing", first + rows.count, options.count);
  }
  output.flush();
  say("{}: {} {} starts (seed {})", options.scene, options.count, options.kind, options.seed);
  return kDone;
}

}  // namespace

Command sample_command() {
  auto options = std::make_shared<SampleOptions>();
  return {
      "sample",
      "Drawn starts of flights: a query stream for first-hit, or columns.",
      {
          {"--scene", &options->scene, "SCENE", "a scene file, or a name of the catalogue"},
          {"--radius", Positive{&options->radius}, "R", "radius of every ball"},
          {"--kind,--start", &options->kind, "uniform|surface|near-rational|grazing",
           "uniform: anywhere outside the obstacles, in any direction; surface: off an obstacle by "
           "the cosine law, with `from`; near-rational: along a lattice vector but for ulps to "
           "2^-40; grazing: at an obstacle's edge but for ulps to 2^-10"},
          {"--count", Whole{&options->count, 1, 1'000'000'000'000}, "N", "how many"},
          {"--seed", Whole{&options->seed}, "N", "seed of the starts"},
          {"--precision", &options->precision, "binary64|binary32",
           "format of the numbers of scene and starts"},
          {"--format", &options->format, "ndjson|csv|npy",
           "ndjson: a stream that begins with the scene; csv, npy (NumPy): columns of numbers "
           "(docs/formats.md), which first-hit reads with --scene"},
      },

      "No start lies in an obstacle (but the one it leaves): that is decided exactly. The first N starts of "
      "a seed are the same whatever --count.\n"
      "Examples:\n  lorentz sample --scene triangular --count 100 | lorentz first-hit --engine certified\n  "
      "lorentz sample --kind surface --radius 0.2 --format npy > starts.npy",
      [options] { return run_sample(*options); }};
}

}  // namespace lorentz::cli
