// lorentz trajectory: certified itineraries from the starts of a stream, and engines compared with them.

#include <lorentz/exchange.hpp>
#include "cli/app.hpp"
#include "cli/help_texts.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/query_stream.hpp"
#include "cli/terminal.hpp"
#include "question/engines.hpp"
#include "report/files/messages.hpp"
#include "report/files/scene_file.hpp"
#include "report/files/whole_file.hpp"
#include "report/pictures/scene_drawing.hpp"
#include "src/exchange/csv_table.hpp"
#include "src/exchange/exchange_number.hpp"
#include "src/exchange/exchange_write.hpp"
#include "src/exchange/nearest_name.hpp"
#include "statistics/rival/rival.hpp"

namespace lorentz::cli {
namespace {

using oracle::Arrival;
using oracle::CertifiedCollision;
using oracle::Itinerary;
using oracle::Journey;
using oracle::JourneyEnd;
using oracle::kMostBits;
using rival::Rival;

struct TrajectoryOptions {
  std::string starts = "-";
  std::optional<std::string> scene, radius, x, v, time, engine, csv, svg;
  std::optional<std::uint64_t> collisions, digits, most_bits;
  bool detail = false, strict = false;
};

Rational positive_rational(const std::string& text, const char* option) {
  const auto number = rational_from(text);
  if (!number || !is_positive(*number))
    throw InputError(fmt::format("{}: {} is not a rational number above zero (like 1/3, 0.1, 2.5e-3)", option,
                                 json_quoted(text)));
  return *number;
}

Journey journey_of(const TrajectoryOptions& options) {
  Journey journey;
  if (!options.collisions && !options.time)
    throw InputError("needs --collisions N or --time T: how far to follow each start");
  if (options.collisions) journey.collisions = *options.collisions;
  if (options.time) journey.time = positive_rational(*options.time, "--time");
  if (options.digits) journey.digits = static_cast<int>(*options.digits);
  if (options.most_bits) journey.most_bits = static_cast<long>(*options.most_bits);
  journey.states = options.detail;
  journey.stop = &Interrupt::came();
  return journey;
}

std::optional<RationalScene> scene_of(const TrajectoryOptions& options) {
  if (!options.scene) {
    if (options.radius)
      throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
    return std::nullopt;
  }
  return load_rational_scene(
      *options.scene,
      options.radius ? std::optional(positive_rational(*options.radius, "--radius")) : std::nullopt,
      options.strict);
}

StartStream starts_of(const TrajectoryOptions& options) {
  const auto one = one_query(options.x, options.v, options.scene.has_value(), options.starts, true);
  return one ? StartStream(*one, "--x and --v", scene_of(options), options.strict)
             : StartStream(options.starts, scene_of(options), options.strict);
}

// One column per dimension. For a lattice with fewer vectors the last ones are empty.
std::string cell_columns(const ObstacleId& obstacle, const Components& count) {
  std::string text;
  for (int i = 0; i < count.of_vectors(); ++i) {
    if (i > 0) text += ',';
    if (i < count.of_cells(obstacle.lattice)) append_integer(text, obstacle.cell[i]);
  }
  return text;
}

// Adds position and velocity, if requested.
template <class State>
void add_state(json::Members& line, const State& state) {
  if (!state.x.empty()) line.add("x", state.x);
  if (!state.v.empty()) line.add("v", state.v);
}

// An id as a field of a table.
std::string in_table(const Id& id) {
  const bool is_plain_text = id.starts_with('"') && id.find_first_of(",\\\"", 1) == id.size() - 1;
  return csv_field(is_plain_text ? id.substr(1, id.size() - 2) : id);
}

// Follows starts, and reports each: lines on stdout, rows of a table, a path for the picture.
class TrajectoryRun {
 public:
  TrajectoryRun(Output& out, const TrajectoryOptions& options)
      : engine_(options.engine ? std::optional(question::engine_named(*options.engine)) : std::nullopt),
        program_(engine_ && engine_->runs_apart() ? engine_->answerer({.listener = terminal()}) : nullptr),
        journey_(journey_of(options)),
        out_(out),
        options_(options) {
    if (options.csv) csv_.emplace(*options.csv);
  }

  void follow(const Id& id, const RationalScene& scene, const Start& start);
  /// Ends an external engine. Returns true if it failed.
  bool engine_failed() {
    if (program_) program_->finish();
    return program_ && program_->failed();
  }
  const std::optional<pictures::PathDrawing>& picture() const { return picture_; }

