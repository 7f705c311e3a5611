#include "random.hpp"

#include <cmath>

namespace lorentz::fuzz {
namespace {

// SplitMix64's finaliser (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t index)
    : state_(mixed(mixed(seed + kGolden) ^ (index * kGolden))) {}

std::uint64_t Random::bits() {
  return mixed(state_ += kGolden);
}

double Random::uniform() {
  return static_cast<double>(bits() >> 11) * 0x1p-53;
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
  const int exponent = static_cast<int>(integer(low, high - 1));
  return std::ldexp(1 + uniform(), exponent);
}

std::uint64_t seed_for(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return mixed(seed ^ mixed(hash));
}

}  // namespace lorentz::fuzz
