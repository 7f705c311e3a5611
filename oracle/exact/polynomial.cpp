#include "oracle/exact/polynomial.hpp"

#include <algorithm>

namespace lorentz::oracle {
namespace {

// The remainder of a by b, times a positive number.
Polynomial remainder(Polynomial a, const Polynomial& b) {
  while (a.size() >= b.size()) {
    const Z factor = a.back() * sgn(b.back()), scale = abs(b.back());
    std::vector<Z> shifted(a.size() - b.size());
    for (std::size_t i = 0; i < b.size(); ++i) shifted.push_back(factor * b[i]);
    a = primitive(Polynomial{scale} * a - Polynomial(std::move(shifted)));
  }
  return a;
}

}  // namespace

Polynomial::Polynomial(std::vector<Z> coefficients) : terms_(std::move(coefficients)) {
  while (!terms_.empty() && terms_.back() == 0) terms_.pop_back();
}

const Z& Polynomial::operator[](std::size_t k) const {
  static const Z zero = 0;
  return k < terms_.size() ? terms_[k] : zero;
}

Polynomial Polynomial::sum(const Polynomial& a, const Polynomial& b, int sign) {
  std::vector<Z> terms = a.terms_;
  terms.resize(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) terms[i] += sign * b.terms_[i];
  return Polynomial(std::move(terms));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Z> terms(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) terms[i + k].add_product(a.terms_[i], b.terms_[k]);
  return Polynomial(std::move(terms));
}

Polynomial derivative(const Polynomial& p) {
  std::vector<Z> terms;
  for (std::size_t i = 1; i < p.size(); ++i) terms.push_back(p[i] * static_cast<long>(i));
  return Polynomial(std::move(terms));
}

Polynomial primitive(const Polynomial& p) {
  Z common = 0;
  for (std::size_t i = 0; i < p.size(); ++i) common = gcd(common, p[i]);
  std::vector<Z> terms;
  for (std::size_t i = 0; i < p.size(); ++i) terms.push_back(p[i] / common);
  return Polynomial(std::move(terms));
}

std::vector<Polynomial> remainders(const Polynomial& a, const Polynomial& b) {
  std::vector<Polynomial> chain{a};
  for (Polynomial next = primitive(b); !next.is_zero();) {
    chain.push_back(next);
    next = Polynomial() - remainder(chain[chain.size() - 2], next);
  }
  return chain;
}

}  // namespace lorentz::oracle
