// Real numbers enclosed in balls, mid +- radius, by Arb. The result of an operation contains the results that
// exact arithmetic gives for all numbers in the balls of its operands. Private to oracle/itinerary.
#pragma once

#if __has_include(<arb.h>)
#include <arb.h>
#else  // from FLINT 3 on
#include <flint/arb.h>
#include <flint/fmpq.h>
#endif

#include <array>
#include <concepts>
#include <optional>
#include <string>

#include "oracle/integers/integer.hpp"

namespace lorentz::oracle {

/// An upper bound: 30 bits, any exponent, with all operations rounded upwards.
class Bound {
 public:
  Bound() { mag_init(value_); }
  explicit Bound(double value) : Bound() { mag_set_d(value_, value); }
  explicit Bound(const mag_t value) { mag_init_set(value_, value); }
  Bound(const Bound& other) { mag_init_set(value_, other.value_); }
  Bound& operator=(const Bound& other) {
    mag_set(value_, other.value_);
    return *this;
  }
  ~Bound() { mag_clear(value_); }

  /// 2^exponent
  static Bound power_of_two(long exponent) {
    Bound result(1);
    mag_mul_2exp_si(result.value_, result.value_, exponent);
    return result;
  }

  Bound& operator+=(const Bound& b) {
    mag_add(value_, value_, b.value_);
    return *this;
  }
  friend Bound operator+(Bound a, const Bound& b) { return a += b; }
  friend Bound operator*(Bound a, const Bound& b) {
    mag_mul(a.value_, a.value_, b.value_);
    return a;
  }
  friend Bound operator/(Bound a, const Bound& b) {
    mag_div(a.value_, a.value_, b.value_);
    return a;
  }
  friend bool operator<(const Bound& a, const Bound& b) { return mag_cmp(a.value_, b.value_) < 0; }

  bool is_zero() const { return mag_is_zero(value_); }
  bool is_finite() const { return mag_is_finite(value_); }
  /// The least k with value <= 2^k, for a finite value other than 0.
  long exponent() const { return fmpz_get_si(MAG_EXPREF(value_)); }
  const mag_t& raw() const { return value_; }

 private:
  friend class Ball;

  mag_t value_;
};

class Ball {
 public:
  /// Sets the precision in bits of all operations of this thread during its lifetime.
  class WorkingPrecision {
   public:
    explicit WorkingPrecision(long bits) : before_(bits_) { bits_ = bits; }
    ~WorkingPrecision() { bits_ = before_; }
    WorkingPrecision(const WorkingPrecision&) = delete;
    static long now() { return bits_; }

   private:
    long before_;
    inline static thread_local long bits_ = 128;
  };

  Ball() { arb_init(value_); }
  template <std::integral T>
  Ball(T value) : Ball() {
    arb_set_si(value_, static_cast<slong>(value));
  }
  explicit Ball(double value) : Ball() { arb_set_d(value_, value); }
  explicit Ball(const Z& value) : Ball() { arf_set_mpz(arb_midref(value_), value.view()); }
  Ball(const Ball& other) : Ball() { arb_set(value_, other.value_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(value_, other.value_); }
  Ball& operator=(const Ball& other) {
    arb_set(value_, other.value_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(value_, other.value_);
    return *this;
  }
  ~Ball() { arb_clear(value_); }

  friend Ball operator+(const Ball& a, const Ball& b) { return result_of(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return result_of(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return result_of(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return result_of(arb_div, a, b); }
  friend Ball square(const Ball& a) { return result_of(arb_sqr, a); }
  friend Ball sqrt(const Ball& a) { return result_of(arb_sqrt, a); }
  friend Ball operator-(const Ball& a) {
    Ball c;
    arb_neg(c.value_, a.value_);
    return c;
  }
  /// a 2^exponent
  friend Ball scaled(const Ball& a, long exponent) {
    Ball c;
    arb_mul_2exp_si(c.value_, a.value_, exponent);
    return c;
  }
  Ball& operator+=(const Ball& b) {
    arb_add(value_, value_, b.value_, WorkingPrecision::now());
    return *this;
  }
  Ball& add_product(const Ball& a, const Ball& b) {
    arb_addmul(value_, a.value_, b.value_, WorkingPrecision::now());
    return *this;
  }

  /// True if all numbers of the ball have the property.
  bool is_positive() const { return arb_is_positive(value_); }
  bool is_negative() const { return arb_is_negative(value_); }
  bool is_exact() const { return arb_is_exact(value_); }
  bool is_finite() const { return arb_is_finite(value_); }
  friend bool surely_less(const Ball& a, const Ball& b) { return arb_lt(a.value_, b.value_); }
  friend bool surely_not_after(const Ball& a, const Ball& b) { return arb_le(a.value_, b.value_); }

  Bound radius() const { return Bound(arb_radref(value_)); }
  /// At least the size of every number of the ball.
  Bound size() const;
  /// At most the size of every number of the ball.
  Bound least_size() const;
  /// The ball widened by this much.
  Ball widened(const Bound& by) const;
  /// The middle of the ball.
  Ball middle() const;
  double nearest() const { return arf_get_d(arb_midref(value_), ARF_RND_NEAR); }

  /// The middle times 2^bits, rounded to an integer; the error is less than 1.
  Z rounded(long bits) const;
  /// The middle as integer * 2^exponent, where the integer is odd or 0.
  struct Exact {
    Z integer;
    long exponent = 0;
  };
  Exact exact_middle() const;

  /// Numbers without a radius, below and above all numbers of the ball, rounded outwards to the precision.
  Ball lower() const;
  Ball upper() const;

  arb_t& raw() { return value_; }

 private:
  // What one of Arb's functions makes of these operands, to the working precision.
  template <class Function, class... Operands>
  static Ball result_of(const Function& function, const Operands&... operands) {
    Ball result;
    function(result.value_, operands.value_..., WorkingPrecision::now());
    return result;
  }

  arb_t value_;
};

template <std::size_t N>
using BallVec = std::array<Ball, N>;

template <std::size_t N>
BallVec<N> balls(const ZVec<N>& a) {
  BallVec<N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = Ball(a[i]);
  return result;
}

template <std::size_t N>
Ball dot(const BallVec<N>& a, const BallVec<N>& b) {
  Ball sum = a[0] * b[0];
  for (std::size_t i = 1; i < N; ++i) sum.add_product(a[i], b[i]);
  return sum;
}

/// The bits of a decimal digit, and a little more.
inline constexpr double kBitsADigit = 3.33;

/// A decimal text of `digits` significant digits, correctly rounded, if all numbers of the ball round to the
/// same text. It is positional for exponents from -7 to `digits` - 1, else d.ddde+x. An exact 0 gives "0".
/// Nothing if the ball contains 0 otherwise, or is not finite.
std::optional<std::string> certain_decimal(const Ball& a, int digits);

}  // namespace lorentz::oracle
