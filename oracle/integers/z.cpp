#include "oracle/integers/z.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <stdexcept>

namespace lorentz::oracle {
namespace {

__extension__ using Wide = unsigned __int128;

// Up to this number of limbs, a loop in place takes less time than a call of GMP's function.
constexpr std::size_t kShort = 4;

// Limbs for an intermediate result; kHere limbs need no allocation and are nearly always enough.
class Scratch {
 public:
  explicit Scratch(std::size_t n) {
    if (n <= kHere) return;
    more_ = std::make_unique_for_overwrite<mp_limb_t[]>(n);
    limbs_ = more_.get();
  }
  mp_limb_t* limbs() { return limbs_; }

 private:
  static constexpr std::size_t kHere = 40;
  mp_limb_t here_[kHere];
  std::unique_ptr<mp_limb_t[]> more_;
  mp_limb_t* limbs_ = here_;
};

std::size_t without_zeros(const mp_limb_t* limbs, std::size_t n) {
  while (n > 0 && limbs[n - 1] == 0) --n;
  return n;
}

// a + b, of n >= m limbs; returns the carry. The sum may overwrite a or b.
mp_limb_t add_limbs(mp_limb_t* sum, const mp_limb_t* a, std::size_t n, const mp_limb_t* b, std::size_t m) {
  if (n > kShort) return mpn_add(sum, a, static_cast<mp_size_t>(n), b, static_cast<mp_size_t>(m));
  Wide carry = 0;
  for (std::size_t i = 0; i < m; ++i) {
    carry += static_cast<Wide>(a[i]) + b[i];
    sum[i] = static_cast<mp_limb_t>(carry);
    carry >>= GMP_NUMB_BITS;
  }
  for (std::size_t i = m; i < n; ++i) {
    carry += a[i];
    sum[i] = static_cast<mp_limb_t>(carry);
    carry >>= GMP_NUMB_BITS;
  }
  return static_cast<mp_limb_t>(carry);
}

// a - b >= 0, n >= m limbs.
void subtract_limbs(mp_limb_t* difference, const mp_limb_t* a, std::size_t n, const mp_limb_t* b,
                    std::size_t m) {
  if (n > kShort) {
    mpn_sub(difference, a, static_cast<mp_size_t>(n), b, static_cast<mp_size_t>(m));
    return;
  }
  mp_limb_t borrow = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Wide rest = static_cast<Wide>(a[i]) - (i < m ? b[i] : 0) - borrow;
    difference[i] = static_cast<mp_limb_t>(rest);
    borrow = static_cast<mp_limb_t>(rest >> GMP_NUMB_BITS) & 1;
  }
}

// a b, of n >= m >= 1 limbs; returns the size. The product must overlap neither a nor b.
std::size_t multiply_limbs(mp_limb_t* product, const mp_limb_t* a, std::size_t n, const mp_limb_t* b,
                           std::size_t m) {
  if (n > kShort || m > 2) {
    const mp_limb_t top = m == 1 ? product[n] = mpn_mul_1(product, a, static_cast<mp_size_t>(n), b[0])
                          : n == m && a == b
                              ? (mpn_sqr(product, a, static_cast<mp_size_t>(n)), product[2 * n - 1])
                              : mpn_mul(product, a, static_cast<mp_size_t>(n), b, static_cast<mp_size_t>(m));
    return n + m - (top == 0);
  }
  Wide carry = 0;
  for (std::size_t i = 0; i < n; ++i) {
    carry += static_cast<Wide>(a[i]) * b[0];
    product[i] = static_cast<mp_limb_t>(carry);
    carry >>= GMP_NUMB_BITS;
  }
  product[n] = static_cast<mp_limb_t>(carry);
  if (m == 2) {
    carry = 0;
    for (std::size_t i = 0; i < n; ++i) {
      carry += static_cast<Wide>(a[i]) * b[1] + product[i + 1];
      product[i + 1] = static_cast<mp_limb_t>(carry);
      carry >>= GMP_NUMB_BITS;
    }
    product[n + 1] = static_cast<mp_limb_t>(carry);
  }
  return n + m - (product[n + m - 1] == 0);
}

std::size_t multiply_any(mp_limb_t* product, const mp_limb_t* a, std::size_t n, const mp_limb_t* b,
                         std::size_t m) {
  return n >= m ? multiply_limbs(product, a, n, b, m) : multiply_limbs(product, b, m, a, n);
}

int with_sign(std::size_t n, bool negative) {
  return negative ? -static_cast<int>(n) : static_cast<int>(n);
}

// A number of GMP's own type, for functions that are seldom called.
class Mpz {
 public:
  Mpz() { mpz_init(value_); }
  Mpz(const Mpz&) = delete;
  Mpz& operator=(const Mpz&) = delete;
  ~Mpz() { mpz_clear(value_); }
  operator mpz_ptr() { return value_; }
  Z z() const { return Z(value_); }

