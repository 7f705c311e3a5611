#include <lorentz/engine.hpp>

#include <lorentz/engine_base.hpp>

namespace lorentz {

void ScaledVelocity::set_extreme(const Vec& v, double largest) {
  exponent = std::ilogb(largest);
  for (int i = 0; i < 3; ++i) scaled[i] = std::scalbn(v[i], -exponent);
}

void Engine::first_hit(const Query& query, double max_time, Answer& answer) const {
  first_hit_by(query, max_time, answer,
               [this](const Ray& ray, double limit, Answer& given) { first_hit_scaled(ray, limit, given); });
}

}  // namespace lorentz
