#include "oracle/horizon/slabs.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/exact/quadratic.hpp"
#include "oracle/exact/root_sums.hpp"
#include "oracle/exact/shape.hpp"
#include "oracle/horizon/channel_scene.hpp"

namespace lorentz::oracle {
namespace {

constexpr std::size_t kMostCandidates = 2'000'000;  // normals: pairs of points
constexpr std::size_t kMostSlabWork = 20'000'000;   // blocks
constexpr double kMostCopies = 1e5;                 // blocks in a common period
constexpr std::size_t kMostCounted = 64;            // lattices: those that leave the fewest normals
constexpr std::size_t kMostPairs = 2000;            // of lattices, whose normals in common are looked for
constexpr std::size_t kPairWork = 10;               // for the periods of two lattices, in blocks

// A ball of reciprocal lattice points that holds the normal of every slab.
template <std::size_t D>
struct SlabCandidates {
  const ObstacleLattice<D>* lattice;
  Basis<D> basis;
  Z bound2;
  double expected;         ///< log2 of the number of points, estimated by volume, up to a constant
  std::size_t points = 0;  ///< in the ball; counting stops once there are more than allowed
};

template <std::size_t D>
SlabCandidates<D> make_candidates(const ObstacleLattice<D>& lattice, const ZMatrix<D>& axes,
                                  const Z& bound2) {
  SlabCandidates<D> result{&lattice, basis_of(lattice.cofactors), bound2, 0};
  for (auto& b : result.basis) b.p = axes * b.p;
  result.expected = log2_of(bound2) * D / 2 - log2_of(determinant<D>(result.basis));
  return result;
}

// The planes of a lattice are 1/|k| apart for a reciprocal vector k, and an obstacle leaves
// 1/|k| - 2 |A^T k| / |k| between them. For a slab of width W this must be at least W (above 0, if W is 0):
// 2 |A^T k| + W |k| <= 1. So k is in a ball of the image of the reciprocal lattice under 2 r + W, 2 A^T, or
// W. Of all obstacles take the one with the fewest candidates.
template <std::size_t D>
SlabCandidates<D> fewest_candidates(const ChannelScene<D>& scene) {
  std::vector<SlabCandidates<D>> all;
  for (const ObstacleLattice<D>& lattice : scene.lattices) {
    const Obstacle<D>& largest = lattice.obstacles.front();
    const Z one2 = lattice.volume * lattice.volume;
    auto doubled = largest.axes;
    for (auto& axis : doubled) axis = 2 * axis;
    if (largest.ball) {
      const Z width = doubled[0][0] + scene.unit;
      all.push_back(
          make_candidates<D>(lattice, multiple_of_identity<D>(width), scene.unit > 0 ? Z(one2 + 1) : one2));
    } else {
      all.push_back(make_candidates<D>(lattice, doubled, one2));
      if (scene.unit > 0)  // W |k| < 1, because the obstacle takes some of the width
        all.push_back(make_candidates<D>(lattice, multiple_of_identity<D>(scene.unit), one2));
    }
  }
  // The points are counted, because the volume alone misleads: in a slender cell the ball holds a few planes
  // full of points.
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.expected < b.expected; });
  if (all.size() > kMostCounted) all.resize(kMostCounted);
  const SlabCandidates<D>* fewest = nullptr;
  for (SlabCandidates<D>& one : all) {
    one.points = points_in_ball<D>(one.basis, one.bound2, fewest ? fewest->points : 2 * kMostCandidates);
    if (!fewest || one.points < fewest->points) fewest = &one;
  }
  return *fewest;
}

// The lattices whose planes are equally far apart, taken together; or a superposition of such classes.
struct Class {
  Z period;
  std::vector<Gap> gaps;
};

std::vector<Gap> common_gaps(const Class& a, const Class& b, const Z& period) {
  std::vector<Blocked> blocks = blocks_between(a.gaps, a.period, Z(period / a.period).get_ui());
  const std::vector<Blocked> more = blocks_between(b.gaps, b.period, Z(period / b.period).get_ui());
  blocks.insert(blocks.end(), more.begin(), more.end());
  return gaps_between(std::move(blocks), period);
}

// The number of blocks that common_gaps would look at.
double copies_in_common(const Class& a, const Class& b, const Z& period) {
  return std::exp2(std::min(1000.0, log2_of(period / a.period))) * static_cast<double>(a.gaps.size()) +
         std::exp2(std::min(1000.0, log2_of(period / b.period))) * static_cast<double>(b.gaps.size());
}

