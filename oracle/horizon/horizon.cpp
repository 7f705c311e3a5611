#include <lorentz/horizon.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include <lorentz/errors.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/scene_check.hpp>
#include "oracle/exact/exact_query.hpp"
#include "oracle/exact/quadratic.hpp"
#include "oracle/exact/root_sums.hpp"
#include "oracle/horizon/channel_scene.hpp"
#include "oracle/horizon/slabs.hpp"
#include "oracle/integers/dyadic.hpp"

namespace lorentz::oracle {
namespace {

// The point of the middle plane that is nearest to the origin.
template <std::size_t D>
Vec middle_of(const Slab<D>& slab, long exponent) {
  // Roots with enough bits to place the middle within a small part of the gap, even if binary64 cannot
  // represent it.
  const Gap& gap = slab.gap;
  const unsigned long bits = 128 + 2 * static_cast<unsigned long>(bit_length(gap.low2 + gap.high2 + 1));
  const auto fine = [bits](const Z& a2) { return floor_sqrt(shifted_left(a2, 2 * bits)); };
  const Z middle = shifted_left(gap.low + gap.high, bits) + fine(gap.low2) - fine(gap.high2);
  return rounded<D>(middle * slab.normal, dot(slab.normal, slab.normal),
                    exponent - static_cast<long>(bits) - 1);
}

template <std::size_t D>
bool is_inside_slab(const Slab<D>& slab, const Vec& point, long exponent) {
  CommonExponent common;
  for (double component : point) {
    if (!std::isfinite(component)) return false;
    common.see(component);
  }
  const long fine = std::min(exponent, common.get()), shift = exponent - fine;
  const Z level = dot(slab.normal, scaled_vector<D>(point, fine));
  const Gap& gap = slab.gap;
  return sign_of(level - shifted_left(gap.low, shift), -1, shifted_left(gap.low2, 2 * shift)) > 0 &&
         sign_of(shifted_left(gap.high, shift) - level, -1, shifted_left(gap.high2, 2 * shift)) > 0;
}

// The indices of a lattice's planes, up to a sign.
template <std::size_t D>
ZVec<D> miller_indices(const ObstacleLattice<D>& lattice, const ZVec<D>& normal) {
  return primitive(lattice.given * normal);
}

// The sign that makes the first component that is not 0 positive.
template <std::size_t D>
int sign_of_name(const ZVec<D>& name) {
  return name < ZVec<D>{} ? -1 : 1;
}

Channel named(const ObstacleLattice<2>& lattice, const Slab<2>& slab, long exponent) {
  const ZVec<2> k = miller_indices(lattice, slab.normal), across{k[1], -k[0]};  // at a right angle to k
  const ZVec<2> g = sign_of_name(across) * across;
  Channel channel;
  channel.indices = to_cell(g);
  channel.vector = rounded<2>(combination(g, lattice.given), 1, exponent);
  return channel;
}

Channel named(const ObstacleLattice<3>& lattice, const Slab<3>& slab, long exponent) {
  const ZVec<3> k = miller_indices(lattice, slab.normal);
  const int sign = sign_of_name(k);
  Channel channel;
  channel.indices = to_cell(sign * k);
  channel.vector = rounded<3>(sign * slab.normal, lattice.period(slab.normal), -exponent);
  return channel;
}

template <std::size_t D>
Channel channel_of(const ChannelScene<D>& scene, const Slab<D>& slab) {
  Channel channel = named(scene.lattices[0], slab, scene.exponent);
  const Gap& gap = slab.gap;
  channel.width = round_rest(gap.width(), gap.low2, gap.high2, dot(slab.normal, slab.normal), scene.exponent);
  channel.point = middle_of<D>(slab, scene.exponent);
  channel.inside = is_inside_slab<D>(slab, channel.point, scene.exponent);
  channel.count = to_integer(slab.count);
  return channel;
}

double volume_of(const Atom& atom, int dimension) {
  const double unit_ball = dimension == 2 ? M_PI : 4 * M_PI / 3;
  if (atom.is_ball()) return unit_ball * std::pow(atom.radius, dimension);
  const auto& a = atom.semiaxes;
  return unit_ball * std::fabs(dimension == 2 ? lorentz::cross(a[0], a[1])[2]
                                              : lorentz::dot(a[0], lorentz::cross(a[1], a[2])));
}

// The reason why the volume that a scene leaves free is not simply that of the cell minus that of the
// obstacles; empty if it is.
std::string no_simple_volume(const Scene& scene) {
  if (scene.lattices.size() > 1) return "for one lattice only";
  const Contacts contacts = contacts_in(scene, 1000);
  for (const Contact& contact : contacts.found)
    if (contact.overlap) return description_of(contact);
  if (contacts.end != SearchEnd::complete) return "overlaps of obstacles: not all checked";
  return {};
}

// A uniform start in a channel of width w goes on for longer than t if its direction is within d / t of the
// channel's direction on one side and (w - d) / t on the other, with d the distance from a wall. This is a
// part w / (pi t) of all directions in 2D (a corridor has two ways along it), and w / (2 t) in 3D. The part
// w |k| of a cell's volume V is in the channel, where 1 / |k| is the distance between planes.
template <std::size_t D>
double tail_constant(const Scene& scene, const ChannelScene<D>& exact, const std::vector<Channel>& channels) {
  // In units of a power of two near the cell's size, because its volume may be beyond binary64. C is a
  // length.
  const Z& cell = exact.lattices[0].volume;
  constexpr int d = static_cast<int>(D);
  const int unit = static_cast<int>(std::floor(log2_of(cell)) / d + static_cast<double>(exact.exponent));
  const auto scaled = [unit](auto vectors) {
    for (Vec& a : vectors) a = times_power_of_two(a, -unit);
    return vectors;
  };
  const double volume = round_to_binary64({cell, 1, 0, 1, d * (exact.exponent - unit)});
  double sum = 0, free = volume;
  for (const Atom& atom : scene.lattices[0].atoms)
    free -= volume_of(Atom{{}, std::scalbn(atom.radius, -unit), scaled(atom.semiaxes)}, d);
  for (const Channel& channel : channels) {
    const double length = std::hypot(channel.vector[0], channel.vector[1], channel.vector[2]),
                 width = std::scalbn(channel.width, -unit);
    sum += (d == 2 ? std::scalbn(length, -unit) : volume * std::scalbn(length, unit)) * width * width;
  }
  return std::scalbn(sum / ((d == 2 ? M_PI : 2) * free), unit);
}

// The widest ways first. For equal widths, short vectors come first, and then the order is that of the
// components.
template <class Way>
void sort_by(double Way::*width, std::vector<Way>& ways) {
  const auto length = [](const Vec& a) { return std::hypot(a[0], a[1], a[2]); };
  std::stable_sort(ways.begin(), ways.end(), [&](const Way& a, const Way& b) {
    return std::tuple(-(a.*width), length(a.vector), b.vector) <
           std::tuple(-(b.*width), length(b.vector), a.vector);
  });
}

template <std::size_t D>
Horizon horizon_in(const Scene& scene, double min_width, bool with_cylinders,
                   const SearchProgress& progress) {
  const ChannelScene<D> exact(scene, min_width);
  Slabs<D> slabs = free_slabs(exact, progress);
  if (!slabs.refusal.empty()) throw TooManyChannels(slabs.refusal);
  Horizon horizon;
  horizon.dimension = scene.dimension, horizon.min_width = min_width;
  std::set<ZVec<D>> normals;
  for (const Slab<D>& slab : slabs.open) {
    normals.insert(slab.normal);
    horizon.channels.push_back(channel_of(exact, slab));
  }
  horizon.normals = normals.size();
  for (const ZVec<D>& normal : slabs.undecided)
    horizon.undecided.push_back(named(exact.lattices[0], Slab<D>{normal, {}, 1}, exact.exponent).indices);
  sort_by(&Channel::width, horizon.channels);
  const bool none = min_width <= 0 && horizon.channels.empty() && horizon.undecided.empty();
  horizon.no_tail_constant = none ? "" : min_width > 0 ? "not with a least width" : no_simple_volume(scene);
  if (none) {
    horizon.tail_constant = 0;
  } else if (horizon.no_tail_constant.empty()) {
    horizon.tail_constant = tail_constant(scene, exact, horizon.channels);
    if (!std::isfinite(*horizon.tail_constant)) {
      horizon.tail_constant.reset();
      horizon.no_tail_constant = "the volumes are beyond binary64";
    }
  }
  if constexpr (D == 3) {
    if (with_cylinders)
      find_cylinders(exact, horizon, progress);
    else
      horizon.no_cylinders = "not asked for";
    sort_by(&Cylinder::radius, horizon.cylinders);
  }
  return horizon;
}

}  // namespace

bool Horizon::is_infinite() const {
  const auto infinite = [](const CylinderFamily& family) { return family.infinite; };
  return !channels.empty() || !cylinders.empty() || std::any_of(families.begin(), families.end(), infinite);
}

bool Horizon::is_finite() const {
  return min_width == 0 && !is_infinite() && undecided.empty() && families.empty() && no_cylinders.empty();
}

Horizon horizon_of(const Scene& scene, double min_width, bool with_cylinders,
                   const SearchProgress& progress) {
  if (!(min_width >= 0 && std::isfinite(min_width)))
    throw InputError("min_width: needs a number, 0 or above");
  checked_exactly(scene);
  if (!is_crystal(scene))
    throw InputError(
        "horizon: of crystals only; rows, layers and single obstacles leave nearly all directions "
        "open");
  return scene.dimension == 2 ? horizon_in<2>(scene, min_width, false, progress)
                              : horizon_in<3>(scene, min_width, with_cylinders, progress);
}

}  // namespace lorentz::oracle
