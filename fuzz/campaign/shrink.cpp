// Coarse steps come first, because each may save hundreds of fine ones: all numbers rounded at once, the unit
// lattice in place of the scene, the velocity as small integers. A step that fails costs one try; no case is
// tried twice.
#include "fuzz/campaign/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <unordered_set>
#include <vector>

#include <lorentz/exchange.hpp>
#include <lorentz/geometry.hpp>
#include "fuzz/families/family.hpp"

namespace lorentz::fuzz {

namespace {

// ---- numbers

/// Calls f for each number of the case that has a meaning.
template <class TheScene, class TheQuery, class F>
void for_each_number(TheScene& scene, TheQuery& query, const F& f) {
  const int dimension = scene.dimension;
  const auto each = [&](auto& a) {
    for (int i = 0; i < dimension; ++i) f(a[i]);
  };
  each(query.v);
  each(query.x);
  for (auto& lattice : scene.lattices) {
    for (auto& atom : lattice.atoms) {
      if (atom.is_ball()) f(atom.radius);
      each(atom.position);
      for (auto& axis : atom.semiaxes) each(axis);
    }
    for (int i = 0; i < dimension; ++i) each(lattice.vectors[i]);
  }
}

int exponent_of_lowest_bit(double x) {
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::fabs(std::frexp(x, &exponent)), 53));
  return exponent - 53 + std::countr_zero(mantissa);
}

using Rounding = double (*)(double);
constexpr Rounding kNearest = [](double x) { return std::nearbyint(x); },
                   kDown = [](double x) { return std::floor(x); },
                   kUp = [](double x) { return std::ceil(x); };

/// Rounds x to this number of significant bits.
double rounded_to(double x, int bits, Rounding to_whole) {
  if (x == 0 || !std::isfinite(x)) return x;
  const int lowest = std::ilogb(x) - bits + 1;
  const double result = std::ldexp(to_whole(std::ldexp(x, -lowest)), lowest);
  return std::isfinite(result) ? result : x;
}

double largest_of(const Vec& a) {
  return std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
}

/// Rounds x to a multiple of 2^-places.
double on_grid(double x, int places) {
  return std::fabs(x) < 0x1p40 ? std::ldexp(std::nearbyint(std::ldexp(x, places)), -places) : x;
}

long complexity_of(double x) {
  if (x == 0) return 0;
  const long exponent = std::ilogb(x);
  return 10L * bits_of(x) + 2 * std::labs(exponent) + (x < 0 ? 1 : 0);
}

// ---- the search

class Shrinker {
 public:
  Shrinker(Shrunk start, const StillFails& still_fails, const FlightLength& length,
           const ShrinkBudget& budget)
      : best_(std::move(start)),
        still_fails_(still_fails),
        length_(length),
        budget_(budget),
        tries_left_(budget.tries) {
    score_ = complexity(best_.scene, best_.query);
    seen_.insert(hash_of(best_));
  }

  Shrunk run() {
    for (long before = -1; before != score_ && !is_spent();) {
      before = score_;
      round_everything();
      simplify_scene();
      simplify_query();
      simplify_velocity();
      simplify_numbers();
      if (before == score_) shorten();
    }
    best_.tries = tries_;
    return best_;
  }

 private:
  // ---- steps on the whole

  void round_everything() {
    for (const int bits : {2, 3, 4, 6, 8, 10, 12, 16, 24, 32}) {
      const auto round = [bits](double& x) { x = rounded_to(x, bits, kNearest); };
      const auto whole = [&](Shrunk& one) { for_each_number(one.scene, one.query, round); };
      const auto query_alone = [&](Shrunk& one) {
        for (Vec* a : {&one.query.x, &one.query.v}) std::for_each(a->begin(), a->end(), round);
      };
      const auto start_on_grid = [&](Shrunk& one) {
        for (double& x : one.query.x) x = on_grid(x, bits);
        std::for_each(one.query.v.begin(), one.query.v.end(), round);
      };
      if (offer(whole) || offer(query_alone) || offer(start_on_grid)) return;
    }
  }

