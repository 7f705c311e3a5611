// Proofs that an answer is right, as docs/certificates.md defines them: data only. Who writes them is
// prover.hpp, who checks them certificate_check.hpp.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/obstacle.hpp>

namespace lorentz::oracle {

/// The limits that all checkers keep (docs/certificates.md): the steps that a record may take, and the
/// characters of an integer, of the exact end of a window, and of a `time_decimal`.
inline constexpr long kMostSteps = 1'000'000;
inline constexpr std::size_t kLongestText = 2500;

/// Integer vectors b_1, .., b_k in the coordinates n of a lattice's k primitive vectors: the first k rows and
/// columns; the rest is zero.
using CertificateBasis = std::array<Cell, 3>;

/// An end of a window: mantissa * 2^exponent; or, of a window that has no end, infinity.
struct WindowEnd {
  static constexpr long kMostExponent = 1 << 14;  ///< in absolute value; no checker goes further

  Integer mantissa;
  long exponent = 0;
  bool infinite = false;

  WindowEnd() = default;
  WindowEnd(Integer its_mantissa, long its_exponent = 0)
      : mantissa(std::move(its_mantissa)), exponent(its_exponent) {}
  WindowEnd(double value) {  ///< finite, or infinity
    int e = 0;
    infinite = std::isinf(value);
    if (infinite) return;
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &e), 53));
    exponent = e - 53;
  }
};

/// "0x1f4p-3", with an integer mantissa of any length.
std::string text_of(const WindowEnd& end);

/// What a text in hexadecimal says, exactly ("0x1f4p-3", "-0X1.8"); nothing if it is not one, is longer than
/// kLongestText, or has an exponent beyond kMostExponent once the mantissa is an integer.
std::optional<WindowEnd> window_end_from(std::string_view text);

/// The binary64 that an end is exactly, if there is one; infinity is one.
std::optional<double> binary64_of(const WindowEnd& end);

/// The obstacles of one atom with `from` <= T <= `to`, T the time at which the line is nearest to the centre
/// (in the atom's own coordinates), are to be looked at in this basis; of a window without an end, all from
/// `from` on.
struct Window {
  int lattice = 0;
  int atom = 0;
  WindowEnd from, to;
  CertificateBasis basis;
};

/// Of `never`: the obstacles of one atom lie in rows along b_1, which is parallel to v.
struct Rows {
  int lattice = 0;
  int atom = 0;
  CertificateBasis basis;
};

struct Certificate {
  std::vector<Window> windows;  ///< those of an atom in the order of time; of `never` the last has no end
  std::vector<Rows> rows;       ///< of `never`; one of each atom that has no windows
};

}  // namespace lorentz::oracle