  /// Leaves an old table as it is if no start was followed.
  void commit() {
    if (csv_ && columns_ > 0) csv_->commit();
  }

 private:
  void begin(const Id& id, const Components& count) {
    const int dimension = count.of_vectors();
    id_ = id;
    components_ = count;
    number_ = 0;
    if (csv_ && columns_ == 0) {
      columns_ = dimension;
      csv_->write(fmt::format("id,collision,lattice,atom,cell1,cell2{},time,bits{}\n",
                              dimension == 3 ? ",cell3" : "", options_.engine ? ",engine_bits" : ""));
    }
    if (csv_ && columns_ != dimension) throw InputError("--csv: starts in two and in three dimensions");
  }

  void collision(const CertifiedCollision& c, const Rival* rival) {
    ++number_;
    json::append(out_.buffer(), [&](json::Members& line) {
      line.add("id", json::Raw{id_}, "collision", number_);
      add_obstacle(line, c.obstacle, components_);
      line.add("time", c.time);
      add_state(line, c);
      line.add("bits", c.bits);
      if (rival) line.add("engine_bits", json::Raw{fmt::format("{:.1f}", rival->bits_right())});
    });
    out_.buffer() += '\n';
    out_.flush_if_due();
    if (!csv_) return;
    csv_->write(fmt::format("{},{},{},{},{},{},{}", in_table(id_), number_, c.obstacle.lattice,
                            c.obstacle.atom, cell_columns(c.obstacle, components_), c.time, c.bits));
    csv_->write(rival ? fmt::format(",{:.1f}\n", rival->bits_right()) : "\n");
  }

  void end(const Arrival& arrival, const Rival* rival) {
    json::append(out_.buffer(), [&](json::Members& line) {
      line.add("id", json::Raw{id_}, "end", name_of(arrival.end), "collisions", arrival.collisions, "bits",
               arrival.bits);
      add_state(line, arrival);
      if (!arrival.distance.empty()) line.add("distance", arrival.distance);
      if (!rival) return;
      line.add("diverged", rival->diverged());
      if (const std::string why = rival->stopped(); !why.empty()) line.add("stopped", why);
    });
    out_.buffer() += '\n';
    out_.flush();
  }

