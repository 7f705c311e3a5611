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
  std::optional<std::string> name, scene;
  std::optional<double> radius, min_width;
  std::uint64_t limit = 20;
  bool no_cylinders = false, json = false;
};

int act(const HorizonOptions& options) {
  if (options.name && options.scene)
    throw InputError("--scene: the scene is given twice, as " + *options.name + " and " + *options.scene);
  if (!options.name && !options.scene)
    throw InputError("which scene? give a file, or a name of the catalogue");
  const std::string& name = options.name ? *options.name : *options.scene;
  const Scene scene = load_scene(name, options.radius);
  try {
    const oracle::Horizon horizon =
        oracle::horizon_of(scene, options.min_width.value_or(0), !options.no_cylinders, search_progress());
    print(options.json ? report::json_of(horizon, name, options.min_width.has_value())
                       : report::text_of(horizon, options.limit, options.min_width.has_value()));
  } catch (const oracle::TooManyChannels& error) {
    throw InputError(fmt::format("{}: {}; --min-width W restricts the search to channels {}", name,
                                 error.what(), options.min_width ? "wider than that" : "at least W wide"));
  }
  return kDone;
}

}  // namespace

Command horizon_command() {
  auto options = std::make_shared<HorizonOptions>();
  return {"horizon",
          "The infinite channels that a scene leaves open, exactly: corridors (2D), planar and cylindrical "
          "channels (3D).",
          {
              {"name", &options->name, "SCENE", "the scene: a file, or a name of the catalogue"},
              {"--scene", &options->scene, "SCENE", "the same"},
              {"--radius", Positive{&options->radius}, "R", "radius of every ball"},
              {"--min-width", Positive{&options->min_width}, "W",
               "only corridors and planar channels at least W wide (for small obstacles)"},
              {"--limit", Whole{&options->limit, 0, 1'000'000'000}, "N", "print N rows of a table at most"},
              {"--no-cylinders", &options->no_cylinders, "", "leave out the search for cylindrical channels"},
              {"--json", &options->json, "", "one JSON object, with all channels"},
          },
          "Examples:\n  lorentz horizon square --radius 0.4",
          [options] { return act(*options); }};
}

}  // namespace lorentz::cli
