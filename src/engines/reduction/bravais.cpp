#include "src/engines/reduction/bravais.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <lorentz/geometry.hpp>
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/formulas.hpp"
#include "src/engines/reduction/obstacle_unrounded.hpp"

namespace lorentz {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr const char* kTooSkewed = "does not do cells as skewed as this one";
constexpr const char* kOverlap = "does not do obstacles that reach over as many cells as this one";

Vec rounded(const WideVec& a) {
  return {a[0].hi, a[1].hi, a[2].hi};
}

Vec times(const Vec (&rows)[3], const Vec& a) {
  return {dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)};
}

// The metric that says which vectors are short: that of a shape, in which its ellipsoids are balls, or
// without a shape the usual one.
struct Metric {
  const Shape* shape = nullptr;

  Vec operator()(const Vec& a) const { return shape ? times(shape->to_ball, a) : a; }

  // The length of a linear form: its largest value on the unit ball.
  double length_of_form(const Vec& g) const {
    return shape ? length(times(shape->cofactor, g)) / shape->volume : length(g);
  }

  // At least the largest length of all a with |a| = 1.
  double size() const { return shape ? std::sqrt(shape->metric_size) * (1 + kAmple) : 1; }

  // The largest such length of all forms g with |g| = 1.
  double length_of_longest_form() const { return shape ? shape->cofactor_size / shape->volume : 1; }
};

// A basis while it is made shorter: integer combinations of the primitive vectors, recomputed from these at
// each step, so that no error accumulates.
struct Shortening {
  int rank;
  std::array<Vec, 3> primitive;
  Metric metric;
  double T[3][3]{};
  WideVec B[3];
  bool complete = true;  // no component was taken as zero

  Shortening(const Lattice& lattice, int d, double scale, Metric in)
      : rank(lattice.rank_in(d)), primitive(lattice.vectors), metric(in) {
    for (int i = 0; i < rank; ++i)
      for (double& component : primitive[i]) set_component(component, scale);
    complete_perpendicularly(primitive, rank, d);
    for (int i = d; i < 3; ++i) primitive[i] = Vec{double(i == 0), double(i == 1), double(i == 2)};
    for (int i = 0; i < 3; ++i) {
      T[i][i] = 1;
      recompute(i);
    }
  }

  void set_component(double& component, double scale) {
    const bool was_zero = component == 0;
    component *= scale;
    if (std::fabs(component) < kTinyVectorComponent) component = 0, complete &= was_zero;
  }

  void recompute(int i) {
    for (int k = 0; k < 3; ++k) {
      B[i][k] = Wide(0);
      for (int j = 0; j < 3; ++j) B[i][k] = B[i][k] + Wide::product(T[i][j], primitive[j][k]);
    }
  }

  // Are all components of B those of the scene's lattice, sums without rounding?
  bool is_exact() const {
    if (!complete) return false;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        double sum = 0;
        for (int j = 0; j < 3; ++j) {
          const Wide step = Wide::product(T[i][j], primitive[j][k]), next = Wide::sum(sum, step.hi);
          if (step.lo != 0 || next.lo != 0) return false;
          sum = next.hi;
        }
      }
    return true;
  }

  Vec seen(int i) const { return metric(rounded(B[i])); }

  // Subtracts from B_i the nearest integer combination of the shorter vectors; true if that shortens it.
  bool shorten(int i) {
    bool changed = false;
    for (int j = 0; j < rank; ++j) {
      if (j == i) continue;
      const Vec a = seen(i), b = seen(j);
      if (dot(b, b) > dot(a, a)) continue;
      const double k = std::nearbyint(dot(a, b) / dot(b, b));
      if (k == 0) continue;
      const auto before = std::to_array(T[i]);
      const WideVec old = B[i];
      for (int c = 0; c < 3; ++c) T[i][c] -= k * T[j][c];
      recompute(i);
      if (dot(seen(i), seen(i)) < dot(a, a)) {
        changed = true;
      } else {
        std::copy(before.begin(), before.end(), T[i]);
        B[i] = old;
      }
    }
    return changed;
  }

  void run() {
    for (int pass = 0; pass < kMaxShorteningPasses; ++pass) {
      bool changed = false;
      for (int i = 0; i < rank; ++i) changed |= shorten(i);
      if (!changed) break;
    }
    for (int i = 0; i < rank; ++i)  // shortest first
      for (int j = i + 1; j < rank; ++j)
        if (length(seen(j)) < length(seen(i))) {
          std::swap(B[i], B[j]);
          std::swap(T[i], T[j]);
        }
  }
};

