// The exact oracle: the truth about first hits, for every scene of balls and ellipsoids on any lattices,
// motifs and superpositions in 2D and 3D. See README.md in this folder for why it can be trusted.
#pragma once

#include <memory>
#include <optional>

#include <lorentz/problem.hpp>

namespace lorentz::oracle {

/// What a caller wants besides the obstacle and the time.
struct Request {
  int digits = 0;                  ///< significant decimal digits of the time, rounded half to even; 0: none
  bool detail = false;             ///< collision point, normal, impact parameter, each correctly rounded
  std::optional<double> max_time;  ///< answer `later` if nothing is entered before this time
};

class Oracle {
 public:
  /// The scene must have no flaw (flaw_of) and independent vectors (dependence_in). Reduces its lattices,
  /// once.
  explicit Oracle(const Scene& scene);
  Oracle(Oracle&&) noexcept;
  Oracle& operator=(Oracle&&) noexcept;
  ~Oracle();

  /// The exact answer: `hit` (time correctly rounded to binary64), `inside`, `never`, or `later` if asked
  /// for; an invalid query yields `error`. Never `undecided`.
  /// Costs grow with the logarithms of 1/r, of the distance and of the numbers' range. The exception: which
  /// of very many obstacles around x is the smallest (10^10 of them, in a lattice both dense and skewed) can
  /// take long. Safe to call from several threads.
  Answer first_hit(const Query& query, const Request& request = {}) const;

  /// True if x lies in no open obstacle. Requires a finite x.
  bool is_free(const Vec& x) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// The libraries that the oracle computes with, and their versions.
std::string oracle_libraries();

}  // namespace lorentz::oracle
