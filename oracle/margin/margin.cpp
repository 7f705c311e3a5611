// Finds the smallest margin of an answer. The obstacles that the line meets lie in a cylinder. An obstacle
// that is nearly hit, or nearly contains x, lies outside this cylinder by at most the change that k ulps
// make. So widen the cylinder until the first of them is found, and look at all that the widened cylinder
// holds. A change grows with the time T along the flight, and so does the widening.
#include <lorentz/margin.hpp>

#include <algorithm>
#include <limits>

#include <lorentz/errors.hpp>

#include "oracle/margin/perturbed_query.hpp"

namespace lorentz::oracle {
namespace {

// The number of points and stretches of one atom that a search may look at. There are more only where
// thousands of obstacles are about equally hard to tell apart; the margin is then the smallest of those
// looked at.
constexpr long kSmallBudget = 500;
constexpr double kFirstTry = 0x1p-30, kGrowth = 8;
constexpr int kMostTries = 4;
constexpr int kMostDoublings = 80;  // for a flight that misses all, and runs along a lattice for ever

template <std::size_t D>
class MarginSearch {
 public:
  MarginSearch(const PerturbedQuery<D>& perturbed, const Answer& exact, long budget)
      : query_(perturbed),
        exact_(exact),
        full_budget_(budget),
        budget_(std::max(budget, kSmallBudget)),
        is_hit_(exact.outcome == Outcome::hit),
        is_never_(exact.outcome == Outcome::never),
        target_(perturbed.atom_of(exact.obstacle)),
        target_centre_(perturbed.centre_of(exact.obstacle)),
        target_time_(is_hit_ ? target_.time_of(target_centre_) : Real(0)) {}

  HardestDecision run() {
    for (const Uncertain<D>& atom : query_.atoms())
      if (is_never_)
        search_missed(atom);
      else if (concerns(atom))
        search(atom);
    if (!is_hit_ && !is_never_)
      weigh(target_, target_centre_);  // which may be far behind the first of very many
    return hardest_.decision();
  }

 private:
  // `inside` depends only on the obstacles up to the one named.
  bool concerns(const Uncertain<D>& atom) const {
    return is_hit_ || std::pair(atom.lattice(), atom.atom()) <= std::pair(target_.lattice(), target_.atom());
  }

  // Searches until no obstacle of this atom with a margin below the smallest can be left: in one step or, if
  // that step would hold thousands of obstacles (along a wall of a channel), by widening more and more.
  void search(const Uncertain<D>& atom) {
    const Real radius = real(atom.view().radius);
    // The latest T at which an obstacle, with up to twice its radius, counts.
    const Real change = atom.largest_change(target_time_ + 2 * radius / atom.speed());
    Real k = std::min(Real(kLargestMargin), radius / change / 4);
    if (!search_at_once(atom, radius + k * change)) {
      int tries = 0;
      do k *= kFirstTry;
      while (!search_in_windows(atom, k, change, kSmallBudget) && ++tries < kMostTries);
    }
    for (bool complete = full_budget_ > 0; complete && k < hardest_.margin();) {
      k = std::min(k * kGrowth, hardest_.margin());
      complete = search_in_windows(atom, k, change, full_budget_);
    }
  }

  // Widens so little that the cylinder stays about as large as it was. Returns whether the budget was enough.
  bool search_at_once(const Uncertain<D>& atom, const Real& wide) {
    budget_ = kSmallBudget;
    look(atom, wide, first_s(atom, wide), last_s(atom, wide));
    return budget_ >= 0;
  }

  // Widens as the changes grow along the flight. Returns whether the budget was enough.
  bool search_in_windows(const Uncertain<D>& atom, const Real& k, const Real& last_change, long budget) {
    const Real radius = real(atom.view().radius), v2 = real(atom.view().velocity.v2);
    const Z end = last_s(atom, radius + k * last_change);
    Z low = first_s(atom, radius + k * atom.largest_change(Real(0)));
    budget_ = budget;
    for (Real time = turning_point(); low < end && budget_ >= 0; time *= 2) {
      const Z high = std::min(end, ceiling(time * v2));
      look(atom, radius + k * atom.largest_change(time), low, high);
      low = high;
    }
    return budget_ >= 0;
  }

  // Searches in windows of doubling length; the first one reaches two radii ahead and behind. Each is as wide
  // as margins below the smallest one reach, at most twice the radius, beyond which margins are large.
  void search_missed(const Uncertain<D>& atom) {
    const View<D>& view = atom.view();
    if (view.rank == 0)  // one obstacle, however far from the line
      return weigh(atom, query_.centre_of({atom.lattice(), atom.atom(), {}}));
    const Real radius = real(view.radius);
    const std::optional<Z> end = oracle::last_s(view);
    Z low = -ceiling(2 * radius * atom.speed()), high = -low;
    for (int doublings = 0; budget_ >= 0; ++doublings, low = high, high *= 2) {
      const bool is_last = end ? high >= *end : doublings == kMostDoublings;
      const Z limit = end ? std::min(high, *end) : high;
      const Real change = atom.largest_change(real(limit) / real(view.velocity.v2));
      if (low < limit) look(atom, radius + std::min(hardest_.margin() * change, radius), low, limit);
      if (is_last) return;
    }
  }

