#include <lorentz/trajectory.hpp>

#include <lorentz/reduction.hpp>
#include "src/trajectory/motion.hpp"

namespace lorentz {

struct Trajectory::Inside {
  AskFirstHit ask;
  const Reduction* reduction = nullptr;  ///< if set, used instead of `ask`
  AnyMotion motion;
  Query query;
  Answer answer;

  Inside(const Scene& scene, Precision precision) : motion(scene, precision) {}
};

namespace {

void set(const Particle& particle, const Inquiry& asked, Query& query) {
  query.x = asked.x, query.v = asked.v;
  if (!particle.leaves) {
    query.from.reset();
    return;
  }
  if (!query.from) query.from.emplace();
  query.from->lattice = particle.lattice, query.from->atom = particle.atom;
  for (int i = 0; i < 3; ++i) query.from->cell[i] = asked.cell[i];
}

// A negative index becomes a very large one, which is not in the scene, either.
bool has(const Scene& scene, const ObstacleId& obstacle) {
  const auto lattice = static_cast<std::size_t>(obstacle.lattice),
             atom = static_cast<std::size_t>(obstacle.atom);
  return lattice < scene.lattices.size() && atom < scene.lattices[lattice].atoms.size();
}

// Sets the flight to the answer, or to an error if there is no such obstacle; false if its cell is beyond 64
// bits.
bool set(const Answer& answer, const Scene& scene, Flight& flight) {
  flight.outcome = answer.outcome;
  if (answer.outcome != Outcome::hit) return true;
  if (!has(scene, answer.obstacle)) {
    flight.outcome = Outcome::error;
    return true;
  }
  flight.lattice = answer.obstacle.lattice, flight.atom = answer.obstacle.atom;
  bool fits = true;
  for (int i = 0; i < 3; ++i) {
    fits &= answer.obstacle.cell[i].fits_int64();
    flight.cell[i] = answer.obstacle.cell[i].int64();
  }
  return fits;
}

}  // namespace

// ---- The flight and its outcome

Trajectory::Trajectory(const Engine& engine, const Scene& scene, const Query& start, Precision precision)
    : Trajectory([&engine](const Query& query, double max_time,
                           Answer& answer) { engine.first_hit(query, max_time, answer); },
                 scene, start, precision) {
  inside_->reduction = dynamic_cast<const Reduction*>(&engine);
}

Trajectory::Trajectory(AskFirstHit ask, const Scene& scene, const Query& start, Precision precision)
    : inside_(std::make_unique<Inside>(scene, precision)) {
  inside_->ask = std::move(ask);
  particle_ = inside_->motion.places().at(start, precision);
}

Trajectory::~Trajectory() = default;
Trajectory::Trajectory(Trajectory&&) noexcept = default;
Trajectory& Trajectory::operator=(Trajectory&&) noexcept = default;

void Trajectory::set_state(const Particle& particle) {
  inside_->motion.places().check(particle);
  particle_ = particle;
  stop_ = Stop::none;
}

bool Trajectory::advance(double until) {
  stop_ = std::visit([&](const auto& motion) { return advance(motion, until); }, inside_->motion);
  return stop_ == Stop::none;
}

template <class Motion>
Stop Trajectory::advance(const Motion& motion, double until) {
  const Inquiry asked = motion.asked(particle_);
  Query& query = inside_->query;
  Answer& answer = inside_->answer;
  set(particle_, asked, query);
  Flight flight;
  if (inside_->reduction) {
    flight = inside_->reduction->fly(query, flight_limit(particle_, until));
  } else {
    inside_->ask(query, flight_limit(particle_, until), answer);
    if (!set(answer, motion.places().scene(), flight)) return Stop::overflow;
  }
  const Stop stop = motion.end(particle_, asked, flight, until, collision_);
  if (stop == Stop::error)
    message_ =
        answer.outcome == Outcome::error ? answer.message : "the engine named an atom that is not there";
  return stop;
}

Vec Trajectory::place() const {
  return rounded(inside_->motion.places().place(particle_));
}

const char* name_of(Stop stop) {
  constexpr const char* kNames[] = {"none",   "collisions", "time",   "condition", "never", "later",
                                    "inside", "undecided",  "missed", "overflow",  "error"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Stop::error) + 1);
  return kNames[static_cast<int>(stop)];
}

}  // namespace lorentz
