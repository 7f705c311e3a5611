#include "question/cases/random.hpp"

#include <Random123/philox.h>

#include <cmath>

#include <lorentz/geometry.hpp>

namespace lorentz::cases {
namespace {

constexpr std::size_t kBlock = 2;  // the word of the counter that counts blocks

}  // namespace

void Random::next_block() {
  const philox4x64_key_t key{{key_[0], key_[1]}};
  const philox4x64_ctr_t counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const philox4x64_ctr_t block = philox4x64(counter, key);
  for (std::size_t i = 0; i < block_.size(); ++i) block_[i] = block.v[i];
  ++counter_[kBlock];
  taken_ = 0;
}

Vec Random::direction(int dimension) {
  for (;;) {
    Vec v{};
    double length2 = 0;
    for (int i = 0; i < dimension; ++i) {
      v[i] = 2 * uniform() - 1;
      length2 += v[i] * v[i];
    }
    if (length2 > 1 || length2 < 0.01) continue;
    const double length = std::sqrt(length2);
    for (double& component : v) component /= length;
    return v;
  }
}

Vec Random::vector(int dimension, double length) {
  return scaled(direction(dimension), length);
}

std::int64_t Random::integer(std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low) + 1));
}

double Random::between(double low, double high) {
  return low + (high - low) * uniform();
}

double Random::sign() {
  return bits() & 1 ? 1 : -1;
}

double Random::octave(int low, int high) {
  const int k = exponent(low, high - 1);
  return std::ldexp(1 + uniform(), k);
}

}  // namespace lorentz::cases
