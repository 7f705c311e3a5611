#include "oracle/margin/misses.hpp"

namespace lorentz::oracle {
namespace {

template <std::size_t D>
class MissSearch {
 public:
  MissSearch(const PerturbedQuery<D>& perturbed, long budget)
      : query_(perturbed), smallest_(kLargestMargin), budget_(budget) {}

  HardestDecision run() {
    for (const Uncertain<D>& atom : query_.atoms()) search(atom);
    decision_.margin = to_double(smallest_, kLargestMargin);
    return decision_;
  }

 private:
  static constexpr int kMostDoublings = 80;  // for a flight that runs along a lattice for ever

  // Searches in windows of doubling length; the first one reaches two radii ahead and behind. Each is as wide
  // as margins below the smallest one reach, at most twice the radius, beyond which margins are large.
  void search(const Uncertain<D>& atom) {
    const View<D>& view = atom.view();
    if (view.rank == 0) {  // one obstacle, however far from the line
      const Centre<D> centre = query_.centre_of({atom.lattice(), atom.atom(), {}});
      if (!query_.is_from(atom, centre.point.n)) weigh(atom, centre);
      return;
    }
    const Real radius = real(view.radius), speed = sqrt(real(view.velocity.v2));
    const std::optional<Z> end = last_s(view);
    Z low = -ceiling(2 * radius * speed), high = -low;
    for (int doublings = 0; budget_ >= 0; ++doublings, low = high, high *= 2) {
      const bool is_last = end ? high >= *end : doublings == kMostDoublings;
      const Z limit = end ? std::min(high, *end) : high;
      const Real change = atom.largest_change(real(limit) / real(view.velocity.v2));
      const Real wide = radius + std::min(smallest_ * change, radius);
      if (low < limit) look(atom, wide, low, limit);
      if (is_last) return;
    }
  }

  void look(const Uncertain<D>& atom, const Real& wide, const Z& low, const Z& high) {
    const View<D>& view = atom.view();
    visit_centres(
        view, ceiling(wide * wide * real(view.velocity.v2)), low, high,
        [&](const Centre<D>& centre) {
          --budget_;
          if (!query_.is_from(atom, centre.point.n)) weigh(atom, centre);
        },
        [&](int steps) { return (budget_ -= steps) < 0; });
  }

  // An obstacle behind the start could only be entered from a start inside it.
  void weigh(const Uncertain<D>& atom, const Centre<D>& centre) {
    consider(DecisionKind::containing, atom, centre, atom.margin_of_containing(centre));
    if (centre.s > 0) consider(DecisionKind::meeting, atom, centre, atom.margin_of_meeting(centre));
  }

  void consider(DecisionKind kind, const Uncertain<D>& atom, const Centre<D>& centre, const Real& margin) {
    if (margin >= smallest_) return;
    smallest_ = margin;
    decision_ = {kind, query_.id_of(atom, centre.point.n), false, 0};
  }

  const PerturbedQuery<D>& query_;
  Real smallest_;
  HardestDecision decision_;
  long budget_;
};

}  // namespace

template <std::size_t D>
HardestDecision hardest_miss(const PerturbedQuery<D>& perturbed, long budget) {
  return MissSearch<D>(perturbed, budget).run();
}

template HardestDecision hardest_miss(const PerturbedQuery<2>&, long);
template HardestDecision hardest_miss(const PerturbedQuery<3>&, long);

}  // namespace lorentz::oracle
