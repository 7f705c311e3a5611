// Measures the speed of the engines by ratios of two ways to do the same work. They alternate in turns over
// the same queries, so that the load of the machine affects both alike. Prints the ratios, compares them with
// a file of earlier ones, and writes that file; ./run results puts it into docs/results.md.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>

#include <lorentz/certified_batch.hpp>
#include "question/starts/free_starts.hpp"
#include "tests/bench/bare_continued_fraction.hpp"

using namespace lorentz;

namespace {

constexpr std::size_t kQueries = 4096, kBlock = 512;

Scene with_atoms(int dimension, std::array<Vec, 3> vectors, std::vector<Atom> atoms) {
  Scene scene;
  scene.dimension = dimension;
  scene.lattices = {{vectors, std::move(atoms)}};
  return scene;
}

struct Place {
  std::string name;
  std::function<Scene(double)> scene;
};

Scene fcc(double r) {
  return with_atoms(3, {Vec{0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}, {{{}, r, {}}});
}
Scene triclinic(double r) {
  return with_atoms(3, {Vec{1, 0, 0}, {0.31, 1.07, 0}, {-0.22, 0.41, 0.93}}, {{{}, r, {}}});
}
Scene hexagonal(double r) {
  return with_atoms(2, {Vec{1, 0, 0}, {0.5, std::sqrt(0.75), 0}}, {{{}, r, {}}});
}
Scene ellipse(double r) {
  Scene scene = unit_scene(2, 1);
  scene.lattices[0].atoms = {{{}, 0, {{1.4 * r, 0.3 * r, 0}, {-0.3 * r, 0.7 * r, 0}}}};
  return scene;
}
Scene ellipsoid(double r) {
  Scene scene = unit_scene(3, 1);
  scene.lattices[0].atoms = {{{}, 0, {{1.3 * r, 0, 0.1 * r}, {0, r, 0.1 * r}, {0, 0, 0.7 * r}}}};
  return scene;
}
Scene motif(int dimension, double r) {
  Scene scene = unit_scene(dimension, r);
  scene.lattices[0].atoms.push_back({{0.5, 0.5, dimension == 3 ? 0.5 : 0}, r, {}});
  scene.lattices[0].atoms.push_back({{0.5, 0, 0}, 0.5 * r, {}});
  scene.lattices[0].atoms.push_back({{0, 0.5, 0}, 0.7 * r, {}});
  return scene;
}

// Work that answers the queries [begin, end). It returns a number, so that the compiler cannot skip anything.
using Work = std::function<double(std::size_t begin, std::size_t end)>;

// A scene with queries in it, and the ways to answer them.
class Ground {
 public:
  Ground(Scene scene, starts::Kind kind, std::size_t count = kQueries)
      : scene_(std::move(scene)), single_(scene_) {
    queries_ = starts::free_starts(scene_, kind, starts::kDefaultSeed, count);
    for (const Query& query : queries_) table_.push_back(query);
    flights_.resize(count);
  }

  Work single(Reduction::Time time = Reduction::Time::close) const {
    return [this, time](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t i = begin; i < end; ++i) sum += single_.fly(queries_[i], HUGE_VAL, time).time;
      return sum;
    };
  }
  Work batch(const std::string& instructions, int jobs = 1) {
    batches_.emplace_back(std::make_unique<Batch>(scene_, instructions));
    return [this, batch = batches_.back().get(), jobs](std::size_t begin, std::size_t end) {
      left_ += batch->fly(table_.columns().part(begin, end - begin), flights_.columns().part(begin),
                          Batch::Time::close, jobs);
      asked_ += end - begin;
      return flights_[begin].time;
    };
  }
  Work certified_batch() {
    certified_ = std::make_unique<oracle::CertifiedBatch>(scene_);
    return [this](std::size_t begin, std::size_t end) {
      certified_->first_hits(table_.columns().part(begin, end - begin), flights_.columns().part(begin),
                             uncertain_);
      double sum = flights_[begin].time;
      for (const std::size_t i : uncertain_)
        sum += certified_->one_at_a_time().first_hit(queries_[begin + i]).time.value_or(0);
      return sum;
    };
  }
  Work engine(const char* name) {
    engine_ = make_engine(name, scene_);
    return [this](std::size_t begin, std::size_t end) {
      double sum = 0;
      Answer answer;
      for (std::size_t i = begin; i < end; ++i) {
        engine_->first_hit(queries_[i], HUGE_VAL, answer);
        sum += answer.time.value_or(0);
      }
      return sum;
    };
  }
  Work oracle() {
    oracle_ = std::make_unique<oracle::Oracle>(scene_);
    return [this](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t i = begin; i < end; ++i) sum += oracle_->first_hit(queries_[i]).time.value_or(0);
      return sum;
    };
  }
  // Only the convergents of the slope up to the denominator 1 / (2 r), one query at a time.
  Work bare_continued_fraction(double r) const {
    return [this, r](std::size_t begin, std::size_t end) {
      double sum = 0;
      for (std::size_t i = begin; i < end; ++i) sum += lorentz::bare_continued_fraction(queries_[i].v, r);
      return sum;
    };
  }