  // The time from which on the uncertainty of v counts for more than that of x.
  Real turning_point() const {
    Real x = 0, v = 0;
    for (std::size_t i = 0; i < D; ++i) {
      x += query_.ulps().x[i];
      v += query_.ulps().v[i];
    }
    return x / v;
  }

  Z first_s(const Uncertain<D>& atom, const Real& wide) const { return -ceiling(wide * atom.speed()); }
  Z last_s(const Uncertain<D>& atom, const Real& wide) const {
    return ceiling(target_time_ * real(atom.view().velocity.v2)) - first_s(atom, wide);
  }

  void look(const Uncertain<D>& atom, const Real& wide, const Z& low, const Z& high) {
    const View<D>& view = atom.view();
    visit_centres(
        view, ceiling(wide * wide * real(view.velocity.v2)), low, high,
        [&](const Centre<D>& centre) { --budget_, weigh(atom, centre); },
        [&](int steps) { return (budget_ -= steps) < 0; });
  }

  // Weighs the decisions about one obstacle.
  void weigh(const Uncertain<D>& atom, const Centre<D>& centre) {
    if (query_.is_from(atom, centre.point.n)) return;
    const bool is_target = &atom == &target_ && centre.point.n == target_centre_.point.n;
    if (is_hit_ || is_never_ || is_target || &atom != &target_ || centre.point.n <= target_centre_.point.n)
      hardest_.containing(atom, centre);
    if (is_never_ ? centre.s > 0 : is_hit_ && is_target) {  // never: what lies behind could only contain x
      hardest_.meeting(atom, centre);
    } else if (!is_hit_) {
      return;
    } else if (centre.s > 0 && centre.h2 < atom.rho2()) {
      if (hardest_.may_be(target_.least_of_order(target_centre_, atom, centre)))
        hardest_.see(DecisionKind::order, atom, centre, false,
                     target_.margin_of_order(target_centre_, atom, centre));
    } else if (centre.s > 0 && hardest_.may_be(atom.least_of_meeting(centre)) &&
               nearest_before_target(atom, centre)) {
      hardest_.meeting(atom, centre);
    }
  }

  // True if a missed obstacle, were it just met, would be entered before the one that was hit.
  bool nearest_before_target(const Uncertain<D>& atom, const Centre<D>& centre) const {
    return compare_entries(centre.s, 0, atom.view().velocity.v2, target_centre_.s,
                           target_.rho2() - target_centre_.h2, target_.view().velocity.v2) < 0;
  }

  const PerturbedQuery<D>& query_;
  const Answer& exact_;
  const long full_budget_;
  long budget_;
  const bool is_hit_, is_never_;
  const Uncertain<D>& target_;
  const Centre<D> target_centre_;
  const Real target_time_;
  HardestSoFar<D> hardest_;
};

// Widens the cylinder until it holds enough obstacles, or is three times as wide.
template <std::size_t D>
std::vector<PassedObstacle> passed_obstacles(const PerturbedQuery<D>& perturbed, const Answer& exact,
                                             std::size_t most) {
  const Uncertain<D>& target = perturbed.atom_of(exact.obstacle);
  const Centre<D> hit = perturbed.centre_of(exact.obstacle);
  const Real target_time = target.time_of(hit);
  const long own_units = perturbed.query().time_exponent();
  std::vector<PassedObstacle> all;
  for (double wide = 1 + 0x1p-20; wide < 4 && all.size() < most; wide = 1 + (wide - 1) * 8) {
    all.clear();
    for (const Uncertain<D>& atom : perturbed.atoms()) {
      const View<D>& view = atom.view();
      const Real rho = sqrt(real(atom.rho2())), v2 = real(view.velocity.v2);
      long budget = kMarginBudget;
      const auto look = [&](const Centre<D>& centre) {
        --budget;
        const auto& n = centre.point.n;
        const Real nearest = real(centre.s) / v2, time = times_power_of_two(nearest, own_units);
        const bool is_target = &atom == &target && n == hit.point.n;
        if (!is_target && (centre.s <= 0 || nearest > target_time || perturbed.is_from(atom, n))) return;
        all.push_back({perturbed.id_of(atom, n), to_double(time, kHuge), to_string(time),
                       to_double(sqrt(real(centre.h2)) / rho - 1, kHuge),
                       to_double(atom.margin_of_meeting(centre), kHuge)});
      };
      visit_centres(view, ceiling(wide * wide * real(atom.rho2())), 1,
                    ceiling(target_time * v2) + ceiling(rho), look,
                    [&](int steps) { return (budget -= steps) < 0; });
    }
  }
  std::sort(all.begin(), all.end(), [&](const PassedObstacle& a, const PassedObstacle& b) {
    const bool a_hit = a.obstacle == exact.obstacle, b_hit = b.obstacle == exact.obstacle;
    return a_hit != b_hit ? a_hit : a.gap < b.gap;
  });
  if (all.size() > most) all.resize(most);
  std::sort(all.begin(), all.end(),
            [](const PassedObstacle& a, const PassedObstacle& b) { return a.time < b.time; });
  return all;
}

// a 2^exponent, with an odd mantissa.
std::string hexadecimal(const Z& a, long exponent) {
  if (a == 0) return "0x0p+0";
  const long zeros = trailing_zeros(a), power = exponent + zeros;
  return std::string(a < 0 ? "-" : "") + "0x" + floor_div(abs(a), shifted_left(Z(1), zeros)).get_str(16) +
         'p' + (power < 0 ? "" : "+") + std::to_string(power);
}

bool is_binary64(const Z& a, long exponent) {
  constexpr long kLeast = -1074, kBeyond = 1024, kBits = 53;
  if (a == 0) return true;
  const long lowest = exponent + trailing_zeros(a), highest = exponent + bit_length(a);
  return lowest >= kLeast && highest <= kBeyond && highest - lowest <= kBits;
}

}  // namespace

struct Margins::Impl {
  PerturbedScene scene;

