#include <lorentz/trajectory.hpp>

#include <variant>

#include <lorentz/reduction.hpp>
#include "src/trajectory/motion.hpp"

namespace lorentz {

struct Trajectory::Inside {
  AskFirstHit ask;
  const Reduction* reduction = nullptr;  ///< if set, used instead of `ask`
  std::variant<Motion<double>, Motion<Wide>> motion;
  Query query;
  Answer answer;

  Inside(const Scene& scene, Precision precision)
      : motion(precision == Precision::binary64
                   ? std::variant<Motion<double>, Motion<Wide>>(std::in_place_index<0>, scene)
                   : std::variant<Motion<double>, Motion<Wide>>(std::in_place_index<1>, scene)) {}

  const Places& places() const {
    return std::visit([](const auto& one) -> const Places& { return one.places(); }, motion);
  }
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

// What the engine answered about a flight.
struct Heard {
  Outcome outcome = Outcome::error;
  Named named{};
  bool overflow = false;
};

// A negative index becomes a very large one, which is not in the scene, either.
bool has(const Scene& scene, const ObstacleId& obstacle) {
  const auto lattice = static_cast<std::size_t>(obstacle.lattice),
             atom = static_cast<std::size_t>(obstacle.atom);
  return lattice < scene.lattices.size() && atom < scene.lattices[lattice].atoms.size();
}

Heard heard(const Flight& flight) {
  return {flight.outcome, {flight.lattice, flight.atom, flight.cell}, false};
}

Heard heard(const Answer& answer, const Scene& scene) {
  Heard all{answer.outcome, {answer.obstacle.lattice, answer.obstacle.atom, {}}, false};
  if (answer.outcome != Outcome::hit) return all;
  if (!has(scene, answer.obstacle)) return {};
  for (int i = 0; i < 3; ++i) {
    all.overflow |= !answer.obstacle.cell[i].fits_int64();
    all.named.cell[i] = answer.obstacle.cell[i].int64();
  }
  return all;
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
  particle_ = inside_->places().at(start, precision);
}

Trajectory::~Trajectory() = default;
Trajectory::Trajectory(Trajectory&&) noexcept = default;
Trajectory& Trajectory::operator=(Trajectory&&) noexcept = default;

void Trajectory::set_state(const Particle& particle) {
  inside_->places().check(particle);
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
  Heard of_flight;
  if (inside_->reduction) {
    of_flight = heard(inside_->reduction->fly(query, flight_limit(particle_, until)));
  } else {
    inside_->ask(query, flight_limit(particle_, until), answer);
    of_flight = heard(answer, motion.places().scene());
  }
  switch (of_flight.outcome) {
    case Outcome::hit:
      if (of_flight.overflow) return Stop::overflow;
      return motion.meet(particle_, asked, of_flight.named, until, collision_);
    case Outcome::never:
      return motion.fly_on(particle_, until, Stop::never);
    case Outcome::later:
      return motion.fly_on(particle_, until, Stop::later);
    case Outcome::inside:
      return Stop::inside;
    case Outcome::undecided:
      return Stop::undecided;
    default:
      message_ =
          answer.outcome == Outcome::error ? answer.message : "the engine named an atom that is not there";
      return Stop::error;
  }
}

Vec Trajectory::place() const {
  const Point<Wide> place = inside_->places().place(particle_);
  return {place[0].value(), place[1].value(), place[2].value()};
}

const char* name_of(Stop stop) {
  switch (stop) {
    case Stop::none:
      return "none";
    case Stop::collisions:
      return "collisions";
    case Stop::time:
      return "time";
    case Stop::condition:
      return "condition";
    case Stop::never:
      return "never";
    case Stop::later:
      return "later";
    case Stop::inside:
      return "inside";
    case Stop::undecided:
      return "undecided";
    case Stop::missed:
      return "missed";
    case Stop::overflow:
      return "overflow";
    default:
      return "error";
  }
}

}  // namespace lorentz