  // A plain loop over the same columns: the quadratic of a ball around the origin, with the smaller root by
  // Vieta's formula, which has no cancellation.
  Work plain_ball(double r) {
    return [this, r](std::size_t begin, std::size_t end) {
      const QueryColumns asked = table_.columns().part(begin, end - begin);
      const std::span<double> time = flights_.columns().part(begin).time;
      for (std::size_t i = 0; i < asked.size(); ++i) {
        double a = 0, b = 0, c = -r * r;
        for (int k = 0; k < 3; ++k) {
          const double x = asked.x[k][i], v = asked.v[k][i];
          a += v * v, b += x * v, c += x * x;
        }
        const double root = std::sqrt(b * b - a * c);  // NaN: a miss
        time[i] = b < 0 ? c / (root - b) : NAN;
      }
      return time[0];
    };
  }

  std::size_t size() const { return queries_.size(); }
  double share_left() const { return asked_ ? static_cast<double>(left_) / static_cast<double>(asked_) : 0; }

 private:
  Scene scene_;
  Reduction single_;
  std::vector<Query> queries_;
  QueryTable table_;
  FlightTable flights_;
  std::vector<std::unique_ptr<Batch>> batches_;
  std::unique_ptr<oracle::CertifiedBatch> certified_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<oracle::Oracle> oracle_;
  std::vector<std::size_t> uncertain_;
  std::size_t left_ = 0, asked_ = 0;
};

struct Ratio {
  std::string name;
  double low, median, high;  // quartiles of time(one) / time(other)
  double one_ns, other_ns;   // medians per query
  double left;               // share of queries that vector lanes left to single flights
};

double quantile(std::vector<double> values, double share) {
  const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

volatile double g_sink;

double ns_of(const Work& work, std::size_t begin, std::size_t end) {
  const auto start = std::chrono::steady_clock::now();
  g_sink = work(begin, end);
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
         static_cast<double>(end - begin);
}

class Measurement {
 public:
  Measurement(double seconds, std::string only) : seconds_(seconds), only_(std::move(only)) {}

  // Alternates block by block for the given seconds. An interruption affects only one ratio of many.
  void measure(const std::string& name, Ground& ground, const Work& one, const Work& other,
               std::size_t block = kBlock) {
    if (name.find(only_) == std::string::npos) return;
    std::vector<double> ratios, ones, others;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t begin = 0;; begin = (begin + block) % ground.size()) {
      const std::size_t end = std::min(begin + block, ground.size());
      ones.push_back(ns_of(one, begin, end)), others.push_back(ns_of(other, begin, end));
      ratios.push_back(ones.back() / others.back());
      const bool enough =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds_;
      if (enough && ratios.size() >= 9) break;
    }
    results.push_back({name, quantile(ratios, 0.25), quantile(ratios, 0.5), quantile(ratios, 0.75),
                       quantile(ones, 0.5), quantile(others, 0.5), ground.share_left()});
    const Ratio& last = results.back();
    fmt::print(stderr, "{:<58} {:8.3f} ({:.3f} to {:.3f})  {:.1f} and {:.1f} ns\n", name, last.median,
               last.low, last.high, last.one_ns, last.other_ns);
  }

  std::vector<Ratio> results;

 private:
  double seconds_;
  std::string only_;
};

