// Comparisons of data that was written and read again: it must be the same to the bit, because zeros have
// signs.
#pragma once

#include <cstring>
#include <optional>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::harness {

inline bool same(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

inline bool same(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

inline bool same(const Vec& a, const Vec& b) {
  return same(a[0], b[0]) && same(a[1], b[1]) && same(a[2], b[2]);
}

inline bool same(const Query& a, const Query& b) {
  return same(a.x, b.x) && same(a.v, b.v) && a.from == b.from;
}

inline bool same(const Atom& a, const Atom& b) {
  if (!same(a.position, b.position) || !same(a.radius, b.radius)) return false;
  if (a.semiaxes.size() != b.semiaxes.size()) return false;
  for (std::size_t i = 0; i < a.semiaxes.size(); ++i)
    if (!same(a.semiaxes[i], b.semiaxes[i])) return false;
  return true;
}

inline bool same(const Lattice& a, const Lattice& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!same(a.vectors[i], b.vectors[i])) return false;
  if (a.atoms.size() != b.atoms.size()) return false;
  for (std::size_t i = 0; i < a.atoms.size(); ++i)
    if (!same(a.atoms[i], b.atoms[i])) return false;
  return true;
}

inline bool same(const Scene& a, const Scene& b) {
  if (a.dimension != b.dimension || a.lattices.size() != b.lattices.size()) return false;
  for (std::size_t l = 0; l < a.lattices.size(); ++l)
    if (!same(a.lattices[l], b.lattices[l])) return false;
  return true;
}

/// Compares what an answer's line says: for `never` that is neither an obstacle nor a time, whatever else was
/// read.
inline bool same(const Answer& a, const Answer& b) {
  if (a.outcome != b.outcome) return false;
  switch (a.outcome) {
    case Outcome::hit:
      return a.obstacle == b.obstacle && same(a.time, b.time);
    case Outcome::inside:
      return a.obstacle == b.obstacle;
    case Outcome::error:
      return a.message == b.message && a.unsupported == b.unsupported;
    default:
      return true;
  }
}

}  // namespace lorentz::harness
