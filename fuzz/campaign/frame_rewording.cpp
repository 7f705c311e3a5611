// Other coordinates, units and names for a scene, and one more dimension.
#include <algorithm>
#include <numeric>

#include "fuzz/campaign/exact_sums.hpp"
#include "fuzz/campaign/rewording_steps.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::fuzz {

using namespace cases;

namespace {

template <class TheScene, class F>
void for_each_vector(TheScene& scene, const F& lengths, const F& positions) {
  for (auto& lattice : scene.lattices) {
    for (int i = 0; i < scene.dimension; ++i) lengths(lattice.vectors[i]);
    for (auto& atom : lattice.atoms) {
      positions(atom.position);
      for (auto& axis : atom.semiaxes) lengths(axis);
    }
  }
}

Vec negated(Vec a) {
  for (double& component : a) component = component == 0 ? 0.0 : -component;
  return a;
}

// Sets x to its image, if that is made of binary64 values.
bool set_if(Vec& x, const std::optional<Vec>& image) {
  if (image) x = *image;
  return image.has_value();
}

template <class T>
void shuffle(Random& random, std::vector<T>& values) {
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random.below(i)]);
}

std::vector<int> drawn_order(Random& random, std::size_t count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  shuffle(random, order);
  return order;
}

// ---- coordinates exchanged and reflected

class FrameAxes {
 public:
  FrameAxes(Random& random, int dimension) {
    const std::vector<int> order = drawn_order(random, static_cast<std::size_t>(dimension));
    for (int i = 0; i < dimension; ++i) from_[i] = order[i], sign_[i] = random.one_in(2) ? -1 : 1;
  }
  bool changes() const {
    return from_ != std::array<int, 3>{0, 1, 2} || sign_ != std::array<int, 3>{1, 1, 1};
  }
  void turn(Vec& a) const {
    const Vec before = a;
    for (std::size_t i = 0; i < 3; ++i) a[i] = before[from_[i]] == 0 ? 0.0 : sign_[i] * before[from_[i]];
  }

 private:
  std::array<int, 3> from_{0, 1, 2}, sign_{1, 1, 1};
};

// ---- everything moved

// A translation that moves an atom to the origin, or one by numbers of few bits: in the cell, or far away.
Vec drawn_translation(Random& random, const Scene& scene) {
  const Lattice& lattice = scene.lattices[random.below(scene.lattices.size())];
  if (random.one_in(3)) return negated(lattice.atoms[random.below(lattice.atoms.size())].position);
  const Atom& atom = lattice.atoms[0];
  const Vec size_of = lattice.rank_in(scene.dimension) > 0 ? lattice.vectors[0]
                      : atom.is_ball()                     ? Vec{atom.radius}
                                                           : atom.semiaxes[0];
  const int unit =
      std::ilogb(std::max({std::fabs(size_of[0]), std::fabs(size_of[1]), std::fabs(size_of[2])}));
  const int size = static_cast<int>(random.one_in(2) ? random.integer(-4, 4) : random.integer(5, 50));
  Vec by{};
  for (int i = 0; i < scene.dimension; ++i)
    by[i] = std::ldexp(static_cast<double>(random.integer(-8, 8)), std::min(unit + size, 1000));
  return by;
}

// ---- other units

BitRange range_of(const Scene& scene) {
  BitRange range;
  const auto see = [&](const Vec& a) { range.see(a); };
  for_each_vector(scene, see, see);
  for_each_atom(scene, [&](const Atom& atom) { range.see(atom.radius); });
  return range;
}

// ---- other names

class AxisOrder {
 public:
  AxisOrder(Random& random, const Scene& scene) : lattices_(drawn_order(random, scene.lattices.size())) {
    for (const Lattice& lattice : scene.lattices) atoms_.push_back(drawn_order(random, lattice.atoms.size()));
  }

  // Lattice k of the new scene is lattices_[k] of the old one, its atom i is atoms_[..][i].
  Scene applied(const Scene& scene) const {
    Scene result{scene.dimension, {}};
    for (const int l : lattices_) {
      result.lattices.push_back({scene.lattices[l].vectors, {}, scene.lattices[l].rank});
      for (const int a : atoms_[l]) result.lattices.back().atoms.push_back(scene.lattices[l].atoms[a]);
    }
    return result;
  }
  void there(ObstacleId& id) const {
    id.atom = place_of(id.atom, atoms_[id.lattice]);
    id.lattice = place_of(id.lattice, lattices_);
  }
  void back(ObstacleId& id) const {
    id.lattice = lattices_[id.lattice];
    id.atom = atoms_[id.lattice][id.atom];
  }
  bool changes() const {
    return !std::is_sorted(lattices_.begin(), lattices_.end()) ||
           std::any_of(atoms_.begin(), atoms_.end(),
                       [](const auto& order) { return !std::is_sorted(order.begin(), order.end()); });
  }

 private:
  static int place_of(int value, const std::vector<int>& order) {
    return static_cast<int>(std::find(order.begin(), order.end(), value) - order.begin());
  }

  std::vector<int> lattices_;
  std::vector<std::vector<int>> atoms_;
};

// ---- one more dimension, other obstacles