std::string at(double r) {
  return fmt::format("r = {:g}", r);
}

// One flight at a time / in batches, by scene, radius, difficulty and instruction set.
void measure_batches(Measurement& measurement) {
  using starts::Kind;
  const std::vector<Place> places{{"square", [](double r) { return unit_scene(2, r); }},
                                  {"hexagonal", hexagonal},
                                  {"ellipse", ellipse},
                                  {"motif of 4 in the plane", [](double r) { return motif(2, r); }},
                                  {"cubic", [](double r) { return unit_scene(3, r); }},
                                  {"fcc", fcc},
                                  {"triclinic", triclinic},
                                  {"ellipsoid", ellipsoid},
                                  {"motif of 4 in space", [](double r) { return motif(3, r); }}};
  for (const std::string& instructions : Batch::instruction_sets()) {
    if (instructions == "none") continue;
    for (const Place& place : places)
      for (const double r : {0.3, 0.1, 1e-3, 1e-6}) {
        if (Reduction::beyond(place.scene(r))) continue;
        Ground ground(place.scene(r), Kind::uniform);
        measurement.measure(fmt::format("single / batch {}: {}, {}", instructions, place.name, at(r)), ground,
                            ground.single(), ground.batch(instructions));
      }
    for (const Kind kind : {Kind::near_rational, Kind::grazing})
      for (const int dimension : {2, 3}) {
        Ground ground(unit_scene(dimension, 0.1), kind);
        measurement.measure(
            fmt::format("single / batch {}: {} {}D, {}", instructions, name_of(kind), dimension, at(0.1)),
            ground, ground.single(), ground.batch(instructions));
      }
  }
}

void measure_engines(Measurement& measurement) {
  using starts::Kind;
  for (const double r : {0.1, 1e-3, 1e-6}) {
    Ground square(unit_scene(2, r), Kind::uniform);
    const Work bare = square.bare_continued_fraction(r);
    measurement.measure("reduction / bare continued fraction: square, " + at(r), square, square.single(),
                        bare);
    measurement.measure("batch / bare continued fraction: square, " + at(r), square, square.batch(""), bare);
    for (const int dimension : {2, 3}) {
      Ground ground(unit_scene(dimension, r), Kind::uniform);
      const std::string where = fmt::format("{}D, {}", dimension, at(r));
      measurement.measure("certified-batch / batch: " + where, ground, ground.certified_batch(),
                          ground.batch(""));
      measurement.measure("oracle / reduction: " + where, ground, ground.oracle(), ground.single(), 64);
    }
  }
  for (const int dimension : {2, 3}) {
    Scene ball = unit_scene(dimension, 1);
    ball.lattices[0].vectors = {}, ball.lattices[0].rank = 0;
    Ground ground(ball, Kind::uniform);
    for (const std::string& instructions : Batch::instruction_sets())
      if (instructions != "none")
        measurement.measure(fmt::format("batch {} / plain loop: a ball, {}D", instructions, dimension),
                            ground, ground.batch(instructions), ground.plain_ball(1));
    measurement.measure(fmt::format("certified-batch / plain loop: a ball, {}D", dimension), ground,
                        ground.certified_batch(), ground.plain_ball(1));
  }
  Ground plane(unit_scene(2, 1e-6), Kind::uniform), space(unit_scene(3, 1e-2), Kind::uniform, 256);
  measurement.measure("published / reduction: 2D, r = 1e-06", plane, plane.engine("published"),
                      plane.single());
  measurement.measure("published / reduction: 3D, r = 0.01", space, space.engine("published"), space.single(),
                      32);
  for (const int dimension : {2, 3}) {
    const std::size_t count = dimension == 2 ? 1 << 19 : 1 << 16;  // about 25 ms
    Ground ground(unit_scene(dimension, 1e-3), Kind::uniform, count);
    measurement.measure(fmt::format("one thread / two: {}D, r = 0.001", dimension), ground,
                        ground.batch("", 1), ground.batch("", 2), count);
  }
}

