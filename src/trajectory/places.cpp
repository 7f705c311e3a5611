// Starts, and places in the scene's coordinates.
#include <algorithm>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include "src/trajectory/motion.hpp"

namespace lorentz {
namespace {

constexpr double kSmallest = 0x1p-100, kLargest = 0x1p100;

// False for numbers that are not finite, too: 0 times them stays.
bool in_range(const Vec& a) {
  double largest = 0;
  for (const double component : a) largest = std::max(largest, std::fabs(component)) + 0 * component;
  return largest >= kSmallest && largest <= kLargest;
}

bool in_range(const Scene& scene) {
  bool good = true;
  for (const Lattice& lattice : scene.lattices) {
    for (int i = 0; i < lattice.rank_in(scene.dimension); ++i) good &= in_range(lattice.vectors[i]);
    for (const Atom& atom : lattice.atoms) {
      for (const double component : atom.position) good &= std::fabs(component) <= kLargest;
      for (int i = 0; i < scene.dimension; ++i) good &= in_range(semiaxes_of(atom, scene.dimension)[i]);
    }
  }
  return good;
}

}  // namespace

Places::Places(const Scene& scene) : scene_(scene) {
  checked(scene);
  if (!in_range(scene))
    throw UnsupportedError("trajectories are for scenes whose lengths lie between 2^-100 and 2^100");
}

// Sets the obstacle from which the offset counts: the one that is left, or one near the start.
void Places::set_home(const Query& start, Particle& particle) const {
  if (start.from) {
    particle.leaves = true;
    particle.lattice = start.from->lattice, particle.atom = start.from->atom;
    for (int i = 0; i < scene_.dimension; ++i) {
      if (!start.from->cell[i].fits_int64())
        throw UnsupportedError("a trajectory starts in a cell of 64 bits");
      particle.cell[i] = start.from->cell[i].int64();
    }
    return;
  }
  const int rank = scene_.lattices[0].rank_in(scene_.dimension);
  std::array<Vec, 3> vectors = scene_.lattices[0].vectors;
  complete_perpendicularly(vectors, rank, scene_.dimension);
  const Vec n = coordinates(dual_of(vectors, scene_.dimension), start.x);
  for (int i = 0; i < rank; ++i) {
    if (!(std::fabs(n[i]) < 0x1p53))
      throw UnsupportedError("a trajectory starts within 2^53 cells of the origin");
    particle.cell[i] = static_cast<std::int64_t>(std::round(n[i]));
  }
}

Particle Places::at(const Query& start, Precision precision) const {
  if (const auto flaw = flaw_of(start, scene_)) throw InputError("start: " + *flaw);
  if (!in_range(start.v)) throw UnsupportedError("trajectories are for speeds between 2^-100 and 2^100");
  Particle particle;
  set_home(start, particle);
  const Point<Wide> home = centre(particle.lattice, particle.atom, particle.cell), v = joined<Wide>(start.v);
  const Point<Wide> offset = plus(joined<Wide>(start.x), Wide(-1), home);
  const Wide square = inner(v, v);
  particle.velocity = start.v;
  particle.offset = rounded(offset), particle.speed_squared = square.value();
  if (precision == Precision::double_double)
    particle.offset_low = low_part(offset), particle.speed_squared_low = square.lo;
  return particle;
}

void Places::check_obstacle(const Particle& particle) const {
  checked(ObstacleId{particle.lattice, particle.atom, {}}, scene_);
}

void Places::check(const Particle& particle) const {
  check_obstacle(particle);
  const bool leaves_plane = scene_.dimension == 2 &&
                            (particle.offset[2] != 0 || particle.velocity[2] != 0 || particle.cell[2] != 0);
  if (leaves_plane) throw InputError("state: the third component must be zero in the plane");
  for (const double x : particle.offset)
    if (!(std::fabs(x) <= kLargest)) throw InputError("state: offset must be within 2^100");
  if (!in_range(particle.velocity)) throw InputError("state: velocity must be between 2^-100 and 2^100");
  if (!(particle.speed_squared > 0 && std::isfinite(particle.speed_squared)))
    throw InputError("state: speed_squared must be finite and above zero");
  if (!std::isfinite(particle.time)) throw InputError("state: time is not finite");
  double low = particle.time_low + particle.speed_squared_low;
  for (int k = 0; k < 3; ++k) low += particle.offset_low[k] + particle.velocity_low[k];
  if (!std::isfinite(low))
    throw InputError("state: offset_low, velocity_low, speed_squared_low and time_low must be finite");
}

Point<Wide> Places::centre(std::int32_t lattice, std::int32_t atom,
                           const std::array<std::int64_t, 3>& cell) const {
  Point<Wide> sum = joined<Wide>(scene_.lattices[lattice].atoms[atom].position);
  for (int i = 0; i < scene_.dimension; ++i)
    sum = plus(sum, wide(cell[i]), joined<Wide>(scene_.lattices[lattice].vectors[i]));
  return sum;
}

Point<Wide> Places::place(const Particle& particle) const {
  return plus(centre(particle.lattice, particle.atom, particle.cell), Wide(1),
              joined<Wide>(particle.offset, particle.offset_low));
}

Particle particle_at(const Scene& scene, const Query& start, Precision precision) {
  return Places(scene).at(start, precision);
}

Vec place_of(const Scene& scene, const Particle& particle) {
  const Places places(scene);
  places.check_obstacle(particle);
  return rounded(places.place(particle));
}

Vec displacement(const Scene& scene, const Particle& from, const Particle& to) {
  const Places places(scene);
  places.check_obstacle(from), places.check_obstacle(to);
  return rounded(plus(places.place(to), Wide(-1), places.place(from)));
}

}  // namespace lorentz