void set_dual(Bravais& bravais) {
  const Vec b[3] = {rounded(bravais.basis[0]), rounded(bravais.basis[1]), rounded(bravais.basis[2])};
  const double volume = volume_of(b[0], cross_product(b[1], b[2]));
  for (int i = 0; i < 3; ++i) {
    bravais.dual[i] = cross_product(b[(i + 1) % 3], b[(i + 2) % 3]);
    for (double& component : bravais.dual[i]) component /= volume;
  }
  bravais.volume = std::fabs(volume);
  double defect = 1 / bravais.volume, shortest = kInfinity;
  for (int i = 0; i < 3; ++i) defect *= length(b[i]);
  for (int i = 0; i < bravais.rank; ++i) shortest = std::min(shortest, length(b[i]));
  bravais.coordinate_error = kCoordinate * kRoundoff * defect * defect / shortest;
  for (int i = bravais.rank; i < bravais.dimension; ++i) bravais.dual[i] = {};
}

// The error of the coordinates of points within half a cell of a lattice point.
double home_error(const Bravais& bravais) {
  double size = 0;
  for (int i = 0; i < bravais.rank; ++i)
    for (const Wide& component : bravais.basis[i]) size += std::fabs(component.hi);
  return kHomeCell * size * bravais.coordinate_error;
}

// Sets the inverse, by the adjugate. Entries of the transform are below 2^20, or the scene is unsupported.
// False if the determinant is not 1 or -1, because then integers were rounded on the way.
bool set_inverse(Bravais& bravais) {
  const auto& t = bravais.transform;
  const auto minor = [&](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return t[a][c] * t[b][d] - t[a][d] * t[b][c];
  };
  const std::int64_t determinant = t[0][0] * minor(0, 0) + t[0][1] * minor(0, 1) + t[0][2] * minor(0, 2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) bravais.inverse[i][j] = determinant * minor(j, i);
  return determinant == 1 || determinant == -1;
}

// Calls visit(t, length) for the vectors sum_i t_i B_i with coefficients of at most 1 in absolute value, one
// of each pair of opposite ones.
template <class Visit>
void visit_short(const Bravais& bravais, const Metric& metric, const Visit& visit) {
  const int second = bravais.rank >= 2, third = bravais.rank == 3;
  for (int a = 0; a <= 1; ++a)
    for (int b = -second; b <= second; ++b)
      for (int c = -third; c <= third; ++c) {
        if (a == 0 && b == 0 && c == 0) continue;
        Vec sum{};
        for (int k = 0; k < 3; ++k)
          sum[k] = a * bravais.basis[0][k].hi + b * bravais.basis[1][k].hi + c * bravais.basis[2][k].hi;
        visit(Vec{double(a), double(b), double(c)}, length(metric(sum)));
      }
}

// A lower bound on the length of the shortest lattice vector. A vector with a coefficient of 2 or more in
// absolute value is at least 2/|dual_i| long; the others are tried.
double shortest_vector(const Bravais& bravais, const Metric& metric) {
  double shortest = kInfinity;
  for (int i = 0; i < bravais.rank; ++i)
    shortest = std::min(shortest, 2 / metric.length_of_form(bravais.dual[i]));
  visit_short(bravais, metric, [&](const Vec&, double length) { shortest = std::min(shortest, length); });
  return shortest * (1 - kAmple);
}

