// Margins are computed late: only of decisions that cheap lower bounds do not show to be easier than others. The
// bounds are held against the margins, in the scenes of all targets.
#include <catch2/catch.hpp>

#include <lorentz/oracle.hpp>
#include "fuzz/families/family.hpp"
#include "oracle/margin/perturbed_query.hpp"

using namespace lorentz;
using namespace lorentz::oracle;

namespace {

constexpr std::uint64_t kSeed = 2711;
constexpr int kMostCentres = 40;  // of an atom

// Centres within two radii of the line, the first of each atom.
template <std::size_t D, class Look>
void look_at_centres(const PerturbedQuery<D>& query, const Look& look) {
  for (const Uncertain<D>& atom : query.atoms()) {
    int left = kMostCentres;
    const View<D>& view = atom.view();
    const Z high = shifted_left(root_below(atom.rho2()) + 1, 8);
    visit_centres(
        view, 4 * atom.rho2(), -high, high,
        [&](const Centre<D>& centre) {
          if (left-- > 0) look(atom, centre);
        },
        [&](int steps) { return (left -= steps) < 0; });
  }
}

struct Seen {
  int centres = 0, near = 0, orders = 0, near_orders = 0;

  // A bound is below the margin, or nothing is known; it is near if it is at least a tenth of it.
  bool hold(Estimate least, const Real& margin) {
    const Estimate its = estimate(margin);
    near += least > its / 10;
    return std::isnan(least) || least <= its * (1 + 0x1p-40L);
  }
};

template <std::size_t D>
void check(const PerturbedQuery<D>& query, Seen& seen) {
  HardestSoFar<D> late, early;
  const Uncertain<D>* other = nullptr;
  std::optional<Centre<D>> entered;
  look_at_centres(query, [&](const Uncertain<D>& atom, const Centre<D>& centre) {
    ++seen.centres;
    const Centre<D> again(atom.view().velocity, centre.point);
    CHECK((centre.s == again.s && centre.c2 == again.c2 && centre.h2 == again.h2));
    const Real containing = atom.margin_of_containing(centre), meeting = atom.margin_of_meeting(centre);
    CHECK(seen.hold(atom.least_of_containing(centre), containing));
    CHECK(seen.hold(atom.least_of_meeting(centre), meeting));
    late.containing(atom, centre), late.meeting(atom, centre);
    early.see(DecisionKind::containing, atom, centre, centre.c2 < atom.view().radius2, containing);
    early.see(DecisionKind::meeting, atom, centre, centre.h2 < atom.rho2(), meeting);
    if (centre.s <= 0 || centre.h2 >= atom.rho2()) return;
    if (entered) {
      const Real order = other->margin_of_order(*entered, atom, centre);
      const int near = seen.near;
      CHECK(seen.hold(other->least_of_order(*entered, atom, centre), order));
      ++seen.orders, seen.near_orders += seen.near - near;
    }
    other = &atom, entered = centre;
  });
  const HardestDecision one = late.decision(), two = early.decision();
  CHECK((one.kind == two.kind && one.obstacle == two.obstacle && one.yes == two.yes &&
         one.margin == two.margin));
}

}  // namespace

TEST_CASE("A margin computed late is the one computed early, because its lower bound is one",
          "[oracle][margin_bounds]") {
  Seen seen;
  for (const cases::Target& target : cases::targets()) {
    INFO(target.name());
    for (std::uint64_t index = 0; index < 320; index += 16) {
      const cases::Case one = target.make(kSeed, index);
      PerturbedScene(one.scene, NumberFormat::binary64).with(one.query, [&](const auto& query) {
        check(query, seen);
      });
    }
  }
  CHECK(seen.centres > 10'000);   // 15 503 seen
  CHECK(seen.near > 20'000);      // 28 054, of two for each and one for each order: bounds that are of use
  CHECK(seen.orders > 1000);      // 1337
  CHECK(seen.near_orders > 300);  // 464
}