// The larger of two gaps' lower ends, and the smaller of their upper ends.
Gap common_part(const Gap& a, const Gap& b) {
  Gap part = a;
  if (compare_entries(-b.low, b.low2, -a.low, a.low2) < 0) part.low = b.low, part.low2 = b.low2;
  if (compare_entries(b.high, b.high2, a.high, a.high2) < 0) part.high = b.high, part.high2 = b.high2;
  return part;
}

// Relative to each other, the gaps a and b of two classes take every shift that is a multiple of step = gcd
// of the periods, once each in the common period. Finds the shifts for which they have a part in common, and
// the one for which this part is widest.
struct Meetings {
  Z first, last;  // k, both included; b is shifted by k step
  Z widest;
  Gap part;
};

Meetings meetings_of(const Gap& a, const Gap& b, const Z& step, const Z& least2) {
  const bool or_equal = least2 > 0;
  Meetings result;
  result.last = last_step(a.high - b.low, a.high2, b.low2, least2, step, or_equal);
  result.first = -last_step(b.high - a.low, b.high2, a.low2, least2, step, or_equal);
  if (result.first > result.last) return result;
  // The common part shrinks equally on both sides of the shift that centres b on a. (Clamped, because roots
  // are rounded.)
  const auto fine = [](const Z& a2) { return floor_sqrt(shifted_left(a2, 128)); };
  const Z apart = shifted_left(a.low + a.high - b.low - b.high, 64) + fine(a.low2) - fine(a.high2) -
                  fine(b.low2) + fine(b.high2);
  result.widest = std::clamp(round_div(apart, shifted_left(step, 65)), result.first, result.last);
  Gap shifted = b;
  shifted.shift(result.widest * step);
  result.part = common_part(a, shifted);
  return result;
}

template <std::size_t D>
struct SlabSearch {
  const ChannelScene<D>& scene;
  Slabs<D> result;
  std::size_t work = 0;

  // scene.unit as seen along this normal, squared.
  Z least2(const ZVec<D>& normal) const { return scene.unit * scene.unit * dot(normal, normal); }

  void add(const ZVec<D>& normal, const Gap& gap, const Z& count) {
    if (scene.unit > 0 && sign_of_rest(gap.width(), gap.low2, gap.high2, least2(normal)) < 0) return;
    result.open.push_back({normal, gap, count});
  }

  // Moves a gap to where binary64 is finest.
  static Gap near_origin(Gap gap, const Z& period) {
    const Z twice_middle = gap.low + gap.high + floor_sqrt(gap.low2) - floor_sqrt(gap.high2);
    gap.shift(-period * ceil_div(twice_middle - period, 2 * period));
    return gap;
  }

  // The gaps that one lattice leaves in a period.
  std::vector<Gap> gaps_of(const ObstacleLattice<D>& lattice, const ZVec<D>& normal, const Z& period) {
    // If there are many obstacles, the first few nearly always cover the circle already.
    std::vector<Blocked> blocks;
    for (std::size_t count = 8;; count *= 4) {
      count = std::min(count, lattice.obstacles.size());
      while (blocks.size() < count) blocks.push_back(lattice.obstacles[blocks.size()].block(normal));
      work += count;
      std::vector<Gap> gaps = gaps_between(blocks, period);
      if (gaps.empty() || count == lattice.obstacles.size()) return gaps;
    }
  }

  // One class for each period; empty if one of them leaves nothing free.
  std::vector<Class> classes_of(const ZVec<D>& normal) {
    std::vector<Class> classes;
    for (const ObstacleLattice<D>& lattice : scene.lattices) {
      const Z period = lattice.period(normal);
      std::vector<Gap> gaps = gaps_of(lattice, normal, period);
      if (gaps.empty()) return {};
      const auto same = std::find_if(classes.begin(), classes.end(),
                                     [&](const Class& other) { return other.period == period; });
      if (same == classes.end()) {
        classes.push_back({period, std::move(gaps)});
        continue;
      }
      same->gaps = common_gaps(*same, {period, std::move(gaps)}, period);
      if (same->gaps.empty()) return {};
    }
    return classes;
  }

  // Replaces pairs of classes by one class, as long as their common period is short. False if nothing is
  // free.
  bool merge(std::vector<Class>& classes) {
    for (std::size_t i = 0; i < classes.size(); ++i)
      for (std::size_t k = i + 1; k < classes.size();) {
        if ((work += kPairWork) > kMostSlabWork) return false;  // the whole search is then refused
        const Z period = lcm(classes[i].period, classes[k].period);
        const double copies = copies_in_common(classes[i], classes[k], period);
        if (copies > kMostCopies) {
          ++k;
          continue;
        }
        work += static_cast<std::size_t>(copies);
        classes[i] = {period, common_gaps(classes[i], classes[k], period)};
        if (classes[i].gaps.empty()) return false;
        classes.erase(classes.begin() + static_cast<std::ptrdiff_t>(k));
        k = i + 1;
      }
    return true;
  }