  // The change of the time, in this unit, if every input moves by an ulp.
  double change(const Query& query, const Answer& exact, double unit) const {
    if (exact.outcome != Outcome::hit || !exact.time) throw InputError("answer: is not a hit with a time");
    return scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
      return to_double(change_of_time(perturbed, exact.obstacle) / Real(unit),
                       std::numeric_limits<double>::max());
    });
  }
};

Margins::Margins(const Scene& scene, NumberFormat precision)
    : impl_(std::make_unique<const Impl>(Impl{PerturbedScene(scene, precision)})) {}
Margins::Margins(Margins&&) noexcept = default;
Margins& Margins::operator=(Margins&&) noexcept = default;
Margins::~Margins() = default;

std::optional<HardestDecision> Margins::hardest_decision(const Query& query, const Answer& exact,
                                                         long budget) const {
  const bool is_never = exact.outcome == Outcome::never;
  if (!is_never && exact.outcome != Outcome::hit && exact.outcome != Outcome::inside) return std::nullopt;
  using Decision = std::optional<HardestDecision>;
  return impl_->scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) -> Decision {
    if (is_never && !is_open_everywhere(perturbed.scene())) return std::nullopt;
    return MarginSearch<D>(perturbed, exact, budget).run();
  });
}

std::vector<PassedObstacle> Margins::passed(const Query& query, const Answer& exact, std::size_t most) const {
  return impl_->scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
    return passed_obstacles<D>(perturbed, exact, most);
  });
}

Approach Margins::approach(const Query& query, const ObstacleId& obstacle) const {
  return impl_->scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
    const Uncertain<D>& atom = perturbed.atom_of(obstacle);
    const Centre<D> centre = perturbed.centre_of(obstacle);
    const auto gap = [](const Z& distance2, const Z& radius2) {
      return to_double(sqrt(real(distance2)) / sqrt(real(radius2)) - 1, kHuge);
    };
    return Approach{gap(centre.h2, atom.rho2()), gap(centre.c2, atom.view().radius2), centre.s > 0};
  });
}

Crossing Margins::crossing(const Query& query, const ObstacleId& obstacle) const {
  return impl_->scene.with(query, [&]<std::size_t D>(const PerturbedQuery<D>& perturbed) {
    const Uncertain<D>& atom = perturbed.atom_of(obstacle);
    const Centre<D> centre = perturbed.centre_of(obstacle);
    const Z discriminant = atom.rho2() - centre.h2;
    const ExactQuery<D>& exact = perturbed.query();
    Crossing its{sgn(discriminant), "", {}};
    if (its.discriminant > 0)
      its.time_decimal =
          round_to_decimal({centre.s, -1, discriminant, atom.view().velocity.v2, exact.time_exponent()}, 17);
    const ZVec<D> place = centre_of<D>(perturbed.scene(), obstacle.lattice, obstacle.atom,
                                       to_zvec<D>(obstacle.cell), ZVec<D>{}, exact.length_exponent);
    for (std::size_t i = 0; i < D; ++i) {
      its.centre[i] = hexadecimal(place[i], exact.length_exponent);
      its.is_centre_binary64 &= is_binary64(place[i], exact.length_exponent);
    }
    return its;
  });
}

double Margins::condition(const Query& query, const Answer& exact) const {
  return impl_->change(query, exact, ulp(exact.time.value_or(0), impl_->scene.precision()));
}

double Margins::time_change(const Query& query, const Answer& exact) const {
  return impl_->change(query, exact, 1);
}

}  // namespace lorentz::oracle