// Do the obstacles overlap their own translates? A translate with a coefficient of 2 or more in absolute value
// overlaps only if obstacles reach through a cell, which is refused anyway. Where lengths in binary64 do not
// tell, exact arithmetic does; if components were taken as zero, or are too small for it, the answer is yes.
bool overlaps_itself(const Bravais& bravais, const Metric& metric, const Shortening& shortening) {
  const double r = bravais.radius;
  const Vec ball[3] = {{r, 0, 0}, {0, r, 0}, {0, 0, r}};
  const auto& primitive = shortening.primitive;
  const Vec u[3] = {primitive[0], primitive[1], primitive[2]};
  double error = r;
  for (int i = 0; i < bravais.rank; ++i) error += length(rounded(bravais.basis[i]));
  error *= kAmple * metric.size();
  bool overlaps = false;
  visit_short(bravais, metric, [&](const Vec& t, double length) {
    if (overlaps || length > 2 * r + error) return;
    Vec sum{};
    for (int i = 0; i < bravais.rank; ++i)
      for (int j = 0; j < bravais.rank; ++j)
        sum[j] += t[i] * static_cast<double>(bravais.stride[i]) * shortening.T[i][j];
    overlaps = length < 2 * r - error || !shortening.complete ||
               overlaps_translate(metric.shape ? metric.shape->semiaxes : ball, u, sum).value_or(true);
  });
  return overlaps;
}

bool is_too_skewed(const Shortening& shortening) {
  for (const auto& row : shortening.T)
    for (const double t : row)
      if (!(std::fabs(t) < kMaxTransform)) return true;
  return false;
}

// Why the engine does not support this atom; empty if it does.
std::string beyond(const Bravais& bravais, const Metric& metric, const Shortening& shortening) {
  if (!(bravais.radius > 1 / kMaxSpacing && bravais.radius < kMaxSpacing))
    return "does obstacles and lattices only whose sizes are within 2^60 of each other";
  if (bravais.rank == 0) return "";
  const double smallest = bravais.dimension == 2 ? kSmallestRadius2d : kSmallestRadius3d;
  const double shortest = shortest_vector(bravais, metric);
  if (!(shortest > 1 / kMaxSpacing && shortest < kMaxSpacing && home_error(bravais) < kMaxHomeError))
    return "does not do lattices of so different spacings, or so flat a cell";
  if (overlaps_itself(bravais, metric, shortening)) return kOverlap;
  if (!(std::ranges::max(bravais.reach) < 1 - 2 * kMaxHomeError)) return kOverlap;
  if (bravais.rank == bravais.dimension && !(bravais.radius >= smallest * shortest))
    return "does radii from " + std::string(bravais.dimension == 2 ? "1e-12" : "1e-7") +
           " of the shortest lattice vector only";
  return "";
}

bool set_basis(Bravais& bravais, const Shortening& shortening) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    const auto stride = static_cast<double>(bravais.stride[i]);
    for (int k = 0; k < 3; ++k) {
      bravais.basis[i][k] = {stride * shortening.B[i][k].hi, stride * shortening.B[i][k].lo};
      bravais.transform[i][k] = std::llround(shortening.T[i][k]);
      for (int j = 0; j < 3; ++j)
        largest = std::max(largest, std::fabs(stride * shortening.T[i][j] * shortening.primitive[j][k]));
    }
  }
  std::ranges::copy(shortening.primitive, bravais.primitive);
  bravais.whole &= shortening.complete;
  bravais.exact = shortening.is_exact();
  bravais.basis_error = bravais.exact ? 0 : kBasis * kWideRoundoff * largest;
  set_dual(bravais);
  return set_inverse(bravais);
}

// One lattice, in the scale of the scene.
class LatticePreparation {
 public:
  LatticePreparation(const Scene& scene, int lattice, double scale)
      : scene_(scene),
        lattice_(scene.lattices[lattice]),
        index_(lattice),
        scale_(scale),
        short_(shortened({})) {
    is_unit_ = lattice_.vectors == unit_scene(scene.dimension, 1).lattices[0].vectors && scale == 1;
  }

