// The engine for a scene that the requested engine does not support.
#pragma once

#include <string>

#include <lorentz/engine_base.hpp>

namespace lorentz {

/// Answers every valid query with `unsupported` and the reason.
class Unsupported final : public Engine {
 public:
  Unsupported(const Scene& scene, std::string why) : Engine(scene), why_(std::move(why)) {}

 private:
  void first_hit_scaled(const Ray&, double, Answer& answer) const override {
    answer = Answer::unsupported_because(why_);
  }

  const std::string why_;
};

}  // namespace lorentz