  const std::optional<question::EngineInfo> engine_;
  const std::unique_ptr<question::Answerer> program_;  // an external engine
  const Journey journey_;
  Output& out_;
  const TrajectoryOptions& options_;
  std::optional<WholeFile> csv_;
  Id id_;
  Components components_ = 0;
  int columns_ = 0;
  std::uint64_t number_ = 0;
  std::optional<pictures::PathDrawing> picture_;  // of the first start
};

// Adds the end of the path, and the engine's path from the point where they separate.
void end_drawing(pictures::PathDrawing& drawing, const Arrival& arrival, Rival* rival,
                 const std::string& engine) {
  if (arrival.end == JourneyEnd::time && arrival.x.size() == 2)
    drawing.path.push_back({*nearest_decimal(arrival.x[0]), *nearest_decimal(arrival.x[1]), 0});
  if (arrival.end == JourneyEnd::never && arrival.v.size() == 2)
    drawing.escape = {*nearest_decimal(arrival.v[0]), *nearest_decimal(arrival.v[1]), 0};
  if (!rival || !rival->diverged()) return;
  drawing.parting = *rival->diverged();
  const std::string why = rival->stopped();
  drawing.other_words =
      fmt::format("{}: {} at collision {}", engine,
                  why.empty() ? "another obstacle" : "stopped (" + why + ")", drawing.parting);
  rival->go_on(arrival.collisions);
  drawing.other = rival->path();
}

void TrajectoryRun::follow(const Id& id, const RationalScene& scene, const Start& start) {
  std::unique_ptr<Rival> rival;
  if (engine_) rival = std::make_unique<Rival>(*engine_, program_.get(), scene, start);
  pictures::PathDrawing* picture = nullptr;
  if (options_.svg && !picture_) {
    if (scene.dimension != 2) throw InputError("--svg: draws paths in two dimensions");
    picture = &picture_.emplace();
    picture->scene = oracle::nearest(scene);
    picture->path.push_back(oracle::nearest(start).x);
  }
  begin(id, oracle::nearest(scene));
  const Arrival arrival = Itinerary(scene).follow(start, journey_, [&](const CertifiedCollision& met) {
    if (rival) rival->meet(met);
    collision(met, rival.get());
    if (picture) {
      ++picture->collisions;
      picture->path.push_back(rival::place_of(picture->scene, met));
    }
    return true;
  });
  if (Interrupt::came()) return;  // an interrupt is not the end of a trajectory
  if (rival) rival->finish(arrival, journey_.time ? oracle::nearest(*journey_.time) : 0);
  end(arrival, rival.get());
  if (picture) end_drawing(*picture, arrival, rival.get(), options_.engine.value_or(""));
  if (arrival.end == JourneyEnd::undecided)
    say("start {}: undecided at collision {} with {} bits (--max-bits allows more; a line that touches an "
        "obstacle, or two obstacles that are entered at once, no precision decides)",
        id, arrival.collisions + 1, arrival.bits);
}

int run_trajectory(const TrajectoryOptions& options) {
  Output output;
  TrajectoryRun run(output, options);
  StartStream stream = starts_of(options);
  RequestedFile svg(options.svg);
  const Interrupt interrupt;
  bool refused = false;
  for (StartItem item; !Interrupt::came() && stream.next(item);) {
    if (item.kind == StreamItem::Kind::bad)
      append_answer_line(output.buffer(), item.id, Answer::error(item.message), 0);
    if (item.kind != StreamItem::Kind::query) continue;
    try {
      run.follow(item.id, *stream.scene(), item.start);
    } catch (const InputError& error) {
      refused = true;
      say("{}: start {}: {}", stream.lines().name(), item.id, error.what());
      append_answer_line(output.buffer(), item.id, Answer::error(error.what()), 0);
    }
  }
  try {
    output.flush();
  } catch (const FileError&) {  // after SIGHUP the terminal is gone; the files are still written
    if (!Interrupt::came()) throw;
  }
  run.commit();
  if (run.picture()) svg.write([&] { return pictures::draw_path(*run.picture()); });
  if (Interrupt::came()) {
    say("{}: the last start has no end", Interrupt::what());
    return kFailed;
  }
  if (run.engine_failed()) return kFailed;
  return refused || stream.had_bad_input() ? kBadInput : kDone;
}

}  // namespace

Command trajectory_command() {
  auto options = std::make_shared<TrajectoryOptions>();
  return {
      "trajectory",
      "Certified itineraries: which obstacles are hit one after another, proven.",
      {
          {"starts", &options->starts, "FILE",
           "a query stream, whose numbers may be texts like \"1/3\"; - is standard input"},
          {"--scene", &options->scene, "SCENE",
           "scene before the first scene line: a file, or a name of the catalogue"},
          {"--radius", &options->radius, "R", "radius of every ball of --scene, exactly: 1/3, 0.1"},
          {"--x", &options->x, "X1,X2,..",
           "follow one start in --scene, without a stream: the position, exactly"},
          {"--v", &options->v, "V1,V2,..", "its velocity, exactly: 1,1/3 or 1,golden"},
          {"--collisions", Whole{&options->collisions, 0, 1u << 30}, "N",
           "follow each start for N collisions"},
          {"--time,--max-time", &options->time, "T", "or to this time, exactly: 10, 1/3"},
          {"--digits", Whole{&options->digits, 1, kMostDigits}, "N",
           "digits of times, places and velocities (default: 17)"},
          {"--detail", &options->detail, "", "place and velocity at each collision, too"},
          {"--max-bits", Whole{&options->most_bits, 32, kMostBits}, "B",
           "precision at which to give up, undecided (default: 262144, or as --digits needs)"},
          {"-e,--engine", &options->engine, "ENGINE",
           "compares the trajectory with that of this engine's flights; " + std::string(kEngineHelp)},
          {"--csv", &options->csv, "FILE", "collisions as a table, to a file", kOutput},
          {"--svg", &options->svg, "FILE", "a picture of the first start's path (2D)", kOutput},
          {"--strict", &options->strict, "", kStrictKeysHelp},
      },

      "docs/itineraries.md: what is certified, and how. `bits`: of a collision, by how many bits an error of "
      "the\nstart has grown; of the end, the precision that it took.\n"
      "Example, problem 2 of the SIAM 100-digit challenge to 100 digits:\n"
      "  lorentz trajectory --scene square --radius 1/3 --x 1/2,1/10 --v 1,0 --time 10 --digits 100",
      [options] { return run_trajectory(*options); }};
}

}  // namespace lorentz::cli
