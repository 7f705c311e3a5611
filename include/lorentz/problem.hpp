// The exact problem statement, shared by every engine, oracle and reader: scenes, queries, answers. Values,
// without hidden state: copy them, and share them between threads as you would a double.
//
// Every number here is a binary64 value and means exactly the dyadic rational that it is. Lengths are in the
// scene's own unit; a velocity has any length, and times are in units in which x + t v is the particle's
// place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz {

/// A point or direction, Cartesian. A 2D problem uses the first two components and keeps the third at zero.
using Vec = std::array<double, 3>;

/// An obstacle of the motif: an open ball of `radius` > 0, or the open ellipsoid { position + A y : |y| < 1 }
/// whose matrix A has the columns `semiaxes`. A cell coordinate n counts from `position`.
struct Atom {
  Vec position{};
  double radius = 0;
  std::vector<Vec> semiaxes;  ///< empty for a ball, else `dimension` linearly independent vectors

  bool is_ball() const { return semiaxes.empty(); }

  /// The same numbers (-0 is 0), in the same order.
  friend bool operator==(const Atom&, const Atom&) = default;
};

/// Primitive vectors u_1..u_d (linearly independent) and the motif that is repeated at n_1 u_1 + ... + n_d
/// u_d.
struct Lattice {
  std::array<Vec, 3> vectors{};
  std::vector<Atom> atoms;

  friend bool operator==(const Lattice&, const Lattice&) = default;
};

/// One or several lattices of obstacles in 2 or 3 dimensions; obstacles may overlap.
struct Scene {
  int dimension = 0;
  std::vector<Lattice> lattices;

  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Calls visit(atom) for each atom of the scene, lattice by lattice.
template <class Visit>
void for_each_atom(Scene& scene, const Visit& visit) {
  for (Lattice& lattice : scene.lattices)
    for (Atom& atom : lattice.atoms) visit(atom);
}

template <class Visit>
void for_each_atom(const Scene& scene, const Visit& visit) {
  for (const Lattice& lattice : scene.lattices)
    for (const Atom& atom : lattice.atoms) visit(atom);
}

/// 128 bits, for what must not overflow where 64 do.
__extension__ using WideInteger = __int128;

/// An integer of any size. Cell coordinates nearly always fit 64 bits; exact answers sometimes do not.
class Integer {
 public:
  Integer(std::int64_t value = 0) : value_(value) {}
  Integer(const Integer& other) : value_(other.value_) {
    if (other.digits_) digits_ = std::make_unique<const std::string>(*other.digits_);
  }
  Integer(Integer&&) noexcept = default;
  Integer& operator=(const Integer& other) { return *this = Integer(other); }
  Integer& operator=(Integer&&) noexcept = default;
  Integer& operator=(std::int64_t value) {
    value_ = value;
    digits_.reset();
    return *this;
  }
  ~Integer() = default;

  /// Reads an optional '-' and decimal digits; nothing else is a number. Leading zeros are dropped.
  static std::optional<Integer> from_decimal(std::string_view text);

  bool fits_int64() const { return !digits_; }
  std::int64_t int64() const { return value_; }  ///< only if fits_int64()
  std::optional<WideInteger> int128() const {    ///< nothing beyond 10^38
    return fits_int64() ? std::optional<WideInteger>(value_) : int128_of_digits();
  }
  std::string decimal() const;

  friend bool operator==(const Integer& a, const Integer& b) {
    if (a.fits_int64() || b.fits_int64()) return a.digits_ == b.digits_ && a.value_ == b.value_;
    return *a.digits_ == *b.digits_;
  }

 private:
  std::int64_t value_ = 0;
  std::unique_ptr<const std::string>
      digits_;  ///< canonical decimal form when 64 bits do not hold it, else null

  std::optional<WideInteger> int128_of_digits() const;
};

/// Coordinates n of a lattice cell; a 2D problem keeps the third at zero.
using Cell = std::array<Integer, 3>;

/// The obstacle of atom `atom` of lattice `lattice`, translated into the cell `cell`.
struct ObstacleId {
  int lattice = 0;
  int atom = 0;
  Cell cell{};

  friend bool operator==(const ObstacleId&, const ObstacleId&) = default;
};

/// The ray x + t v, t >= 0, with v != 0. The obstacle `from`, if any, is ignored wherever x lies.
struct Query {
  Vec x{};
  Vec v{};
  std::optional<ObstacleId> from;
};

enum class Outcome {
  hit,        ///< the ray enters `obstacle` first, at `time`
  never,      ///< it enters no obstacle
  inside,     ///< x lies in the open obstacle `obstacle`
  later,      ///< nothing is entered before the asked --max-time
  undecided,  ///< the implementation does not know, and says so
  error       ///< no valid query, or (unsupported) one that this engine does not do
};

/// The collision itself, for those who ask for it. Unit outward normal; impact parameter: distance of the
/// line of flight from the obstacle's centre.
struct Detail {
  Vec point{};
  Vec normal{};
  double impact_parameter = 0;
};

struct Answer {
  Outcome outcome = Outcome::undecided;
  ObstacleId obstacle;           ///< of `hit` and `inside`
  std::optional<double> time;    ///< of `hit`; may be infinite, and absent in answers that others logged
  std::string time_decimal;      ///< of `hit`, if digits were asked for
  std::optional<Detail> detail;  ///< of `hit`, if it was asked for
  std::string message;           ///< of `error`
  bool unsupported = false;      ///< of `error`: a valid query, outside what this engine does

  /// As newly made, but what is allocated stays.
  void clear();

  static Answer hit(ObstacleId obstacle, double time);
  static Answer inside(ObstacleId obstacle);
  static Answer never();
  static Answer later();
  static Answer undecided();
  static Answer error(std::string message);
  static Answer unsupported_because(std::string message);
};

/// The answer, or `later` if it says that nothing is entered before `max_time` (an infinity: no limit).
Answer limited(Answer answer, double max_time);

/// What is wrong with a scene, or nothing: dimension, finite numbers, radii above zero, semiaxes complete.
/// That the primitive vectors are independent is decided exactly by the oracle
/// (include/lorentz/scene_check.hpp).
std::optional<std::string> flaw_of(const Scene& scene);

/// What is wrong with a query in this scene, or nothing: finite numbers, v != 0, `from` names an atom that
/// exists.
std::optional<std::string> flaw_of(const Query& query, const Scene& scene);

/// The unit square (d = 2) or cubic (d = 3) lattice with one ball of this radius at the origin.
Scene unit_scene(int dimension, double radius);

/// True if the scene is one unit square or cubic lattice with one ball centred at the origin, the primitive
/// vectors in the order of the axes.
bool is_unit_scene(const Scene& scene);

}  // namespace lorentz
