#include <algorithm>

#include <lorentz/trajectory_batch.hpp>
#include "src/trajectory/motion.hpp"

namespace lorentz {

struct Particles::Inside {
  template <class T>
  using Column = std::array<T, kTogether>;

  const Batch& engine;
  Precision precision;
  AnyMotion motion;
  Column<Inquiry> asked;
  std::array<Column<double>, 3> x, v;
  Column<double> max_time;
  Column<std::int32_t> from_lattice, from_atom, lattice, atom;
  std::array<Column<std::int64_t>, 3> from_cell, cell;
  Column<Outcome> outcome;

  Inside(const Batch& with, const Scene& scene, Precision in)
      : engine(with), precision(in), motion(scene, in) {}

  void ask(const Particle& particle, std::size_t k, double until);
  void fly(std::size_t count, bool limited);
  Flight flight(std::size_t k) const {
    return {.outcome = outcome[k],
            .lattice = lattice[k],
            .atom = atom[k],
            .cell = {cell[0][k], cell[1][k], cell[2][k]}};
  }
};

void Particles::Inside::ask(const Particle& particle, std::size_t k, double until) {
  for (int i = 0; i < 3; ++i) {
    x[i][k] = asked[k].x[i], v[i][k] = asked[k].v[i];
    from_cell[i][k] = asked[k].cell[i];
  }
  from_lattice[k] = particle.leaves ? particle.lattice : -1;
  from_atom[k] = particle.atom;
  max_time[k] = flight_limit(particle, until);
}

void Particles::Inside::fly(std::size_t count, bool limited) {
  QueryColumns queries;
  FlightColumns flights;
  const auto some = [count](auto& column) { return std::span(column).first(count); };
  for (int i = 0; i < 3; ++i) {
    queries.x[i] = some(x[i]), queries.v[i] = some(v[i]);
    queries.from_cell[i] = some(from_cell[i]);
    flights.cell[i] = some(cell[i]);
  }
  if (limited) queries.max_time = some(max_time);
  queries.from_lattice = some(from_lattice), queries.from_atom = some(from_atom);
  flights.outcome = some(outcome);
  flights.lattice = some(lattice), flights.atom = some(atom);
  engine.fly(queries, flights);
}

Particles::Particles(const Batch& engine, const Scene& scene, Precision precision)
    : inside_(std::make_unique<Inside>(engine, scene, precision)), collisions_(kTogether) {}
Particles::~Particles() = default;
Particles::Particles(Particles&&) noexcept = default;
Particles& Particles::operator=(Particles&&) noexcept = default;

void Particles::add(const Query& start) {
  add(inside_->motion.places().at(start, inside_->precision));
}

void Particles::add(const Particle& particle) {
  inside_->motion.places().check(particle);
  going_.push_back(particles_.size());
  particles_.push_back(particle);
  stops_.push_back(Stop::none);
}

void Particles::clear() {
  particles_.clear();
  stops_.clear();
  going_.clear();
}

std::size_t Particles::fly(std::size_t begin, double until) {
  const std::size_t count = std::min(kTogether, going_.size() - begin);
  Inside& inside = *inside_;
  std::visit(
      [&](const auto& motion) {
        for (std::size_t k = 0; k < count; ++k) {
          const Particle& particle = particles_[going_[begin + k]];
          inside.asked[k] = motion.asked(particle);
          inside.ask(particle, k, until);
        }
        inside.fly(count, until < HUGE_VAL);
        for (std::size_t k = 0; k < count; ++k) {
          const std::size_t i = going_[begin + k];
          stops_[i] = motion.end(particles_[i], inside.asked[k], inside.flight(k), until, collisions_[k]);
        }
      },
      inside.motion);
  return count;
}

std::size_t Particles::leave_stopped() {
  std::erase_if(going_, [this](std::size_t i) { return stops_[i] != Stop::none; });
  return going_.size();
}

}  // namespace lorentz