  void simplify_scene() {
    to_unit_lattice();
    for (std::size_t l = best_.scene.lattices.size(); l-- > 0;) drop_lattice(l);
    for (std::size_t l = 0; l < best_.scene.lattices.size(); ++l) {
      for (std::size_t a = best_.scene.lattices[l].atoms.size(); a-- > 0;) drop_atom(l, a);
      offer([&](Shrunk& one) { set_unit_vectors(one.scene, l); });
      for (std::size_t a = 0; a < best_.scene.lattices[l].atoms.size(); ++a) {
        to_ball(l, a);
        offer([&](Shrunk& one) { one.scene.lattices[l].atoms[a].position = {}; });
      }
    }
  }

  // Sets as many unit vectors as the lattice has vectors.
  static void set_unit_vectors(Scene& scene, std::size_t l) {
    Lattice& lattice = scene.lattices[l];
    for (int i = 0; i < lattice.rank_in(scene.dimension); ++i) {
      lattice.vectors[i] = {};
      lattice.vectors[i][i] = 1;
    }
  }

  // Tries the unit lattice with one ball, the query as it is, or in the coordinates of the cell.
  void to_unit_lattice() {
    if (is_unit_scene(best_.scene)) return;
    const int dimension = best_.scene.dimension;
    for (std::size_t l = 0; l < best_.scene.lattices.size(); ++l) {
      const Lattice lattice = best_.scene.lattices[l];
      const double size = length(lattice.vectors[0]);
      for (const Atom& atom : lattice.atoms) {
        const double radius = atom.is_ball() ? atom.radius : length(atom.semiaxes[0]);
        const auto keep_from = [](Query& query) {
          if (query.from) query.from.emplace(ObstacleId{0, 0, query.from->cell});
        };
        offer([&](Shrunk& one) {
          one.scene = Scene{dimension, {lattice}};
          one.scene.lattices[0].atoms = {Atom{{}, radius, {}}};
          set_unit_vectors(one.scene, 0);
          keep_from(one.query);
        });
        if (lattice.rank < dimension) continue;
        offer([&](Shrunk& one) {
          const auto dual = dual_of(lattice.vectors, dimension);
          one.scene = unit_scene(dimension, radius / size);
          Vec x = one.query.x;
          for (int i = 0; i < 3; ++i) x[i] -= atom.position[i];
          one.query.x = coordinates(dual, x);
          one.query.v = coordinates(dual, one.query.v);
          if (dimension == 2) one.query.x[2] = one.query.v[2] = 0;
          keep_from(one.query);
        });
      }
    }
  }

  void drop_lattice(std::size_t l) {
    if (best_.scene.lattices.size() < 2) return;
    offer([&](Shrunk& one) {
      auto& from = one.query.from;
      const bool is_there = drop(one.scene.lattices, l, from ? &from->lattice : nullptr);
      if (!is_there) from.reset();
    });
  }

  void drop_atom(std::size_t l, std::size_t a) {
    if (best_.scene.lattices[l].atoms.size() < 2) return;
    offer([&](Shrunk& one) {
      auto& from = one.query.from;
      const bool is_here = from && from->lattice == static_cast<int>(l);
      if (!drop(one.scene.lattices[l].atoms, a, is_here ? &from->atom : nullptr)) from.reset();
    });
  }

