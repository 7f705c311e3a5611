// Comparisons of data that was written and read again: it must be the same to the bit, because zeros have
// signs.
#pragma once

#include <algorithm>
#include <cstring>
#include <optional>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::harness {

struct SameBits {
  bool operator()(double a, double b) const { return std::memcmp(&a, &b, sizeof a) == 0; }
  bool operator()(const std::optional<double>& a, const std::optional<double>& b) const {
    return a.has_value() == b.has_value() && (!a || (*this)(*a, *b));
  }
  template <class T>
  bool operator()(const std::vector<T>& a, const std::vector<T>& b) const {
    return std::ranges::equal(a, b, *this);
  }
  template <class T>
  bool operator()(const std::array<T, 3>& a, const std::array<T, 3>& b) const {
    return std::ranges::equal(a, b, *this);
  }
  bool operator()(const Query& a, const Query& b) const {
    return (*this)(a.x, b.x) && (*this)(a.v, b.v) && a.from == b.from;
  }
  bool operator()(const Atom& a, const Atom& b) const {
    return (*this)(a.position, b.position) && (*this)(a.radius, b.radius) && (*this)(a.semiaxes, b.semiaxes);
  }
  bool operator()(const Lattice& a, const Lattice& b) const {
    return (*this)(a.vectors, b.vectors) && (*this)(a.atoms, b.atoms);
  }
  bool operator()(const Scene& a, const Scene& b) const {
    return a.dimension == b.dimension && (*this)(a.lattices, b.lattices);
  }
  /// Compares what an answer's line says: for `never` that is neither an obstacle nor a time, whatever else
  /// was read.
  bool operator()(const Answer& a, const Answer& b) const {
    if (a.outcome != b.outcome) return false;
    if (a.outcome == Outcome::error) return a.message == b.message && a.unsupported == b.unsupported;
    const bool is_hit = a.outcome == Outcome::hit, names_obstacle = is_hit || a.outcome == Outcome::inside;
    return (!names_obstacle || a.obstacle == b.obstacle) && (!is_hit || (*this)(a.time, b.time));
  }
};
inline constexpr SameBits same;

}  // namespace lorentz::harness
