// lorentz horizon: the infinite channels that a scene leaves open.
#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "report/files/scene_file.hpp"
#include "report/horizon_report.hpp"

namespace lorentz::cli {
namespace {

struct HorizonOptions {
  std::string scene;
  std::optional<double> radius, min_width;
  bool json = false;
};

int run_horizon(const HorizonOptions& options) {
  const Scene scene = load_scene(options.scene, options.radius);
  try {
    const oracle::Horizon horizon =
        oracle::horizon_of(scene, options.min_width.value_or(0), true, search_progress());
    print(options.json ? report::json_of(horizon, options.scene) : report::text_of(horizon));
  } catch (const oracle::TooManyChannels& error) {
    throw InputError(fmt::format("{}: {}; --min-width W restricts the search to channels {}", options.scene,
                                 error.what(), options.min_width ? "wider than that" : "at least W wide"));
  }
  return kDone;
}

}  // namespace

Command horizon_command() {
  auto options = std::make_shared<HorizonOptions>();
  return {
      "horizon",
      "The infinite channels that a scene leaves open, exactly: corridors (2D), planar and cylindrical "
      "channels (3D).",
      {
          {"scene", &options->scene, "SCENE", "a name of the catalogue, or a file", kRequired},
          {"--radius", Positive{&options->radius}, "R", "radius of every ball"},
          {"--min-width", Positive{&options->min_width}, "W",
           "only corridors and planar channels at least W wide (for small obstacles)"},
          {"--json", &options->json, "", "one JSON object, with all channels (a table has 20 rows at most)"},
      },
      "Examples:\n  lorentz horizon square --radius 0.4",
      [options] { return run_horizon(*options); }};
}

}  // namespace lorentz::cli
