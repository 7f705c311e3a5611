// Integers of any size whose small values need no allocation. Private to oracle/ and fuzz/rewording.
//
// A number is a sign and limbs, as in GMP; GMP's functions on limbs do the work. Most numbers of a query have
// one to ten limbs and live for a line of code: with mpz_class, malloc and free took a third of the oracle's
// time. So a number holds kInline limbs in itself, and only longer ones are on the heap. There is no other
// difference to mpz_class, and no limit to the size.
#pragma once

#include <gmp.h>

#include <compare>
#include <concepts>
#include <cstring>
#include <iosfwd>
#include <string>

namespace lorentz::oracle {

class Z {
 public:
  /// 0
  Z() noexcept : limbs_(inline_) {}
  /// Any built-in integer, exactly.
  template <std::integral T>
  Z(T value)
  noexcept : limbs_(inline_), size_((+value > 0) - (+value < 0)) {
    static_assert(sizeof(T) <= sizeof(mp_limb_t));
    inline_[0] = value < 0 ? -static_cast<mp_limb_t>(value) : static_cast<mp_limb_t>(value);
  }
  /// Reads digits, with a '-' before them if negative; throws std::invalid_argument if the text has any other
  /// form.
  explicit Z(const std::string& digits, int base = 10);
  explicit Z(mpz_srcptr value);
  /// Rounded towards 0.
  explicit Z(mpf_srcptr value);
  /// A finite binary64, rounded towards 0.
  explicit Z(double value);

  Z(const Z& other) : limbs_(inline_), size_(other.size_) {
    const std::size_t n = other.count();
    if (n > kInline) adopt(allocate(n), n);
    copy(limbs_, other.limbs_, n);
  }
  Z(Z&& other) noexcept : limbs_(inline_), size_(other.size_) { take(other); }
  Z& operator=(const Z& other) {
    if (this == &other) return *this;
    const std::size_t n = other.count();
    if (n > capacity_) adopt(allocate(n), n);
    copy(limbs_, other.limbs_, n);
    size_ = other.size_;
    return *this;
  }
  Z& operator=(Z&& other) noexcept {
    if (this == &other) return *this;
    size_ = other.size_;
    if (other.is_inline()) {
      copy(limbs_, other.limbs_, other.count());
    } else {
      release();
      take(other);
    }
    return *this;
  }
  ~Z() { release(); }

  Z& operator+=(const Z& b) {
    add(*this, *this, b.limbs_, b.size_);
    return *this;
  }
  Z& operator-=(const Z& b) {
    add(*this, *this, b.limbs_, -b.size_);
    return *this;
  }
  Z& operator*=(const Z& b) { return *this = *this * b; }
  Z& operator/=(const Z& b) { return *this = *this / b; }
  Z& operator++() { return *this += 1; }
  Z& operator--() { return *this -= 1; }
  /// Adds a b. Either may be this number.
  Z& add_product(const Z& a, const Z& b) { return add_product(a, b, 1); }
  Z& subtract_product(const Z& a, const Z& b) { return add_product(a, b, -1); }

  friend Z operator+(const Z& a, const Z& b) {
    Z sum;
    add(sum, a, b.limbs_, b.size_);
    return sum;
  }
  friend Z operator-(const Z& a, const Z& b) {
    Z difference;
    add(difference, a, b.limbs_, -b.size_);
    return difference;
  }
  friend Z operator-(const Z& a) {
    Z result = a;
    result.size_ = -result.size_;
    return result;
  }
  friend Z operator*(const Z& a, const Z& b) {
    Z product;
    multiply(product, a, b);
    return product;
  }
  /// The quotient rounded towards 0. Throws std::domain_error for b = 0, as every division does.
  friend Z operator/(const Z& a, const Z& b);
  /// a - a / b * b
  friend Z operator%(const Z& a, const Z& b);
  /// floor(a / 2^bits)
  friend Z operator>>(const Z& a, unsigned long bits);
  friend Z shifted_left(const Z& a, unsigned long bits);
  friend Z operator<<(const Z& a, unsigned long bits) { return shifted_left(a, bits); }

  /// Negative, 0 or positive as a < b, a = b or a > b.
  friend int cmp(const Z& a, const Z& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
    for (std::size_t i = a.count(); i-- > 0;)
      if (a.limbs_[i] != b.limbs_[i]) return (a.limbs_[i] < b.limbs_[i]) == (a.size_ > 0) ? -1 : 1;
    return 0;
  }
  friend bool operator==(const Z& a, const Z& b) { return cmp(a, b) == 0; }
  friend std::strong_ordering operator<=>(const Z& a, const Z& b) { return cmp(a, b) <=> 0; }
  template <std::integral T>
  friend bool operator==(const Z& a, T b) {
    return b == 0 ? a.size_ == 0 : cmp(a, Z(b)) == 0;
  }
  template <std::integral T>
  friend std::strong_ordering operator<=>(const Z& a, T b) {
    return (b == 0 ? a.size_ : cmp(a, Z(b))) <=> 0;
  }
  /// The same for |a| and |b|.
  friend int compare_sizes(const Z& a, const Z& b) {
    const std::size_t n = a.count(), m = b.count();
    return n != m ? (n < m ? -1 : 1) : n == 0 ? 0 : mpn_cmp(a.limbs_, b.limbs_, static_cast<mp_size_t>(n));
  }
  /// -1, 0 or +1
  friend int sgn(const Z& a) { return a.size_ < 0 ? -1 : a.size_ > 0; }
  friend Z abs(const Z& a) {
    Z result = a;
    result.size_ = static_cast<int>(a.count());
    return result;
  }
  friend bool is_odd(const Z& a) { return a.size_ != 0 && a.limbs_[0] % 2 != 0; }
  /// Number of bits of |a|; 0 for a = 0.
  friend long bit_length(const Z& a) {
    const std::size_t n = a.count();
    return n == 0 ? 0 : static_cast<long>(n) * GMP_NUMB_BITS - __builtin_clzl(a.limbs_[n - 1]);
  }
  /// The largest k with 2^k | a, for a != 0.
  friend long trailing_zeros(const Z& a) { return static_cast<long>(mpn_scan1(a.limbs_, 0)); }

