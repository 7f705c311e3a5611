#include "statistics/rival/rival.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/exchange/exchange_number.hpp"

namespace lorentz::rival {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

// Another program is asked one query at a time, because the next query depends on its answer.
AskFirstHit ask_program(question::Answerer& program) {
  return [&program](const Query& query, double, Answer& answer) {
    program.on_reply([&](const question::Reply& reply) { answer = reply.answer; });
    program.ask("0", query);
    program.drain();
  };
}

bool is_same(const ObstacleId& obstacle, const Particle& particle, int dimension) {
  if (obstacle.lattice != particle.lattice || obstacle.atom != particle.atom) return false;
  for (int i = 0; i < dimension; ++i)
    if (!(obstacle.cell[i] == Integer(particle.cell[i]))) return false;
  return true;
}

double bits_in_common(const Vec& a, const Vec& b) {
  const double off = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  constexpr double kMost = std::numeric_limits<double>::digits;
  return off == 0 ? kMost : std::clamp(std::log2(std::hypot(b[0], b[1], b[2]) / off), 0.0, kMost);
}

}  // namespace

AskFirstHit asking(const question::EngineInfo& engine, const Scene& scene) {
  return [there = engine.in(scene)](const Query& query, double max_time, Answer& answer) {
    question::Reply reply;
    there.ask(query, {.max_time = max_time}, reply);
    answer = std::move(reply.answer);
  };
}

Rival::Rival(const question::EngineInfo& engine, question::Answerer* program, const RationalScene& scene,
             const Start& start)
    : scene_(oracle::nearest(scene)) {
  if (program && !program->is_in(scene_)) program->set_scene(scene_);
  if (program) program->try_again();
  const Query query = oracle::nearest(start);
  try {
    trajectory_ =
        std::make_unique<Trajectory>(program ? ask_program(*program) : asking(engine, scene_), scene_, query);
  } catch (const UnsupportedError& error) {
    throw InputError(std::string("--engine: ") + error.what());
  }
  path_.push_back(query.x);
}

void Rival::meet(const oracle::CertifiedCollision& truth) {
  if (diverged_) return;
  const std::uint64_t number = trajectory_->state().collisions + 1;
  const bool hit = trajectory_->advance();
  if (hit) path_.push_back(trajectory_->place());
  if (!hit || !is_same(truth.obstacle, trajectory_->state(), scene_.dimension)) {
    diverged_ = number;
    bits_right_ = 0;
    return;
  }
  bits_right_ = bits_in_common(trajectory_->state().offset, truth.offset);
}

void Rival::finish(const oracle::Arrival& truth, double until) {
  using oracle::JourneyEnd;
  if (diverged_ || truth.end == JourneyEnd::collisions || truth.end == JourneyEnd::undecided) return;
  const bool at_time = truth.end == JourneyEnd::time;
  const Stop right = at_time ? Stop::time : truth.end == JourneyEnd::never ? Stop::never : Stop::inside;
  // Below the time that was rounded, and finite: a flight that never ends reaches it.
  if (trajectory_->advance(at_time ? std::nextafter(until, 0) : kForEver) || trajectory_->stop() != right)
    diverged_ = truth.collisions + 1;
  path_.push_back(trajectory_->place());
}

void Rival::go_on(std::uint64_t collisions) {
  trajectory_->run(collisions, kForEver, [&](const Trajectory& trajectory) {
    path_.push_back(trajectory.place());
    return true;
  });
}

std::string Rival::stopped() const {
  const Stop stop = trajectory_->stop();
  if (!diverged_ || stop == Stop::none || stop == Stop::collisions) return "";
  return name_of(stop);
}

Vec place_of(const Scene& scene, const oracle::CertifiedCollision& collision) {
  const Lattice& lattice = scene.lattices[collision.obstacle.lattice];
  Vec place = lattice.atoms[collision.obstacle.atom].position;
  for (int k = 0; k < 3; ++k) place[k] += collision.offset[k];
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < 3; ++k)
      place[k] += *nearest_decimal(collision.obstacle.cell[i].decimal()) * lattice.vectors[i][k];
  return place;
}

}  // namespace lorentz::rival
