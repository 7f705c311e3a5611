// The exact error of a product: by one fused multiply-add if the processor has the instruction, otherwise by
// splitting the factors. Both give the same bits, so code written against either gives the same answers. It
// is compiled once for each (reduction/kernels_*.cpp), and the version is chosen when an engine is made.
#pragma once

#include <cfloat>
#include <cmath>

#if defined(__FAST_MATH__) || FLT_EVAL_METHOD != 0
#error \
    "lorentz computes in plain binary64: compile it without -ffast-math, and for 32-bit x86 with -msse2 -mfpmath=sse"
#endif

// Inlines everything that a function calls into it, for one kind of processor, so that an fma is one
// instruction or none. (Not under the sanitizers, whose checks make such a function take minutes to compile.)
#if defined(__SANITIZE_ADDRESS__)
#define LORENTZ_FLATTEN
#else
#define LORENTZ_FLATTEN gnu::flatten
#endif

// Marks a function for processors with the instruction. x86 has to be told; on other processors the
// compiler's target already says whether the instruction exists.
#if defined(__x86_64__)
#define LORENTZ_WITH_FMA gnu::target("fma"), LORENTZ_FLATTEN
#else
#define LORENTZ_WITH_FMA LORENTZ_FLATTEN
#endif

namespace lorentz {

struct SplitProduct;

/// The types with which an Arch computes: here the numbers of one flight. src/engines/batch/lanes-inl.hpp has
/// those of many.
struct OneNumber {
  using Number = double;
  using Mask = bool;
  using Apart = SplitProduct;  ///< the Arch of functions that are not inlined
  static constexpr bool kOne = true, kInRegisters = false;
};

/// a * b = p + product_error(a, b, p) exactly, where p is the rounded product. Requires that nothing
/// overflows and that |p| >= 2^-960 or p = 0, so that the error is a binary64.
struct HardwareFma : OneNumber {
  static double product_error(double a, double b, double p) { return __builtin_fma(a, b, -p); }

  /// a - k b, exactly. Requires that the result is a binary64.
  static double remainder(double a, double k, double b) { return __builtin_fma(-k, b, a); }
};

/// The same without the instruction: Veltkamp's splitting and Dekker's product (Numer. Math. 18, 1971).
struct SplitProduct : OneNumber {
  static double product_error(double a, double b, double p) {
    const double a_high = high_part(a), a_low = a - a_high, b_high = high_part(b), b_low = b - b_high;
    return ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
  }

  static double remainder(double a, double k, double b) {
    const double p = k * b;
    return (a - p) - product_error(k, b, p);
  }

 private:
  static double high_part(double a) {
    const double c = 0x1.0000002p27 * a;  // 2^27 + 1
    return c - (c - a);
  }
};

}  // namespace lorentz
