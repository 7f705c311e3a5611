#include "fuzz/campaign/campaign.hpp"

#include <chrono>
#include <thread>
#include <tuple>

#include "fuzz/campaign/ledger.hpp"
#include "fuzz/campaign/ranks.hpp"

namespace lorentz::fuzz {

using namespace cases;

namespace {

using CampaignClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenRecords{5};

// Records and serves until all is done, the time is up, or `bounds.stop` is set.
void keep(Ledger& ledger, const Bounds& bounds, Journal& journal, Ranks* ranks) {
  const auto start = CampaignClock::now();
  for (bool more = true; more;) {
    if (!ledger.stop()) std::this_thread::sleep_for(kBetweenRecords);
    more = ledger.record();
    journal.tick();
    if (ranks) ranks->serve(ledger);
    const std::chrono::duration<double> passed = CampaignClock::now() - start;
    if (passed.count() >= bounds.seconds || (bounds.stop && *bounds.stop)) ledger.stop_all();
  }
}

}  // namespace

bool Scope::admits(const Scene& scene) const {
  if (dimension != 0 && scene.dimension != dimension) return false;
  if (scenes == Scenes::any) return true;
  if (scenes == Scenes::unit) return is_unit_scene(scene);
  const Lattice& lattice = scene.lattices[0];
  return scene.lattices.size() == 1 && lattice.atoms.size() == 1 && lattice.atoms[0].is_ball() &&
         lattice.rank_in(scene.dimension) == (scenes == Scenes::ball ? 0 : scene.dimension);
}

bool Scope::meets(const Target& target, std::uint64_t seed) const {
  constexpr std::uint64_t kScenes = 64;
  for (std::uint64_t number = 0; number < kScenes; ++number)
    if (admits(target.make(seed, number * kCasesPerScene).scene)) return true;
  return false;
}

void TargetTally::add(const TargetTally& other) {
  cases += other.cases;
  variants += other.variants;
  outside += other.outside;
  reworded += other.reworded;
  counts += other.counts;
  for (std::size_t s = 0; s < stages.size(); ++s) stages[s] += other.stages[s];
  for (const auto& [sort, number] : other.sorts) sorts[sort] += number;
  if (std::tie(other.margin, other.margin_index) < std::tie(margin, margin_index))
    margin = other.margin, margin_index = other.margin_index;
}

bool run(const Plan& plan, const Bounds& bounds, const MakeAnswerer& make_answerer,
         std::vector<TargetTally>& tallies, Journal& journal, Ranks* ranks,
         const std::vector<Finding>& known) {
  const std::size_t processes = ranks ? static_cast<std::size_t>(ranks->size()) : 1;
  Ledger ledger(plan, bounds, processes * bounds.jobs, tallies, journal, known);
  Workers workers(plan, make_answerer, ledger, bounds.jobs);
  try {
    keep(ledger, bounds, journal, ranks);
    ledger.stop_all();
    journal.ended();
  } catch (...) {
    ledger.stop_all();
    throw;
  }
  workers.join();
  if (ranks) ranks->dismiss(ledger);
  return ledger.had_failing_answerer();
}

}  // namespace lorentz::fuzz