 private:
  mpz_t value_;
};

}  // namespace

Z::Z(mpz_srcptr value) : Z() {
  const std::size_t n = mpz_size(value);
  if (n > kInline) adopt(allocate(n), n);
  std::copy_n(mpz_limbs_read(value), n, limbs_);
  size_ = with_sign(n, mpz_sgn(value) < 0);
}

Z::Z(const std::string& digits, int base) : Z() {
  Mpz value;
  if (mpz_set_str(value, digits.c_str(), base) != 0) throw std::invalid_argument("no digits: " + digits);
  *this = value.z();
}

Z::Z(double value) : Z() {
  Mpz whole;
  mpz_set_d(whole, value);
  *this = whole.z();
}

Z::Z(mpf_srcptr value) : Z() {
  Mpz whole;
  mpz_set_f(whole, value);
  *this = whole.z();
}

// The sum may be the same number as a, and b may be its limbs. If they are too few for the sum, new limbs
// replace them after everything is read.
void Z::add(Z& sum, const Z& a, const mp_limb_t* b_limbs, int b_size) {
  const mp_limb_t *more = a.limbs_, *less = b_limbs;
  int size = a.size_, other = b_size;
  std::size_t n = a.count(), m = static_cast<std::size_t>(b_size < 0 ? -b_size : b_size);
  if (n < m) {
    std::swap(more, less);
    std::swap(size, other);
    std::swap(n, m);
  }
  const std::size_t room = n + 1;
  mp_limb_t* const to = room <= sum.capacity_ ? sum.limbs_ : allocate(room);
  if ((size < 0) == (other < 0) || m == 0) {
    const mp_limb_t carry = add_limbs(to, more, n, less, m);
    to[n] = carry;
    n += carry;
  } else {
    if (n == m) {
      while (n > 0 && more[n - 1] == less[n - 1]) --n;
      if (n > 0 && more[n - 1] < less[n - 1]) {
        std::swap(more, less);
        size = other;
      }
      m = n;
    }
    subtract_limbs(to, more, n, less, m);
    n = without_zeros(to, n);
  }
  if (to != sum.limbs_) sum.adopt(to, room);
  sum.size_ = with_sign(n, size < 0);
}

// The product must be neither a nor b.
void Z::multiply(Z& product, const Z& a, const Z& b) {
  const std::size_t n = a.count(), m = b.count();
  if (n == 0 || m == 0) {
    product.size_ = 0;
    return;
  }
  if (n + m > product.capacity_) product.adopt(allocate(n + m), n + m);
  product.size_ =
      with_sign(multiply_any(product.limbs_, a.limbs_, n, b.limbs_, m), (a.size_ < 0) != (b.size_ < 0));
}

Z& Z::add_product(const Z& a, const Z& b, int sign) {
  const std::size_t n = a.count(), m = b.count();
  if (n == 0 || m == 0) return *this;
  const bool negative = ((a.size_ < 0) != (b.size_ < 0)) != (sign < 0);
  if (n == 1 && a.limbs_[0] == 1) {  // frequent: from row to row, from plane to plane
    add(*this, *this, b.limbs_, with_sign(m, negative));
    return *this;
  }
  Scratch product(n + m);
  const std::size_t size = multiply_any(product.limbs(), a.limbs_, n, b.limbs_, m);
  add(*this, *this, product.limbs(), with_sign(size, negative));
  return *this;
}

