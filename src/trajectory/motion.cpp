#include "src/trajectory/motion.hpp"

#include <lorentz/geometry.hpp>

namespace lorentz {
namespace {

// dual_of, for both kinds of numbers.
template <class Real>
std::array<Point<Real>, 3> inverse_of(const std::array<Point<Real>, 3>& axes) {
  const Real volume = inner(axes[0], outer(axes[1], axes[2]));
  std::array<Point<Real>, 3> dual;
  for (int i = 0; i < 3; ++i) dual[i] = times(Real(1) / volume, outer(axes[(i + 1) % 3], axes[(i + 2) % 3]));
  return dual;
}

template <class Real>
MeetingShape<Real> shape_of(const Atom& atom, int dimension) {
  MeetingShape<Real> shape;
  shape.ball = atom.is_ball();
  shape.radius = Real(shape.ball ? atom.radius : 1);
  if (shape.ball) return shape;
  for (int i = 0; i < 3; ++i) shape.axes[i] = joined<Real>(i < dimension ? atom.semiaxes[i] : Vec{0, 0, 1});
  shape.dual = inverse_of<Real>(shape.axes);
  shape.inverse_size = 0;
  for (int i = 0; i < dimension; ++i) shape.inverse_size += length(high_part(shape.dual[i]));
  return shape;
}

// True beyond 2^53, where binary64 no longer holds every integer.
bool is_far(std::int64_t n) {
  constexpr std::int64_t kFar = std::int64_t{1} << 53;
  return n > kFar || n < -kFar;
}

template <class Real>
void put(const Point<Real>& a, Vec& high, Vec& low) {
  high = high_part(a), low = low_part(a);
}

void pass(Particle& particle, Wide flight) {
  const Wide time = Wide(particle.time, particle.time_low) + flight;
  particle.time = time.hi, particle.time_low = time.lo;
}

Wide time_left(const Particle& particle, double until) {
  return (Wide(until) - Wide(particle.time)) - Wide(particle.time_low);
}

// Moves the particle to the time `until`, but never back in time.
template <class Real>
void move(Particle& particle, double until) {
  const Wide left = time_left(particle, until);
  if (!(left.hi > 0)) return;
  const Point<Real> v = joined<Real>(particle.velocity, particle.velocity_low);
  put(plus(joined<Real>(particle.offset, particle.offset_low), joined<Real>(left.hi, left.lo), v),
      particle.offset, particle.offset_low);
  particle.time = until, particle.time_low = 0;
}

// One Newton step is enough, because the speed is off by only a few ulps.
template <class Real>
Point<Real> at_first_speed(const Point<Real>& v, const Particle& particle) {
  const Real square = joined<Real>(particle.speed_squared, particle.speed_squared_low);
  const Real excess = (inner(v, v) - square) / square;
  return times(Real(1) - Real(0.5) * excess, v);
}

template <class Real>
void tell(const Particle& before, const LineMeeting<Real>& meeting, Collision& collision) {
  const Vec normal = high_part(meeting.normal);
  const double size = length(normal);
  collision.flight = high_part(meeting.time);
  collision.arriving = before.velocity;
  collision.normal = scaled(normal, 1 / size);
  collision.cosine =
      std::max(0.0, dot(high_part(meeting.velocity), collision.normal)) / std::sqrt(before.speed_squared);
}

}  // namespace

template <class Real>
Motion<Real>::Motion(const Scene& scene) : places_(scene), one_lattice_(scene.lattices.size() == 1) {
  for (const Lattice& lattice : scene.lattices) {
    MotionRows& rows = lattices_.emplace_back();
    for (int i = 0; i < 3; ++i)
      rows.vectors[i] = joined<Real>(i < scene.dimension ? lattice.vectors[i] : Vec{});
    for (const Atom& atom : lattice.atoms)
      rows.obstacles.push_back({joined<Real>(atom.position), shape_of<Real>(atom, scene.dimension)});
  }
}

template <class Real>
Inquiry Motion<Real>::asked(const Particle& particle) const {
  if (one_lattice_) {
    const Point<Real>& position = lattices_[0].obstacles[particle.atom].position;
    return {sum(high_part(position), particle.offset), particle.velocity, {}};
  }
  const Point<Wide> place = places_.place(particle);
  return {high_part(place), particle.velocity, particle.cell};
}

// The vector from the centre of the obstacle from which the offset counts to the centre of the named one.
template <class Real>
Point<Real> Motion<Real>::step_at_home(const Particle& particle, const Flight& named) const {
  const MotionRows& rows = lattices_[0];
  Point<Real> step =
      plus(rows.obstacles[named.atom].position, Real(-1), rows.obstacles[particle.atom].position);
  for (int i = 0; i < places_.scene().dimension; ++i)
    step = plus(step, Real(static_cast<double>(named.cell[i])), rows.vectors[i]);
  return step;
}

template <class Real>
Point<Real> Motion<Real>::step_in_scene(const Particle& particle, const Flight& named) const {
  const Point<Wide> step = plus(places_.centre(named.lattice, named.atom, named.cell), Wide(-1),
                                places_.centre(particle.lattice, particle.atom, particle.cell));
  return joined<Real>(high_part(step), low_part(step));
}

template <class Real>
bool Motion<Real>::see(const Particle& particle, const Flight& named, Point<Real>& w,
                       std::array<std::int64_t, 3>& cell) const {
  cell = {};
  for (int i = 0; i < places_.scene().dimension; ++i) {
    if (is_far(named.cell[i])) return false;
    cell[i] = named.cell[i];
    if (one_lattice_ && __builtin_add_overflow(particle.cell[i], named.cell[i], &cell[i])) return false;
  }
  const Point<Real> step = one_lattice_ ? step_at_home(particle, named) : step_in_scene(particle, named);
  w = plus(joined<Real>(particle.offset, particle.offset_low), Real(-1), step);
  return true;
}

template <class Real>
Stop Motion<Real>::meet(Particle& particle, const Inquiry& asked, const Flight& named, double until,
                        Collision& collision) const {
  Point<Real> w;
  std::array<std::int64_t, 3> cell;
  if (!see(particle, named, w, cell)) return Stop::overflow;
  const double far = std::fabs(asked.x[0]) + std::fabs(asked.x[1]) + std::fabs(asked.x[2]);
  const LineMeeting<Real> meeting = meeting_of(lattices_[named.lattice].obstacles[named.atom].shape, w,
                                               joined<Real>(particle.velocity, particle.velocity_low), far);
  if (!meeting.on_the_line) return Stop::missed;
  const Wide flight(high_part(meeting.time), low_part(meeting.time));
  if (until < HUGE_VAL && (time_left(particle, until) - flight).hi < 0) {
    move<Real>(particle, until);
    return Stop::time;
  }
  tell(particle, meeting, collision);
  pass(particle, flight);
  particle.lattice = named.lattice, particle.atom = named.atom, particle.cell = cell;
  particle.leaves = true;
  put(meeting.offset, particle.offset, particle.offset_low);
  put(at_first_speed(meeting.velocity, particle), particle.velocity, particle.velocity_low);
  ++particle.collisions;
  return Stop::none;
}

template <class Real>
Stop Motion<Real>::end(Particle& particle, const Inquiry& asked, const Flight& flight, double until,
                       Collision& collision) const {
  switch (flight.outcome) {
    case Outcome::hit:
      return meet(particle, asked, flight, until, collision);
    case Outcome::never:
    case Outcome::later:
      if (!(until < HUGE_VAL)) return flight.outcome == Outcome::never ? Stop::never : Stop::later;
      move<Real>(particle, until);
      return Stop::time;
    case Outcome::inside:
      return Stop::inside;
    case Outcome::undecided:
      return Stop::undecided;
    default:
      return Stop::error;
  }
}

template class Motion<double>;
template class Motion<Wide>;

AnyMotion::AnyMotion(const Scene& scene, Precision precision)
    : variant(precision == Precision::binary64 ? variant(std::in_place_index<0>, scene)
                                               : variant(std::in_place_index<1>, scene)) {}

const Places& AnyMotion::places() const {
  return std::visit([](const auto& one) -> const Places& { return one.places(); }, *this);
}

}  // namespace lorentz
