// Certificates: proofs that an answer is right, as docs/certificates.md defines them. This header has the
// data only: prover.hpp writes certificates, and certificate_check.hpp checks them.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/obstacle.hpp>

namespace lorentz::oracle {

/// Limits that all checkers enforce (docs/certificates.md): the number of steps that a record may take, and
/// the number of characters in an integer, in the exact end of a window, and in a `time_decimal`.
inline constexpr long kMostSteps = 1'000'000;
inline constexpr std::size_t kLongestText = 2500;

/// Integer vectors b_1, .., b_k in the coordinates n of a lattice's k primitive vectors. They fill the first
/// k rows and columns; the rest is zero.
using CertificateBasis = std::array<Cell, 3>;

/// An end of a window: mantissa * 2^exponent, or infinity for a window without an end.
struct WindowEnd {
  static constexpr long kMostExponent = 1 << 14;  ///< the largest |exponent| that checkers accept

  Integer mantissa;
  long exponent = 0;
  bool infinite = false;

  WindowEnd() = default;
  WindowEnd(Integer its_mantissa, long its_exponent = 0)
      : mantissa(std::move(its_mantissa)), exponent(its_exponent) {}
  WindowEnd(double value) {  ///< `value` is finite or infinity
    int e = 0;
    infinite = std::isinf(value);
    if (infinite) return;
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &e), 53));
    exponent = e - 53;
  }
};

/// The end as text, such as "0x1f4p-3", with an integer mantissa of any length, or "inf".
std::string text_of(const WindowEnd& end);

/// The exact value of a hexadecimal text ("0x1f4p-3", "-0X1.8"). Nothing if the text is not hexadecimal, is
/// longer than kLongestText, or has an exponent beyond kMostExponent once the mantissa is an integer.
std::optional<WindowEnd> window_end_from(std::string_view text);

/// The binary64 that equals the end exactly, if one exists; infinity counts as one.
std::optional<double> binary64_of(const WindowEnd& end);

/// States that the obstacles of one atom with `from` <= T <= `to` must be examined, in this basis. T is the
/// time at which the line is nearest to the obstacle's centre, in the atom's own coordinates. A window
/// without an end has all obstacles from `from` on.
struct Window {
  int lattice = 0;
  int atom = 0;
  WindowEnd from, to;
  CertificateBasis basis;
};

/// For `never`: the obstacles of one atom lie in rows along b_1, which is parallel to v.
struct Rows {
  int lattice = 0;
  int atom = 0;
  CertificateBasis basis;
};

struct Certificate {
  std::vector<Window> windows;  ///< each atom's in order of time; for `never`, the last has no end
  std::vector<Rows> rows;       ///< for `never`: one for each atom that has no windows
};

}  // namespace lorentz::oracle