namespace {

[[noreturn]] void refuse_division_by_zero() {
  throw std::domain_error("division by 0");
}

// The 64 leading bits.
mp_limb_t leading_bits(const mp_limb_t* limbs, std::size_t n) {
  const int zeros = __builtin_clzl(limbs[n - 1]);
  return zeros == 0 ? limbs[n - 1] : limbs[n - 1] << zeros | limbs[n - 2] >> (GMP_NUMB_BITS - zeros);
}

// Quotients of fewer bits than this are off by at most one if the leading bits are divided in binary64.
constexpr long kShortQuotient = 50;

// floor(a / b) for n >= m >= 2 limbs and a short quotient; returns whether it is exact. Most quotients of a
// search have few bits. They are guessed, and the remainder corrects the guess, however far off it is.
bool divide_short(const mp_limb_t* a, std::size_t n, const mp_limb_t* b, std::size_t m, mp_limb_t& quotient) {
  const auto bits = [](const mp_limb_t* limbs, std::size_t k) {
    return static_cast<int>(k) * GMP_NUMB_BITS - __builtin_clzl(limbs[k - 1]);
  };
  const double ratio = static_cast<double>(leading_bits(a, n)) / static_cast<double>(leading_bits(b, m));
  quotient = static_cast<mp_limb_t>(std::ldexp(ratio, bits(a, n) - bits(b, m)));
  const auto size = static_cast<mp_size_t>(m);
  Scratch product(m + 1), rest(m + 1);
  mp_limb_t *const p = product.limbs(), *const r = rest.limbs();
  p[m] = mpn_mul_1(p, b, size, quotient);
  std::copy_n(a, n, r);
  if (n == m) r[m] = 0;
  if (mpn_cmp(r, p, size + 1) >= 0) {
    mpn_sub_n(r, r, p, size + 1);
    while (r[m] != 0 || mpn_cmp(r, b, size) >= 0) {
      r[m] -= mpn_sub_n(r, r, b, size);
      ++quotient;
    }
    return without_zeros(r, m) == 0;
  }
  mpn_sub_n(r, p, r, size + 1);  // guess b - a, which is above 0
  for (--quotient; r[m] != 0 || mpn_cmp(r, b, size) > 0; --quotient) r[m] -= mpn_sub_n(r, r, b, size);
  return mpn_cmp(r, b, size) == 0;
}

}  // namespace

Z::Division divide(const Z& a, const Z& b, Z::Rounding rounding) {
  const std::size_t n = a.count(), m = b.count();
  if (m == 0) refuse_division_by_zero();
  Z::Division result;
  const bool negative = (a.size_ < 0) != (b.size_ < 0);
  std::size_t size = 0;  // of the quotient
  if (n < m) {
    result.exact = n == 0;
  } else if (n == 1) {
    result.quotient.limbs_[0] = a.limbs_[0] / b.limbs_[0];
    result.exact = a.limbs_[0] % b.limbs_[0] == 0;
    size = result.quotient.limbs_[0] != 0;
  } else if (m > 1 && bit_length(a) - bit_length(b) < kShortQuotient) {
    result.exact = divide_short(a.limbs_, n, b.limbs_, m, result.quotient.limbs_[0]);
    size = result.quotient.limbs_[0] != 0;
  } else {
    size = n - m + 1;
    if (size + 1 > Z::kInline) result.quotient.adopt(Z::allocate(size + 1), size + 1);
    mp_limb_t* const to = result.quotient.limbs_;
    if (m == 1) {
      result.exact = mpn_divrem_1(to, 0, a.limbs_, static_cast<mp_size_t>(n), b.limbs_[0]) == 0;
    } else {
      Scratch rest(m);
      mpn_tdiv_qr(to, rest.limbs(), 0, a.limbs_, static_cast<mp_size_t>(n), b.limbs_,
                  static_cast<mp_size_t>(m));
      result.exact = without_zeros(rest.limbs(), m) == 0;
    }
    size = without_zeros(to, size);
  }
  if (!result.exact && rounding != Z::Rounding::to_zero && negative == (rounding == Z::Rounding::down)) {
    // Round away from 0.
    result.quotient.limbs_[size] = 0;
    for (std::size_t i = 0; ++result.quotient.limbs_[i] == 0; ++i) {
    }
    size += result.quotient.limbs_[size] != 0;
  }
  result.quotient.size_ = with_sign(size, negative);
  return result;
}

