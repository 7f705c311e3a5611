// Reports of mean squared displacements as text, CSV and JSON, with theory for comparison.
#pragma once

#include <optional>
#include <string>

#include "statistics/chaos/diffusion.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::chaos {

struct DiffusionReport {
  DiffusionReport(std::string scene_name, DiffusionPlan its_plan, Diffusion what_was_found);

  std::string scene;  ///< its name as given by the user
  DiffusionPlan plan;
  Diffusion found;
  std::optional<double> random_walk;  ///< Machta and Zwanzig's coefficient
  std::optional<double> mean_free_path;
  flights::Tail tail;  ///< of free paths from uniform starts, t -> infinity

  /// False if no particle got beyond its first obstacle, or no group was finished. When particles ended early
  /// and no collision is counted, the remaining particles are those that hit nothing.
  bool has_content() const { return found.particles > 0 && !(found.collisions == 0 && found.stopped > 0); }

  std::string table() const;
  std::string csv() const;   ///< one line per displacement
  std::string json() const;  ///< one object on one line

 private:
  static constexpr double kLeastPaths = 20;
  bool is_uniform() const { return plan.from == flights::Ensemble::uniform; }
  /// True if the particles have hardly collided, so that the MSD does not grow linearly yet.
  bool is_too_short() const { return mean_free_path && plan.time < kLeastPaths * *mean_free_path; }
  bool has_corridors() const { return tail.open.value_or(false); }
  Estimate rate(const Displacement& at) const;  ///< MSD / (2 d t)
  std::string lines_of_coefficient() const;
  std::string lines_of_theory() const;
};

}  // namespace lorentz::chaos