  // Erases an item, and renumbers another one; false if that is the one erased.
  template <class Item>
  static bool drop(std::vector<Item>& items, std::size_t erased, int* other) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(erased));
    if (other && *other == static_cast<int>(erased)) return false;
    if (other && *other > static_cast<int>(erased)) --*other;
    return true;
  }

  void to_ball(std::size_t l, std::size_t a) {
    const auto axes = best_.scene.lattices[l].atoms[a].semiaxes;
    for (const Vec& axis : axes)
      if (offer([&](Shrunk& one) {
            Atom& atom = one.scene.lattices[l].atoms[a];
            atom.semiaxes.clear();
            atom.radius = length(axis);
          }))
        return;
  }

  // ---- the query

  void simplify_query() {
    if (best_.query.from) {
      offer([](Shrunk& one) { one.query.from.reset(); });
    }
    go_home();
    // Unit lattices are symmetric under a reflection; it is offered if it leaves fewer numbers below 0.
    for (int i = 0; i < best_.scene.dimension; ++i) reflect(i);
  }

  void reflect(int i) {
    offer([&](Shrunk& one) {
      one.query.x[i] = 0 - one.query.x[i];
      one.query.v[i] = 0 - one.query.v[i];
      if (one.query.from && one.query.from->cell[i].fits_int64())
        one.query.from->cell[i] = 0 - one.query.from->cell[i].int64();
    });
  }

  // Moves the query to a cell near the origin, and `from` with it. (With several lattices the first one
  // counts, and the failure may be lost.)
  void go_home() {
    const Scene& scene = best_.scene;
    if (scene.lattices[0].rank < scene.dimension) return;
    const auto& vectors = scene.lattices[0].vectors;
    const Vec place = coordinates(dual_of(vectors, scene.dimension), best_.query.x);
    const auto& from = best_.query.from;
    for (const bool by_from : {true, false}) {
      if (by_from && !from) continue;
      std::array<std::int64_t, 3> n{};
      bool possible = true;
      for (int i = 0; i < scene.dimension; ++i) {
        possible &= std::fabs(place[i]) < 0x1p50 && (!from || from->cell[i].fits_int64());
        if (possible)
          n[i] = by_from ? from->cell[i].int64() : static_cast<std::int64_t>(std::floor(place[i]));
      }
      if (possible) offer([&](Shrunk& one) { go_back_by(n, one); });
    }
  }

  static void go_back_by(const std::array<std::int64_t, 3>& n, Shrunk& one) {
    const auto& vectors = one.scene.lattices[0].vectors;
    for (int i = 0; i < one.scene.dimension; ++i) {
      one.query.x = sum(one.query.x, scaled(vectors[i], -static_cast<double>(n[i])));
      if (one.query.from) one.query.from->cell[i] = one.query.from->cell[i].int64() - n[i];
    }
  }

  // Tries a velocity of small integers, the smallest first; or at least one of a length of about 1.
  void simplify_velocity() {
    const Vec& v = best_.query.v;
    const double largest = largest_of(v);
    if (!(largest > 0)) return;
    const Vec unit = scaled(scaled(v, std::ldexp(1, -std::ilogb(largest) / 2)),
                            std::ldexp(1, -std::ilogb(largest) + std::ilogb(largest) / 2));
    for (int size = 1; size <= 64; ++size)
      if (offer([&](Shrunk& one) {
            for (int i = 0; i < 3; ++i)
              one.query.v[i] = 0 + std::nearbyint(unit[i] / largest_of(unit) * size);
          }))
        return;
    offer([&](Shrunk& one) { one.query.v = unit; });
  }

  // ---- one number at a time

  void simplify_numbers() {
    for (std::size_t index = 0, count = numbers_of(best_).size(); index < count; ++index)
      simplify_number(index);
  }

  void simplify_number(std::size_t index) {
    const double x = *numbers_of(best_)[index];  // 0 stays: nothing is simpler
    const auto set = [&](double y) {
      return y != x && offer([&](Shrunk& one) { *numbers_of(one)[index] = y; });
    };
    if (set(0) || set(x < 0 ? -1 : 1) || set(std::fabs(x))) return;
    for (int bits = 1; bits < bits_of(x); bits += bits < 12 ? 1 : 6)
      for (const Rounding way : {kNearest, kDown, kUp})
        if (set(rounded_to(x, bits, way))) return;
    if (std::fabs(x) > 1 && set(x / 2)) return;
    if (std::fabs(x) < 0.5) set(2 * x);
  }

  static std::vector<double*> numbers_of(Shrunk& one) {
    std::vector<double*> numbers;
    for_each_number(one.scene, one.query, [&](double& x) { numbers.push_back(&x); });
    return numbers;
  }

  // ---- the flight

  // Starts later on the flight, by a quarter of it at least, on a grid that keeps the start simple.
  void shorten() {
    if (!length_ || flight_ < 0) return;
    const Query query = best_.query;
    const double speed = length(query.v);
    for (const double share : {0.875, 0.75, 0.5, 0.25})
      for (const int places : {1, 2, 4, 8}) {
        const double time = share * flight_ / speed;
        const auto later = [&](Shrunk& one) {
          one.query.from.reset();
          for (int i = 0; i < 3; ++i) one.query.x[i] = on_grid(query.x[i] + time * query.v[i], places);
        };
        if (offer(later, 0.75 * flight_)) return;
      }
  }

  // ---- trying

  /// Keeps what `change` makes of the best case if that is simpler and still fails. With `shorter_than` it
  /// need not be simpler, but the flight must be shorter.
  template <class Change>
  bool offer(const Change& change, double shorter_than = -1) {
    if (is_spent()) return false;
    Shrunk one = best_;
    change(one);
    for_each_number(one.scene, one.query, [](double& x) { x = x + 0.0; });  // no -0
    const long score = complexity(one.scene, one.query);
    if (shorter_than >= 0 ? score > score_ : score >= score_) return false;
    if (!seen_.insert(hash_of(one)).second) return false;
    tries_left_ -= price(one.scene, one.query);
    ++tries_;
    if (!still_fails_(one.scene, one.query)) return false;
    const double flight = length_ ? length_() : -1;
    if (shorter_than >= 0 && !(flight < shorter_than)) return false;
    best_ = std::move(one);
    score_ = score;
    flight_ = flight;
    return true;
  }

  bool is_spent() const { return tries_left_ <= 0 || (budget_.is_up && budget_.is_up()); }

  static std::size_t hash_of(const Shrunk& one) {
    std::string text;
    append_scene_line(text, one.scene);
    append_query_line(text, "0", one.query, one.scene);
    return std::hash<std::string>()(text);
  }

  Shrunk best_;
  const StillFails& still_fails_;
  const FlightLength& length_;
  const ShrinkBudget& budget_;
  double tries_left_;
  int tries_ = 0;
  long score_ = 0;
  double flight_ = -1;  // of the best case; not known for the given one
  std::unordered_set<std::size_t> seen_;
};

}  // namespace

