#include "statistics/survival/survival.hpp"

#include <lorentz/itinerary.hpp>
#include "statistics/survival/rival.hpp"

namespace lorentz::survival {
namespace {

using oracle::CertifiedCollision;

using IsRight = std::function<bool(const CertifiedCollision& truth)>;

// A trajectory in one arithmetic: true while it hits what the certified one hits.
IsRight flown_in(long bits, const question::EngineInfo& engine, const RationalScene& scene,
                 const Start& start) {
  if (bits != 53 && bits != 106)
    return [rounded = std::make_shared<oracle::RoundedItinerary>(scene, start, bits)](
               const CertifiedCollision& truth) { return rounded->next() == truth.obstacle; };
  const Precision precision = bits == 53 ? Precision::binary64 : Precision::double_double;
  return [rival = std::make_shared<Rival>(engine, precision, scene, start)](const CertifiedCollision& truth) {
    rival->meet(truth);
    return !rival->diverged();
  };
}

Start start_of(const Query& query) {
  Start start;
  for (int i = 0; i < 3; ++i) start.x[i] = query.x[i], start.v[i] = Surd(Rational(query.v[i]));
  start.from = query.from;
  return start;
}

void follow(const RationalScene& scene, const Start& start, const std::atomic<bool>& stop,
            Survival& survival) {
  std::vector<IsRight> flights;
  for (const Arithmetic& one : survival.arithmetics)
    flights.push_back(flown_in(one.bits, survival.plan.engine, scene, start));
  std::vector<std::uint64_t> right(flights.size());
  oracle::Journey journey;
  journey.collisions = survival.plan.collisions;
  journey.stop = &stop;
  oracle::Itinerary(scene).follow(start, journey, [&](const CertifiedCollision& truth) {
    bool any = false;
    for (std::size_t i = 0; i < flights.size(); ++i) {
      if (!flights[i]) continue;
      if (!flights[i](truth)) flights[i] = {};  // wrong from here on
      right[i] += bool{flights[i]};
      any |= bool{flights[i]};
    }
    return any;
  });
  if (stop) return;  // the last start is incomplete
  for (std::size_t i = 0; i < right.size(); ++i) survival.arithmetics[i].right.push_back(right[i]);
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