  /// Adds the atoms. Returns why it cannot; empty if it can.
  std::string add_to(PreparedScene& prepared) {
    if (is_too_skewed(short_)) return kTooSkewed;
    for (int a = 0; a < static_cast<int>(lattice_.atoms.size()); ++a) {
      Bravais bravais;
      bravais.dimension = scene_.dimension;
      bravais.rank = static_cast<std::int8_t>(lattice_.rank_in(scene_.dimension));
      bravais.lattice = index_;
      bravais.atom = a;
      std::string why;
      do why = prepared.ellipsoids ? set_ellipsoid(bravais) : set_ball(bravais);
      while (why == kOverlap && widen(bravais));
      if (!why.empty()) return why;
      add(bravais, prepared);
    }
    return "";
  }

 private:
  Shortening shortened(Metric metric) const {
    Shortening shortening(lattice_, scene_.dimension, scale_, metric);
    shortening.run();
    return shortening;
  }

  std::string set_ball(Bravais& bravais) const {
    const Atom& atom = lattice_.atoms[bravais.atom];
    set_place(bravais);
    bravais.unit = is_unit_ && atom.position == Vec{} && std::ranges::max(bravais.stride) == 1;
    bravais.radius = atom.radius * scale_;
    return set_basis(bravais, short_) ? finish(bravais, {}, short_) : kTooSkewed;
  }

  // Doubles the stride along the shortest vector; false if there would be too many lattices.
  static bool widen(Bravais& bravais) {
    int shortest = 0;
    for (int i = 1; i < bravais.rank; ++i)
      if (length(rounded(bravais.basis[i])) < length(rounded(bravais.basis[shortest]))) shortest = i;
    bravais.stride[shortest] *= 2;
    return bravais.stride[0] * bravais.stride[1] * bravais.stride[2] <= kMaxLatticesOfAtom;
  }

  // Adds the lattices of an atom.
  static void add(Bravais& bravais, PreparedScene& prepared) {
    const auto& [first, second, third] = bravais.stride;
    prepared.strides |= first * second * third > 1;
    for (std::int64_t i = 0; i < first; ++i)
      for (std::int64_t j = 0; j < second; ++j)
        for (std::int64_t k = 0; k < third; ++k) {
          const std::int64_t n[3] = {i, j, k};
          for (int axis = 0; axis < 3; ++axis)
            bravais.shift[axis] = static_cast<double>(n[axis]) / static_cast<double>(bravais.stride[axis]);
          prepared.atoms.push_back(bravais);
        }
  }

  // Uses a short basis in the metric of the shape: that of the previous atom, if it has the same shape.
  std::string set_ellipsoid(Bravais& bravais) {
    const Atom& atom = lattice_.atoms[bravais.atom];
    const std::array<Vec, 3> axes = semiaxes_of(atom, scene_.dimension);
    std::vector<Vec> semiaxes(axes.begin(), axes.begin() + scene_.dimension);
    for (Vec& axis : semiaxes)
      for (double& component : axis) component *= scale_;
    if (last_semiaxes_ != semiaxes) {
      shape_ = shape_of(semiaxes);
      if (!shape_) return "does not do ellipsoids as slender as this one, or as small";
      shaped_ = shortened({&*shape_});
      last_semiaxes_ = std::move(semiaxes);
    }
    if (is_too_skewed(*shaped_)) return kTooSkewed;
    set_place(bravais);
    bravais.shape = *shape_;
    bravais.radius = shape_->radius;
    if (!set_basis(bravais, *shaped_)) return kTooSkewed;
    std::string why = finish(bravais, {&*shape_}, *shaped_);
    const bool is_unit = is_unit_ && is_alone() && atom.position == Vec{};
    if (is_unit && std::ranges::max(bravais.stride) == 1 && why.empty()) use_axes(bravais);
    return why;
  }

  // SceneModel::unit is for one atom in all. With several atoms the axes would do harm: a vector that is long
  // in the metric of the shape may point backward along a direction in that metric, and only SceneModel::unit
  // has a step for that.
  bool is_alone() const { return scene_.lattices.size() == 1 && lattice_.atoms.size() == 1; }

  // Uses the unit lattice's own vectors, which are exact, instead of shorter ones, unless an obstacle reaches
  // so far that one step along each axis does not lead to all obstacles that can contain a point.
  void use_axes(Bravais& bravais) const {
    Bravais axes = bravais;
    set_basis(axes, short_);
    set_reach(axes, {&bravais.shape});
    axes.unit = std::ranges::max(axes.reach) < kReachOfAxes;
    if (axes.unit) bravais = axes;
  }