  // Adds all gaps that two classes have in common, one entry for each pair of a gap of a and a gap of b.
  void add_meetings(const ZVec<D>& normal, const Class& a, const Class& b) {
    const Z step = gcd(a.period, b.period), turns_a = a.period / step, turns_b = b.period / step;
    // The inverse of turns_a modulo turns_b.
    const Z root = bezout(turns_a, turns_b).x, inverse = root - turns_b * floor_div(root, turns_b);
    for (const Gap& here : a.gaps)
      for (const Gap& there : b.gaps) {
        ++work;
        Meetings found = meetings_of(here, there, step, least2(normal));
        if (found.first > found.last) continue;
        // Gap a + m period_a meets gap b + n period_b where n period_b - m period_a = k step.
        Z m = -found.widest * inverse;
        m -= turns_b * round_div(m, turns_b);
        found.part.shift(m * a.period);
        add(normal, found.part, found.last - found.first + 1);
      }
  }

  bool any_pair_closed(const std::vector<Class>& classes) {
    for (std::size_t i = 0; i < classes.size(); ++i)
      for (std::size_t k = i + 1; k < classes.size(); ++k)  // too much work: the whole search is then refused
        if (work > kMostSlabWork || !meet_anywhere(classes[i], classes[k])) return true;
    return false;
  }

  bool meet_anywhere(const Class& a, const Class& b) {
    const Z step = gcd(a.period, b.period);
    for (const Gap& here : a.gaps)
      for (const Gap& there : b.gaps) {
        ++work;
        const Meetings found = meetings_of(here, there, step, 0);
        if (found.first <= found.last) return true;
      }
    return false;
  }

  // Two lattices usually have only a few normals in common, however many each of them has. False if the first
  // kMostPairs pairs may have many.
  bool look_along_common() {
    std::size_t left = kMostPairs;
    if constexpr (D == 2)
      for (std::size_t i = 0; i < scene.lattices.size(); ++i)
        for (std::size_t k = i + 1; k < scene.lattices.size() && left > 0; ++k, --left)
          if (const auto normals = common_normals(scene.lattices[i], scene.lattices[k])) {
            for (const ZVec<2>& normal : *normals) look_along(normal);
            return true;
          }
    return false;
  }

  // Looks along the candidates one by one. False if there are too many.
  bool look_along_all(const SearchProgress& progress) {
    const SlabCandidates<D> candidates = fewest_candidates(scene);
    // The points are images of normals; their coefficients lead back to the normals.
    const auto look_at = [&](const LatticePoint<D>& point) {
      look_along(combination(point.n, candidates.lattice->cofactors));
    };
    const auto step = [&](std::size_t done, std::size_t total) {
      if (progress && done % 64 == 0) progress(D == 2 ? "directions" : "planes", done / 2, total / 2);
    };
    return visit_primitive<D>(candidates.basis, candidates.bound2, 2 * kMostCandidates, look_at, step);
  }

  void look_along(const ZVec<D>& any_normal) {
    if (work > kMostSlabWork) return;
    const ZVec<D> normal = primitive(any_normal);
    std::vector<Class> classes = classes_of(normal);
    if (classes.empty() || !merge(classes)) return;
    if (classes.size() == 1) {
      for (const Gap& gap : classes[0].gaps) add(normal, near_origin(gap, classes[0].period), 1);
    } else if (classes.size() == 2) {
      add_meetings(normal, classes[0], classes[1]);
    } else if (!any_pair_closed(classes)) {
      result.undecided.push_back(normal);
    }
  }
};

}  // namespace

template <std::size_t D>
Slabs<D> free_slabs(const ChannelScene<D>& scene, const SearchProgress& progress) {
  SlabSearch<D> search{scene, {}, 0};
  const bool complete =
      (search.look_along_common() || search.look_along_all(progress)) && search.work <= kMostSlabWork;
  if (!complete)
    search.result.refusal = D == 2 ? "too many directions could leave a corridor open"
                                   : "too many planes could leave a channel open";
  return search.result;
}

template Slabs<2> free_slabs(const ChannelScene<2>&, const SearchProgress&);
template Slabs<3> free_slabs(const ChannelScene<3>&, const SearchProgress&);

}  // namespace lorentz::oracle
