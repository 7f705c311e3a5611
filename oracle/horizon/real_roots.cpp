// A point a / 2^bits is given by a and bits. If bits is below 0, the point is an even integer.
#include "oracle/horizon/real_roots.hpp"

#include <algorithm>

#include "oracle/exact/quadratic.hpp"

namespace lorentz::oracle {
namespace {

int sign_of_value(const Polynomial& p, const Z& a, long bits) {
  return p.is_zero() ? 0 : sgn(value_at(p, p.size() - 1, a, bits));
}

// Sturm's theorem: the number of roots in (low, high] / 2^bits, for a polynomial without multiple roots.
class RootCount {
 public:
  explicit RootCount(const Polynomial& p) : chain_(remainders(p, derivative(p))) {}

  const Polynomial& multiple_roots() const { return chain_.back(); }
  int operator()(const Z& low, const Z& high, long bits) const {
    const auto changes_at = [&](const Z& a) {
      return sign_changes(chain_, [&](const Polynomial& p) { return sign_of_value(p, a, bits); });
    };
    return changes_at(low) - changes_at(high);
  }

 private:
  std::vector<Polynomial> chain_;
};

// Every root is smaller than 2^result in size, because the largest |c_i / c_n| + 1 is more than any root.
long bits_of_roots(const Polynomial& p) {
  long most = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    most = std::max(most, bit_length(p[i]) - bit_length(p.back()) + 1);
  return most + 1;
}

}  // namespace

Z value_at(const Polynomial& p, std::size_t degree, const Z& a, long bits) {
  const auto shift = static_cast<unsigned long>(std::labs(bits));
  const Z point = bits < 0 ? shifted_left(a, shift) : a;
  Z value = 0;
  for (std::size_t k = degree + 1; k-- > 0;)
    value = value * point + (bits < 0 ? p[k] : shifted_left(p[k], shift * (degree - k)));
  return value;
}

void RealRoot::refine() {
  low = 2 * low;
  ++bits;
  const int sign = sign_of_value(polynomial, low + 1, bits);
  if (sign != 0 && sign != sign_above) ++low;
}

std::vector<RealRoot> real_roots(Polynomial polynomial) {
  polynomial = primitive(polynomial);
  if (polynomial.size() < 2) return {};
  RootCount count(polynomial);
  if (count.multiple_roots().size() > 1) {
    polynomial = exact_quotient(polynomial, count.multiple_roots());
    count = RootCount(polynomial);
  }
  std::vector<RealRoot> roots;
  const auto search = [&](const auto& self, const Z& low, long bits) -> void {
    const Z high = low + 1;
    const int inside = count(low, high, bits);
    if (inside == 1) {
      roots.push_back({polynomial, sign_of_value(polynomial, high, bits), low, bits});
    } else if (inside > 1) {
      self(self, 2 * low, bits + 1);
      self(self, 2 * low + 1, bits + 1);
    }
  };
  for (const int half : {-1, 0}) search(search, half, -bits_of_roots(polynomial));
  return roots;
}

// The intervals are disjoint, or one is within the other. A common root of the polynomials in the smaller
// interval is the only root of both.
int compare(RealRoot& a, RealRoot& b) {
  constexpr int kCheap = 16;  // refinements before equality is tested
  for (int round = 0;; ++round) {
    RealRoot &wide = a.bits <= b.bits ? a : b, &fine = a.bits <= b.bits ? b : a;
    const int side = sgn((fine.low >> static_cast<unsigned long>(fine.bits - wide.bits)) - wide.low);
    if (side != 0) return &fine == &a ? side : -side;
    if (round == kCheap) {
      const Polynomial common = remainders(a.polynomial, b.polynomial).back();
      if (RootCount(common)(fine.low, fine.low + 1, fine.bits) > 0) return 0;
    }
    wide.refine();
  }
}

// The loop ends: the root is midway between two binary64 only if it is an end of the interval from some
// refinement on.
double round_to_binary64(RealRoot root) {
  for (;; root.refine()) {
    const Z high = root.low + 1;
    const double rounded = round_to_binary64({high, 1, 0, 1, -root.bits});
    if (sign_of_value(root.polynomial, high, root.bits) == 0 ||
        rounded == round_to_binary64({root.low, 1, 0, 1, -root.bits}))
      return rounded;
  }
}

}  // namespace lorentz::oracle