  void set_place(Bravais& bravais) const {
    const Atom& atom = lattice_.atoms[bravais.atom];
    const auto scaled = [&](double a) {
      bravais.whole &= a == 0 || a * scale_ != 0;
      return a * scale_;
    };
    bravais.whole = true, bravais.is_ball = atom.is_ball();
    for (const Vec& axis : atom.semiaxes) std::ranges::for_each(axis, scaled);
    std::ranges::transform(atom.position, bravais.position.begin(), scaled);
  }

  static void set_reach(Bravais& bravais, const Metric& metric) {
    for (int i = 0; i < bravais.dimension; ++i)
      bravais.reach[i] = bravais.radius * (1 + kReachSlop) *
                         (metric.length_of_form(bravais.dual[i]) +
                          2 * bravais.coordinate_error * metric.length_of_longest_form());
    bravais.reaches_out = !(std::ranges::max(bravais.reach) < kReachAtHome);
  }

  static std::string finish(Bravais& bravais, const Metric& metric, const Shortening& shortening) {
    set_reach(bravais, metric);
    return beyond(bravais, metric, shortening);
  }

  const Scene& scene_;
  const Lattice& lattice_;
  int index_;
  double scale_;
  bool is_unit_ = false;
  Shortening short_;
  std::vector<Vec> last_semiaxes_;
  std::optional<Shape> shape_;
  std::optional<Shortening> shaped_;
};

// The length by which all others are measured: the first lattice's shortest vector, or the size of a single
// obstacle.
double first_length(const Scene& scene) {
  const Lattice& first = scene.lattices[0];
  if (first.rank_in(scene.dimension) == 0) return length(semiaxes_of(first.atoms[0], scene.dimension)[0]);
  Shortening unscaled(first, scene.dimension, 1, {});
  unscaled.run();
  return length(rounded(unscaled.B[0]));
}

}  // namespace

void set_height_unrounded(const Bravais& lattice, const double (&v)[2], const double (&n)[2], Wide& height,
                          double& error) {
  Expansion sum;
  for (int j = 0; j < 2; ++j) {
    Expansion steps, across;
    for (int i = 0; i < 2; ++i) {
      const auto step = static_cast<double>(lattice.stride[i] * lattice.transform[i][j]);
      steps.add_product(Expansion(n[i]), Expansion(step));
    }
    across.add_product(Expansion(v[0]), Expansion(lattice.primitive[j][1]));
    across.add_product(Expansion(v[1]), Expansion(lattice.primitive[j][0]), -1);
    sum.add_product(steps, across);
  }
  if (!lattice.whole || !sum.is_exact()) return;
  const double high = sum.value();
  sum.add(-high);
  height = Wide::sum(high, sum.value());
  error = kAnchorTerms * std::fabs(height.hi) + kFlushed;
}

PreparedScene prepare(const Scene& scene) {
  checked(scene);
  PreparedScene prepared;
  for_each_atom(scene, [&](const Atom& atom) { prepared.ellipsoids |= !atom.is_ball(); });
  const double first = first_length(scene);
  if (!(first > 1 / kMaxLength && first < kMaxLength)) {
    prepared.beyond = "does lattice vectors and single obstacles between 2^-400 and 2^400 only";
    return prepared;
  }
  prepared.exponent = std::ilogb(first);
  prepared.unit = std::ldexp(1, prepared.exponent);
  prepared.inverse_unit = 1 / prepared.unit;
  for (int l = 0; l < static_cast<int>(scene.lattices.size()) && prepared.beyond.empty(); ++l)
    prepared.beyond = LatticePreparation(scene, l, prepared.inverse_unit).add_to(prepared);
  for (const Bravais& atom : prepared.atoms) {
    prepared.least_rank = std::min<int>(prepared.least_rank, atom.rank);
    prepared.most_rank = std::max<int>(prepared.most_rank, atom.rank);
  }
  return prepared;
}

}  // namespace lorentz