  enum class Rounding { down, up, to_zero };
  struct Division;
  friend Division divide(const Z& a, const Z& b, Rounding rounding);
  struct Root;
  friend Root square_root(const Z& a);

  bool fits_slong_p() const { return mpz_fits_slong_p(view()) != 0; }
  long get_si() const { return mpz_get_si(view()); }                   ///< only if fits_slong_p()
  unsigned long get_ui() const { return size_ == 0 ? 0 : limbs_[0]; }  ///< |a| modulo 2^64
  double get_d() const { return mpz_get_d(view()); }                   ///< rounded towards 0
  std::string get_str(int base = 10) const;

  /// The number in the form that GMP's own functions read. It must not outlive the number, nor any change of
  /// it.
  class LimbView {
   public:
    explicit LimbView(const Z& a) { mpz_roinit_n(value_, a.limbs_, a.size_); }
    operator mpz_srcptr() const { return value_; }

   private:
    mpz_t value_;
  };
  LimbView view() const { return LimbView(*this); }

 private:
  static constexpr std::size_t kInline = 10, kAtOnce = 4;

  std::size_t count() const { return static_cast<std::size_t>(size_ < 0 ? -size_ : size_); }
  bool is_inline() const { return limbs_ == inline_; }

  // There is always room for kAtOnce limbs, so this copies that many at once, whether they are used or not.
  static void copy(mp_limb_t* to, const mp_limb_t* from, std::size_t n) {
    std::memcpy(to, from, kAtOnce * sizeof(mp_limb_t));
    if (n > kAtOnce) std::memcpy(to + kAtOnce, from + kAtOnce, (n - kAtOnce) * sizeof(mp_limb_t));
  }
  // Takes over the limbs of another number of the same size: copies them, or adopts its heap array. This
  // number's own limbs must be in place.
  void take(Z& other) noexcept {
    if (other.is_inline()) {
      copy(limbs_, other.limbs_, other.count());
      return;
    }
    limbs_ = other.limbs_;
    capacity_ = other.capacity_;
    other.limbs_ = other.inline_;
    other.capacity_ = kInline;
    other.size_ = 0;
  }
  void release() noexcept {
    if (is_inline()) return;
    delete[] limbs_;
    limbs_ = inline_;
    capacity_ = kInline;
  }
  static mp_limb_t* allocate(std::size_t n) { return new mp_limb_t[n]; }
  void adopt(mp_limb_t* limbs, std::size_t capacity) {
    release();
    limbs_ = limbs;
    capacity_ = static_cast<unsigned>(capacity);
  }

  static void add(Z& sum, const Z& a, const mp_limb_t* b, int b_size);
  static void multiply(Z& product, const Z& a, const Z& b);
  Z& add_product(const Z& a, const Z& b, int sign);

  mp_limb_t* limbs_;  // least significant first; inline_, or an array of `capacity_`
  int size_ = 0;      // number of limbs, the last of them not 0; negative for a number below 0
  unsigned capacity_ = kInline;
  mp_limb_t inline_[kInline];
};

/// a / b rounded as requested, and whether it is an integer.
struct Z::Division {
  Z quotient;
  bool exact = false;
};

/// floor(sqrt(a)), and whether it is the exact root.
struct Z::Root {
  Z floor;
  bool exact = false;
};

// The friends declared above, declared again for callers that qualify their names or pass built-in integers.
long bit_length(const Z& a);
Z abs(const Z& a);
/// a 2^bits
Z shifted_left(const Z& a, unsigned long bits);

/// >= 0
Z gcd(const Z& a, const Z& b);
Z lcm(const Z& a, const Z& b);

struct Bezout {
  Z gcd, x, y;  ///< a x + b y = gcd >= 0
};
Bezout bezout(const Z& a, const Z& b);

/// base^exponent
Z power(unsigned long base, unsigned long exponent);

/// a = m 2^exponent with 0.5 <= |m| < 1, m rounded towards 0; 0 for a = 0.
struct BinaryApproximation {
  double mantissa = 0;
  long exponent = 0;
};
BinaryApproximation approximation(const Z& a);

std::ostream& operator<<(std::ostream& out, const Z& a);

}  // namespace lorentz::oracle
