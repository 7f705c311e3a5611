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

// The low part is kept in a state of Wide numbers.
template <class Real, class In>
void put(const Point<In>& a, Vec& high, Vec& low) {
  high = high_part(a);
  if constexpr (std::is_same_v<Real, Wide>) low = low_part(a);
}

template <class Real>
double size_of(const Point<Real>& a) {
  return std::fabs(high_part(a[0])) + std::fabs(high_part(a[1])) + std::fabs(high_part(a[2]));
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
  put<Real>(plus(joined<Real>(particle.offset, particle.offset_low), joined<Real>(left.hi, left.lo), v),
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
template <class In>
Motion<Real>::MotionRows<In>::MotionRows(const Lattice& lattice, int dimension) {
  for (int i = 0; i < 3; ++i) vectors[i] = joined<In>(i < dimension ? lattice.vectors[i] : Vec{});
  for (const Atom& atom : lattice.atoms)
    obstacles.push_back({joined<In>(atom.position), shape_of<In>(atom, dimension)});
}

template <class Real>
Motion<Real>::Motion(const Scene& scene) : places_(scene), one_lattice_(scene.lattices.size() == 1) {
  for (const Lattice& lattice : scene.lattices) {
    std::get<0>(rows_).emplace_back(lattice, scene.dimension);
    std::get<1>(rows_).emplace_back(lattice, scene.dimension);
  }
}

template <class Real>
Inquiry Motion<Real>::asked(const Particle& particle) const {
  if (one_lattice_) {
    const Point<Real>& position = rows<Real>(0).obstacles[particle.atom].position;
    return {sum(high_part(position), particle.offset), particle.velocity, {}};
  }
  const Point<Wide> place = places_.place(particle);
  return {high_part(place), particle.velocity, particle.cell};
}

// The cell in the scene of the obstacle that the engine named. Nothing if it has no 64 bits, or if it is so
// far away that binary64 does not hold every integer.
template <class Real>
std::optional<std::array<std::int64_t, 3>> Motion<Real>::cell_of(const Particle& particle,
                                                                 const Flight& named) const {
  constexpr std::int64_t kFar = std::int64_t{1} << 53;
  std::array<std::int64_t, 3> cell{};
  for (int i = 0; i < places_.scene().dimension; ++i) {
    if (named.cell[i] > kFar || named.cell[i] < -kFar) return std::nullopt;
    cell[i] = named.cell[i];
    if (one_lattice_ && __builtin_add_overflow(particle.cell[i], named.cell[i], &cell[i]))
      return std::nullopt;
  }
  return cell;
}

// The vector from the centre of the obstacle from which the offset counts to the centre of the named one.
template <class Real>
template <class In>
Point<In> Motion<Real>::step_to(const Particle& particle, const Flight& named,
                                const std::array<std::int64_t, 3>& cell) const {
  if (one_lattice_) {
    const MotionRows<In>& lattice = rows<In>(0);
    Point<In> step =
        plus(lattice.obstacles[named.atom].position, In(-1), lattice.obstacles[particle.atom].position);
    for (int i = 0; i < places_.scene().dimension; ++i)
      step = plus(step, In(static_cast<double>(named.cell[i])), lattice.vectors[i]);
    return step;
  }
  const Point<Wide> step = plus(places_.centre(named.lattice, named.atom, cell), Wide(-1),
                                places_.centre(particle.lattice, particle.atom, particle.cell));
  return joined<In>(high_part(step), low_part(step));
}

// The collision, computed with numbers In. Two errors are held against the obstacle's size. `told`: the engine
// was asked about a line that may be so far from this one. `own`: rounding here. A particle stops where either
// is more than 2^-10 of the size; from 2^-20 on, what binary64 loses is not lost by Wide.
template <class Real>
template <class In>
Stop Motion<Real>::meet(Particle& particle, const Inquiry& asked, const Flight& named, double until,
                        Collision& collision) const {
  constexpr bool of_binary64 = std::is_same_v<Real, double>, in_binary64 = std::is_same_v<In, double>;
  const auto cell = cell_of(particle, named);
  if (!cell) return Stop::overflow;
  const Point<In> w =
      plus(joined<In>(particle.offset, particle.offset_low), In(-1), step_to<In>(particle, named, *cell));
  const MeetingShape<In>& shape = rows<In>(named.lattice).obstacles[named.atom].shape;
  const double size = high_part(shape.radius) / shape.inverse_size, far = size_of(asked.x), way = size_of(w);
  const double told = 0x1p-53 * (of_binary64 ? far : far + way),
               own = (in_binary64 ? 0x1p-53 : 0x1p-100) * way;
  if (in_binary64 && own > 0x1p-20 * size) return meet<Wide>(particle, asked, named, until, collision);
  if (!(told + own <= 0x1p-10 * size)) return Stop::overflow;
  const LineMeeting<In> meeting =
      meeting_of(shape, w, joined<In>(particle.velocity, particle.velocity_low), 0x1p5 * (told + own));
  if (!meeting.on_the_line) return Stop::missed;
  const Wide flight(high_part(meeting.time), low_part(meeting.time));
  if (until < HUGE_VAL && (time_left(particle, until) - flight).hi < 0) {
    move<Real>(particle, until);
    return Stop::time;
  }
  tell(particle, meeting, collision);
  pass(particle, flight);
  particle.lattice = named.lattice, particle.atom = named.atom, particle.cell = *cell;
  particle.leaves = true;
  put<Real>(meeting.offset, particle.offset, particle.offset_low);
  put<Real>(at_first_speed(meeting.velocity, particle), particle.velocity, particle.velocity_low);
  ++particle.collisions;
  return Stop::none;
}

template <class Real>
Stop Motion<Real>::end(Particle& particle, const Inquiry& asked, const Flight& flight, double until,
                       Collision& collision) const {
  switch (flight.outcome) {
    case Outcome::hit:
      return meet<Real>(particle, asked, flight, until, collision);
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
