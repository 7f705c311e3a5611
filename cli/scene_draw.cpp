// lorentz scene draw: the picture of a scene, with flights and open channels.
#include "cli/app.hpp"

#include <filesystem>

#include <lorentz/exchange.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/horizon.hpp>
#include "cli/numbers.hpp"
#include "cli/output.hpp"
#include "cli/query_stream.hpp"
#include "cli/terminal.hpp"
#include "question/engines.hpp"
#include "report/files/scene_file.hpp"
#include "report/files/whole_file.hpp"
#include "report/pictures/scene_drawing.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz::cli {

using namespace question;
using namespace pictures;

namespace {

struct SceneDrawOptions {
  std::optional<std::string> scene, queries, window;
  std::optional<double> radius;
  std::optional<std::uint64_t> channels;
  std::string output = "-", size = "800";
};

// No program opens a file x.png that contains an SVG.
void refuse_other_formats(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension();
  for (const char* other : {".png", ".jpg", ".jpeg", ".gif", ".pdf", ".eps", ".ps"})
    if (extension == other)
      throw InputError(file + ": pictures are drawn as SVG; name the file so, and convert it (rsvg-convert)");
}

// The flights of a query stream, up to the first query in a different scene from that of the first query.
std::vector<DrawnFlight> flights_of(QueryStream& stream, std::optional<Scene>& scene) {
  constexpr std::size_t kMostFlights = 1000;
  std::vector<DrawnFlight> flights;
  std::optional<question::SceneEngine> certified;
  std::size_t refused = 0;
  std::string reason;
  for (StreamItem item; stream.next(item);) {
    if (item.kind == StreamItem::Kind::scene) {
      if (!flights.empty() || refused > 0) {
        say("the picture shows the first scene of the queries; what follows the second is left out");
        break;
      }
      scene = item.scene;
      certified.reset();
    } else if (item.kind == StreamItem::Kind::query) {
      if (flights.size() >= kMostFlights) {
        say("the picture shows the first {} flights", kMostFlights);
        break;
      }
      if (!certified) certified = question::engine_named("certified").in(*scene);
      question::Reply reply;
      certified->ask(item.query, {.max_time = item.max_time}, reply);
      DrawnFlight flight{item.query, std::move(reply.answer)};
      const bool is_cut = flight.answer.outcome == Outcome::later;
      if (is_cut || flight.answer.outcome == Outcome::error) {
        ++refused;
        reason = is_cut ? "nothing is hit before max_time" : flight.answer.message;
      } else {
        flights.push_back(std::move(flight));
      }
    }
  }
  if (refused > 0) say("flights left out: {} ({})", refused, reason);
  return flights;
}

std::optional<std::array<double, 4>> window_of(const SceneDrawOptions& options) {
  if (!options.window) return std::nullopt;
  const std::vector<double> numbers = numbers_in(*options.window, "--window");
  if (numbers.size() != 4 || !(numbers[0] < numbers[2]) || !(numbers[1] < numbers[3]))
    throw InputError(fmt::format("--window: {} is not X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1",
                                 json_quoted(*options.window)));
  if (!(numbers[2] - numbers[0] < 1e300) || !(numbers[3] - numbers[1] < 1e300))
    throw InputError("--window: is too large");
  return std::array{numbers[0], numbers[1], numbers[2], numbers[3]};
}

// The widest corridors. Those that are open only because a radius was rounded are too narrow to be visible.
std::vector<FreeWay> ways_of(const Scene& scene, std::size_t most) {
  if (!is_crystal(scene)) throw InputError("--channels: supports crystals only");
  if (scene.dimension != 2)
    throw InputError("--channels: is for scenes in the plane; lorentz horizon lists those of this one");
  std::vector<FreeWay> ways;
  try {
    const oracle::Horizon horizon = oracle::horizon_of(scene, 0, false, search_progress());
    const double narrow = 1e-6 * length(scene.lattices[0].vectors[0]);
    for (std::size_t i = 0; i < std::min(most, horizon.channels.size()); ++i) {
      const oracle::Channel& channel = horizon.channels[i];
      if (channel.width < narrow) break;
      ways.push_back({channel.point, channel.vector, channel.width,
                      fmt::format("corridor [{}]: width {:.4g}",
                                  decimals(components(channel.indices, 2), " "), channel.width)});
    }
    if (ways.empty()) say("no channels are drawn: none is known to be open, or none is wide enough");
  } catch (const oracle::TooManyChannels& error) {
    say("no channels are drawn: {}", error.what());
  }
  return ways;
}

std::string title_of(const SceneDrawOptions& options) {
  std::string title = options.scene ? *options.scene : *options.queries == "-" ? "" : *options.queries;
  if (options.radius) title += fmt::format(" --radius {}", *options.radius);
  return title;
}

int draw(const SceneDrawOptions& options) {
  if (!options.scene && !options.queries)
    throw InputError("which scene? give a name of the catalogue, a file, or --queries with a scene in it");
  if (options.radius && !options.scene)
    throw InputError("--radius: needs a scene (those of a stream say their radii themselves)");
  DrawOptions drawing_options;
  drawing_options.title = title_of(options);
  drawing_options.window = window_of(options);
  const PictureSize size = picture_size(options.size);
  drawing_options.width = size.width, drawing_options.height = size.height.value_or(0);
  const std::size_t most = options.channels.value_or(0);
  refuse_other_formats(options.output);
  std::optional<Scene> scene;
  if (options.scene) scene = load_scene(*options.scene, options.radius);
  std::vector<DrawnFlight> flights;
  bool bad = false;
  if (options.queries) {
    QueryStream stream(*options.queries, scene, false);
    flights = flights_of(stream, scene);
    bad = stream.had_bad_input();
  }
  if (!scene) throw InputError(*options.queries + ": has no scene; give one by name or file");
  if (drawing_options.window && scene->dimension != 2)
    throw InputError("--window: is for scenes in the plane; this one has 3 dimensions");
  if (most > 0) drawing_options.ways = ways_of(*scene, most);
  const Drawing drawing = draw_scene(*scene, drawing_options, flights);
  for (const std::string& remark : drawing.remarks) say("{}", remark);
  if (options.output == "-")
    print(drawing.svg);
  else
    write_whole(options.output, drawing.svg);
  return bad ? kBadInput : kDone;
}

}  // namespace

Command scene_draw_command() {
  auto options = std::make_shared<SceneDrawOptions>();
  return {
      "draw",
      "A picture (SVG), with flights if queries are given.",
      {
          {"scene", &options->scene, "SCENE",
           "a name of the catalogue, or a file; without it, the first scene of the queries"},
          {"--radius", Positive{&options->radius}, "R", "radius of every ball"},
          {"--queries", &options->queries, "FILE",
           "query stream (NDJSON): its flights to their first hits, exactly; - is standard input"},
          {"--channels", Whole{&options->channels, 1, 100}, "N", "2D: draw the N widest corridors"},
          {"--window", &options->window, "X0,Y0,X1,Y1", "2D: the part of the plane to show"},
          {"--size", &options->size, "W[xH]", "in pixels: the width, or what the picture is to fit into"},
          {"-o,--output", &options->output, "FILE",
           "file to write, whole or not at all; a file that is not an SVG is left as it is; - is "
           "standard output",
           kOutput | kTakesStdout},
      },

      "Example:\n  lorentz scene draw square --queries data/examples/paper-89-directions.queries.ndjson -o "
      "flights.svg",
      [options] { return draw(*options); }};
}

}  // namespace lorentz::cli
