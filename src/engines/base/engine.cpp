#include <lorentz/engine.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace lorentz {
ScaledVelocity::ScaledVelocity(const Vec& v) : scaled(v) {
  const double largest = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  exponent = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) - 1023;
  if (exponent > -1000 && exponent < 1000) {
    const double factor = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent) << 52);
    for (double& component : scaled) component *= factor;
  } else {
    exponent = std::ilogb(largest);
    for (double& component : scaled) component = std::scalbn(component, -exponent);
  }
  for (int i = 0; i < 3; ++i) tiny_component |= v[i] != 0 && std::fabs(scaled[i]) < kTinyComponent;
}

double scaled_time(double time, int exponent) {
  const double factor = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
  return exponent > -500 && exponent < 500 ? time * factor : std::scalbn(time, exponent);
}

void Engine::first_hit(const Query& query, double max_time, Answer& answer) const {
  first_hit_by(query, max_time, answer,
               [this](const Ray& ray, double limit, Answer& given) { first_hit_scaled(ray, limit, given); });
}

}  // namespace lorentz