Z operator/(const Z& a, const Z& b) {
  return divide(a, b, Z::Rounding::to_zero).quotient;
}

Z operator%(const Z& a, const Z& b) {
  Z rest = a;
  rest.subtract_product(a / b, b);
  return rest;
}

Z::Root square_root(const Z& a) {
  if (a.size_ < 0) throw std::domain_error("root of a number below 0");
  Z::Root result;
  const std::size_t n = a.count(), half = (n + 1) / 2;
  if (n == 0) {
    result.exact = true;
    return result;
  }
  if (half > Z::kInline) result.floor.adopt(Z::allocate(half), half);
  result.exact = mpn_sqrtrem(result.floor.limbs_, nullptr, a.limbs_, static_cast<mp_size_t>(n)) == 0;
  result.floor.size_ = static_cast<int>(half);
  return result;
}

Z shifted_left(const Z& a, unsigned long bits) {
  Z result;
  const std::size_t n = a.count(), whole = bits / GMP_NUMB_BITS, room = n + whole + 1;
  if (n == 0) return result;
  if (room > Z::kInline) result.adopt(Z::allocate(room), room);
  mp_limb_t* const to = result.limbs_;
  std::fill_n(to, whole, mp_limb_t{0});
  const unsigned rest = bits % GMP_NUMB_BITS;
  std::size_t size = n + whole;
  if (rest == 0) {
    std::copy_n(a.limbs_, n, to + whole);
  } else {
    to[size] = mpn_lshift(to + whole, a.limbs_, static_cast<mp_size_t>(n), rest);
    size += to[size] != 0;
  }
  result.size_ = with_sign(size, a.size_ < 0);
  return result;
}

Z operator>>(const Z& a, unsigned long bits) {
  const std::size_t n = a.count(), whole = bits / GMP_NUMB_BITS;
  const unsigned part = bits % GMP_NUMB_BITS;
  const bool negative = a.size_ < 0;
  Z result;
  if (n <= whole) return negative ? Z(-1) : result;
  const std::size_t size = n - whole;
  if (size + 1 > Z::kInline) result.adopt(Z::allocate(size + 1), size + 1);
  mp_limb_t* const to = result.limbs_;
  bool cut = without_zeros(a.limbs_, whole) != 0;
  if (part == 0) {
    std::copy_n(a.limbs_ + whole, size, to);
  } else {
    cut |= mpn_rshift(to, a.limbs_ + whole, static_cast<mp_size_t>(size), part) != 0;
  }
  result.size_ = with_sign(without_zeros(to, size), negative);
  return negative && cut ? result -= 1 : result;
}

std::string Z::get_str(int base) const {
  std::string text(mpz_sizeinbase(view(), base) + 2, '\0');
  mpz_get_str(text.data(), base, view());
  text.resize(std::strlen(text.c_str()));
  return text;
}

Z gcd(const Z& a, const Z& b) {
  Mpz result;
  mpz_gcd(result, a.view(), b.view());
  return result.z();
}

Z lcm(const Z& a, const Z& b) {
  Mpz result;
  mpz_lcm(result, a.view(), b.view());
  return result.z();
}

Bezout bezout(const Z& a, const Z& b) {
  Mpz divisor, x, y;
  mpz_gcdext(divisor, x, y, a.view(), b.view());
  return {divisor.z(), x.z(), y.z()};
}

Z power(unsigned long base, unsigned long exponent) {
  Mpz result;
  mpz_ui_pow_ui(result, base, exponent);
  return result.z();
}

BinaryApproximation approximation(const Z& a) {
  BinaryApproximation result;
  result.mantissa = mpz_get_d_2exp(&result.exponent, a.view());
  return result;
}

std::ostream& operator<<(std::ostream& out, const Z& a) {
  return out << a.get_str();
}

}  // namespace lorentz::oracle