// Writes one line per ratio: name, median and quartiles, separated by tabs.
void write(const std::string& path, const std::vector<Ratio>& results) {
  std::ofstream out(path);
  out << "# time(one) / time(other): name, median, quartiles. Made by build/speed_ratios --write\n";
  for (const Ratio& one : results)
    out << fmt::format("{}\t{:.4g}\t{:.4g}\t{:.4g}\n", one.name, one.median, one.low, one.high);
}

// Reports ratios that became worse beyond the quartiles of both runs.
int compare_with(const std::string& path, const std::vector<Ratio>& results) {
  std::ifstream in(path);
  if (!in) {
    fmt::print(stderr, "speed_ratios: {}: cannot be read\n", path);
    return 3;
  }
  std::map<std::string, std::array<double, 3>> before;
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::string name;
    std::array<double, 3> numbers;
    if (line.starts_with('#') || !std::getline(fields, name, '\t')) continue;
    if (fields >> numbers[0] >> numbers[1] >> numbers[2]) before[name] = numbers;
  }
  int worse = 0, known = 0;
  for (const Ratio& now : results) {
    const auto then = before.find(now.name);
    if (then == before.end()) continue;
    ++known;
    // A larger ratio is better for `single / batch`, `published / reduction` and `one thread / two`. A
    // smaller one is better for `oracle / ..`, `certified / ..` and the ratios to the bare continued fraction
    // and the plain loop.
    const bool less_is_better = now.name.find(" / bare") != std::string::npos ||
                                now.name.find(" / plain") != std::string::npos ||
                                now.name.starts_with("certified") || now.name.starts_with("oracle");
    const bool is_worse =
        less_is_better ? now.low > then->second[2] * 1.05 : now.high < then->second[1] / 1.05;
    if (!is_worse) continue;
    ++worse;
    fmt::print("worse: {}: {:.3g} ({:.3g} to {:.3g}), was {:.3g} ({:.3g} to {:.3g})\n", now.name, now.median,
               now.low, now.high, then->second[0], then->second[1], then->second[2]);
  }
  fmt::print("{} of {} ratios are worse than in {}\n", worse, known, path);
  return worse ? 1 : 0;
}

constexpr const char* kUsage =
    "usage: speed_ratios [--seconds S] [--only TEXT] [--compare FILE] [--write FILE]\n"
    "  ratios of times, measured in alternating turns; S seconds each (1)\n"
    "  --compare FILE   which are worse than those of FILE: status 1 if any\n"
    "  --write FILE     writes them for --compare\n";

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> options{{"--seconds", "1"}, {"--only", ""}};
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    const bool known = name == "--seconds" || name == "--only" || name == "--compare" || name == "--write";
    if (!known || i + 1 == argc) {
      fmt::print(name == "--help" ? stdout : stderr, "{}", kUsage);
      return name == "--help" ? 0 : 2;
    }
    options[name] = argv[i + 1];
  }
  Measurement measurement(std::atof(options["--seconds"].c_str()), options["--only"]);
  measure_batches(measurement);
  measure_engines(measurement);
  if (options.contains("--write")) write(options["--write"], measurement.results);
  return options.contains("--compare") ? compare_with(options["--compare"], measurement.results) : 0;
}
