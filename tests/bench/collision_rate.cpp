// Collisions per second: for particles in a batch and one at a time, compared with the bare flights of the
// same engine. The ways alternate in turns, so that the load of the machine affects all alike.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <lorentz/trajectory_batch.hpp>
#include "question/starts/free_starts.hpp"

using namespace lorentz;

namespace {

constexpr std::size_t kParticles = 1024;

// A way to compute one collision or flight for each particle.
struct Way {
  std::string name;
  std::function<void()> act;
  std::vector<double> ns = {};  ///< per collision, for each turn
};

double quantile(std::vector<double> values, double share) {
  const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double ns_of(const std::function<void()>& act) {
  const auto start = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
         kParticles;
}

bool go_on(std::size_t, const Particle&, const Collision&) {
  return true;
}

// The particles of one scene, for all ways.
class Ground {
 public:
  Ground(int dimension, double r)
      : scene_(unit_scene(dimension, r)),
        engine_(scene_),
        particles_(engine_, scene_),
        wide_(engine_, scene_, Precision::double_double) {
    const std::vector<Query> starts =
        starts::free_starts(scene_, starts::Kind::uniform, starts::kDefaultSeed, kParticles);
    for (const Query& start : starts) {
      particles_.add(start);
      wide_.add(start);
      flights_of_.push_back(start);
      alone_.emplace_back(engine_.one_at_a_time(), scene_, start);
    }
    flights_.resize(kParticles);
    const std::string where = fmt::format("{}D, r = {:g}: ", dimension, r);
    ways_ = {{where + "bare flights of the batch engine",
              [this] { engine_.fly(flights_of_.columns(), flights_.columns()); }},
             {where + "particles in a batch", [this] { particles_.advance(HUGE_VAL, go_on); }},
             {where + "particles in a batch, double-double", [this] { wide_.advance(HUGE_VAL, go_on); }},
             {where + "one particle at a time", [this] {
                for (Trajectory& one : alone_) one.advance();
              }}};
  }
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;

  void turn() {
    for (Way& way : ways_) way.ns.push_back(ns_of(way.act));
  }
  const std::vector<Way>& ways() const { return ways_; }

 private:
  Scene scene_;
  Batch engine_;
  Particles particles_, wide_;
  QueryTable flights_of_;
  FlightTable flights_;
  std::vector<Trajectory> alone_;
  std::vector<Way> ways_;
};

}  // namespace

int main() {
  constexpr int kTurns = 300;
  std::vector<std::unique_ptr<Ground>> grounds;
  for (const auto& [dimension, r] : {std::pair{2, 0.1}, {2, 1e-5}, {3, 0.1}, {3, 1e-3}})
    grounds.push_back(std::make_unique<Ground>(dimension, r));
  for (int turn = 0; turn < kTurns; ++turn)
    for (auto& ground : grounds) ground->turn();
  fmt::print("{:<50} {:>8} {:>18} {:>12}\n", "", "ns", "quartiles", "million / s");
  for (const auto& ground : grounds)
    for (const Way& way : ground->ways())
      fmt::print("{:<50} {:8.1f} {:8.1f} to {:6.1f} {:12.2f}\n", way.name, quantile(way.ns, 0.5),
                 quantile(way.ns, 0.25), quantile(way.ns, 0.75), 1e3 / quantile(way.ns, 0.5));
  std::vector<double> ratios;
  const Way &near = grounds[0]->ways()[1], &far = grounds[1]->ways()[1];
  for (int turn = 0; turn < kTurns; ++turn) ratios.push_back(far.ns[turn] / near.ns[turn]);
  fmt::print("time of {} / {}: {:.3f} ({:.3f} to {:.3f})\n", far.name, near.name, quantile(ratios, 0.5),
             quantile(ratios, 0.25), quantile(ratios, 0.75));
  return 0;
}