// At most 2^40 times what is needed, or anything up to the end of the range.
double drawn_height(Random& random, int least) {
  if (random.one_in(8)) return std::ldexp(1, static_cast<int>(random.integer(least, kLargestExponent)));
  const auto more = static_cast<int>(random.one_in(2) ? random.below(3) : random.below(41));
  return std::ldexp(1, std::min(least + more, kLargestExponent));
}

std::vector<Vec> drawn_axes(Random& random, const std::vector<Vec>& axes) {
  std::vector<Vec> result;
  for (const int k : drawn_order(random, axes.size()))
    result.push_back(random.one_in(2) ? negated(axes[k]) : axes[k]);
  return result;
}

}  // namespace

std::optional<RewordingStep> draw_axes(Random& random, Scene& scene) {
  const FrameAxes axes(random, scene.dimension);
  if (!axes.changes()) return std::nullopt;
  const auto turn = [axes](Vec& a) { axes.turn(a); };
  for_each_vector(scene, turn, turn);
  return RewordingStep{.words = "axes", .reword = [turn](Vec& x, Vec& v) {
                         turn(x);
                         turn(v);
                         return true;
                       }};
}

std::optional<RewordingStep> draw_moved_scene(Random& random, Scene& scene) {
  const Vec by = drawn_translation(random, scene);
  if (by == Vec{}) return std::nullopt;
  const auto move = [by](Vec& a) { return set_if(a, exact_sum(a, 1, by)); };
  Scene moved = scene;
  for (Lattice& lattice : moved.lattices)
    for (Atom& atom : lattice.atoms)
      if (!move(atom.position)) return std::nullopt;
  scene = std::move(moved);
  return RewordingStep{.words = "scene moved", .reword = [move](Vec& x, Vec&) { return move(x); }};
}

std::optional<RewordingStep> draw_scaled(Random& random, Scene& scene) {
  const BitRange range = range_of(scene);
  // least <= 0 <= most, because the numbers are binary64 values as they are.
  const long least = kLeastExponent - range.lowest, most = kLargestExponent - range.highest;
  const std::int64_t anywhere = random.integer(least, most);
  const std::uint64_t kind = random.below(4);
  const long drawn = kind == 0   ? least + static_cast<long>(random.below(4))
                     : kind == 1 ? most - static_cast<long>(random.below(4))
                     : kind == 2 ? static_cast<long>(random.integer(-8, 8))
                                 : static_cast<long>(anywhere);
  const auto exponent = static_cast<int>(std::clamp(drawn, least, most));
  if (exponent == 0) return std::nullopt;
  scene = scaled(std::move(scene), exponent);
  return RewordingStep{.words = "lengths 2^" + std::to_string(exponent),
                       .reword = [=](Vec& x, Vec&) { return set_if(x, exact_scaled(x, exponent)); },
                       .time_exponent = exponent};
}

std::optional<RewordingStep> draw_order(Random& random, Scene& scene) {
  const AxisOrder order(random, scene);
  if (!order.changes()) return std::nullopt;
  scene = order.applied(scene);
  return RewordingStep{.words = "order",
                       .there = [order](ObstacleId& id) { order.there(id); },
                       .back = [order](ObstacleId& id) { order.back(id); }};
}

// A ball or an ellipsoid whose centre is in the plane z = 0 meets that plane in the disc or ellipse that it
// was. With a third vector (w, h), h more than twice any number of the scene, no obstacle of another layer
// comes near the plane. The layer 0 is the old lattice, whatever w is. A row, or single obstacles, stay what
// they were.
std::optional<RewordingStep> draw_plane_in_space(Random& random, Scene& scene) {
  if (scene.dimension != 2) return std::nullopt;
  const int least = static_cast<int>(range_of(scene).highest) + 2;
  if (least > kLargestExponent) return std::nullopt;
  for (Lattice& lattice : scene.lattices) {
    if (lattice.rank >= 2) {
      lattice.rank = 3;
      const double height = drawn_height(random, least);
      lattice.vectors[2] = {0, 0, random.one_in(2) ? -height : height};
      if (random.one_in(2))
        for (int i = 0; i < 2; ++i)
          lattice.vectors[2][i] = std::ldexp(static_cast<double>(random.integer(-8, 8)), least - 4);
    }
    for (Atom& atom : lattice.atoms)
      if (!atom.is_ball())
        atom.semiaxes.push_back(
            {0, 0, std::ldexp(1, std::max(least - 1 - static_cast<int>(random.below(10)), kLeastExponent))});
  }
  scene.dimension = 3;
  return RewordingStep{"plane in space"};
}

// A ball becomes an ellipsoid: r times a signed permutation of the unit vectors. The semiaxes of ellipsoids
// are exchanged and reflected.
std::optional<RewordingStep> draw_ellipsoids(Random& random, Scene& scene) {
  const Scene before = scene;
  for (Lattice& lattice : scene.lattices)
    for (Atom& atom : lattice.atoms) {
      if (atom.is_ball()) {
        if (random.one_in(4)) continue;
        for (int i = 0; i < scene.dimension; ++i) {
          atom.semiaxes.emplace_back();
          atom.semiaxes.back()[i] = atom.radius;
        }
        atom.radius = 0;
      }
      atom.semiaxes = drawn_axes(random, atom.semiaxes);
    }
  if (scene == before) return std::nullopt;
  return RewordingStep{"semiaxes"};
}

}  // namespace lorentz::fuzz