int bits_of(double x) {
  if (x == 0 || !std::isfinite(x)) return 0;
  return std::ilogb(x) - exponent_of_lowest_bit(x) + 1;
}

int most_bits(const Scene& scene, const Query& query) {
  int most = 0;
  for_each_number(scene, query, [&](const double& x) { most = std::max(most, bits_of(x)); });
  return most;
}

double price(const Scene& scene, const Query& query) {
  int highest = std::numeric_limits<int>::min(), lowest = std::numeric_limits<int>::max();
  for_each_number(scene, query, [&](const double& x) {
    if (x == 0 || !std::isfinite(x)) return;
    highest = std::max(highest, std::ilogb(x));
    lowest = std::min(lowest, exponent_of_lowest_bit(x));
  });
  const double share = highest < lowest ? 0 : static_cast<double>(highest - lowest + 1) / kOrdinarySpread;
  return std::max(1.0, share * share);
}

bool is_sane(const Scene& scene) {
  constexpr double kLargestRadius = 100;
  for (const Lattice& lattice : scene.lattices) {
    if (lattice.rank == 0) continue;
    double shortest = length(lattice.vectors[0]), largest = 0;
    for (int i = 1; i < lattice.rank_in(scene.dimension); ++i)
      shortest = std::min(shortest, length(lattice.vectors[i]));
    for (const Atom& atom : lattice.atoms) {
      largest = std::max(largest, atom.radius);
      for (const Vec& axis : atom.semiaxes) largest = std::max(largest, length(axis));
    }
    if (!(largest <= kLargestRadius * shortest)) return false;
  }
  return true;
}

long complexity(const Scene& scene, const Query& query) {
  long sum = query.from ? 60 : 0;
  for (const Lattice& lattice : scene.lattices) {
    sum += 2000;
    for (const Atom& atom : lattice.atoms) sum += atom.is_ball() ? 1000 : 1500;
  }
  if (query.from)
    for (const Integer& n : query.from->cell)
      sum += n.fits_int64() ? complexity_of(static_cast<double>(n.int64())) : 1000;
  for_each_number(scene, query, [&](const double& x) { sum += complexity_of(x); });
  return sum;
}

StillFails in_places(
    const std::function<std::shared_ptr<question::Place>(const Scene&)>& place_of,
    const std::function<bool(const std::shared_ptr<question::Place>&, const Query&)>& still_fails) {
  return [=, place = std::shared_ptr<question::Place>()](const Scene& scene, const Query& query) mutable {
    if (!place || place->scene() != scene) {
      if (!cases::is_sound(scene) || !is_sane(scene)) return false;
      place = place_of(scene);
    }
    return !flaw_of(query, scene) && place->takes(query) && still_fails(place, query);
  };
}

Shrunk shrink(const Scene& scene, const Query& query, const StillFails& still_fails,
              const FlightLength& length, const ShrinkBudget& budget) {
  return Shrinker({scene, query}, still_fails, length, budget).run();
}

}  // namespace lorentz::fuzz
