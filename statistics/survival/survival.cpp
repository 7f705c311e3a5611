#include "statistics/survival/survival.hpp"

#include <lorentz/itinerary.hpp>
#include "statistics/survival/rival.hpp"

namespace lorentz::survival {
namespace {

using oracle::CertifiedCollision;

// Follows one start in one arithmetic, as long as it is right.
class Runner {
 public:
  Runner(const Arithmetic& arithmetic, const question::EngineInfo& engine, const RationalScene& scene,
         const Start& start) {
    if (arithmetic.bits == 53 || arithmetic.bits == 106)
      rival_ = std::make_unique<Rival>(
          engine, arithmetic.bits == 53 ? Precision::binary64 : Precision::double_double, scene, start);
    else
      rounded_ = std::make_unique<oracle::RoundedItinerary>(scene, start, arithmetic.bits);
  }

  /// Returns false from the first wrong obstacle on.
  bool meet(const CertifiedCollision& truth) {
    if (!is_right_) return false;
    if (rival_) rival_->meet(truth);
    is_right_ = rival_ ? !rival_->diverged() : rounded_->next() == truth.obstacle;
    right_ += is_right_;
    return is_right_;
  }
  std::uint64_t right() const { return right_; }

 private:
  std::unique_ptr<Rival> rival_;
  std::unique_ptr<oracle::RoundedItinerary> rounded_;
  bool is_right_ = true;
  std::uint64_t right_ = 0;
};

Start start_of(const Query& query) {
  Start start;
  for (int i = 0; i < 3; ++i) start.x[i] = query.x[i], start.v[i] = Surd(Rational(query.v[i]));
  start.from = query.from;
  return start;
}

void follow(const RationalScene& scene, const Start& start, const std::atomic<bool>& stop,
            Survival& survival) {
  std::vector<Runner> runners;
  for (const Arithmetic& one : survival.arithmetics)
    runners.emplace_back(one, survival.plan.engine, scene, start);
  oracle::Journey journey;
  journey.collisions = survival.plan.collisions;
  journey.stop = &stop;
  oracle::Itinerary(scene).follow(start, journey, [&](const CertifiedCollision& truth) {
    bool any = false;
    for (Runner& runner : runners) any |= runner.meet(truth);
    return any;
  });
  if (stop) return;  // the last start is incomplete
  for (std::size_t i = 0; i < runners.size(); ++i)
    survival.arithmetics[i].right.push_back(runners[i].right());
}

}  // namespace

Survival survival_of(const SurvivalPlan& plan, const std::atomic<bool>& stop,
                     const std::function<void(std::uint64_t)>& on_progress) {
  Survival survival{plan, {}};
  for (const long bits : plan.bits) survival.arithmetics.push_back({bits});
  const starts::FreeStarts starts(plan.scene, starts::Kind::surface, plan.seed);
  const RationalScene exact = rational(plan.scene);
  for (std::uint64_t i = 0; i < plan.count && !stop; ++i) {
    follow(exact, start_of(starts[i]), stop, survival);
    if (on_progress) on_progress(i + 1);
  }
  return survival;
}

}  // namespace lorentz::survival
