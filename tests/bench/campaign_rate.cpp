// The cost of a campaign: cases per second of processor time, by target, with
// and without variants. The cost of the engine itself, `certified`, is negligible.
//
// campaign_rate [SECONDS]
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>

#include "fuzz/campaign/campaign.hpp"
#include "fuzz/campaign/examiner.hpp"

using namespace lorentz;

namespace {

class NoJournal final : public fuzz::Journal {
  void record(const cases::Target&, const fuzz::TargetTally&, const std::vector<fuzz::Finding>&) override {}
  void tick() override {}
};

double rate(const cases::Target& target, std::uint64_t mutate, double seconds) {
  fuzz::Plan plan;
  plan.targets = {&target};
  plan.mutate = mutate;
  fuzz::Bounds bounds;
  bounds.seconds = seconds;
  std::vector<fuzz::TargetTally> tallies(1);
  NoJournal journal;
  const std::clock_t start = std::clock();
  fuzz::run(plan, bounds, fuzz::answerer_maker(question::engine_named("certified")), tallies, journal);
  return static_cast<double>(tallies[0].cases + tallies[0].variants) * CLOCKS_PER_SEC /
         static_cast<double>(std::clock() - start);
}

}  // namespace

int main(int count, char** arguments) {
  const double seconds = count > 1 ? std::atof(arguments[1]) : 5;
  fmt::print("cases and variants a second of one core\ntarget         cases  with variants\n");
  for (const char* name : {"generic-2d", "generic-3d"}) {
    const cases::Target& target = *cases::target_named(name);
    fmt::print("{:<12} {:7.0f} {:14.0f}\n", name, rate(target, 0, seconds), rate(target, 32, seconds));
  }
}
