// The properties of the families of cases: outcomes, cost of making a case, longest flight, duplicates; and how many
// of them `reduction` leaves undecided or does not support.
//
// family_table [COUNT [FAMILY]]
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>

#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>
#include "fuzz/families/family.hpp"

using namespace lorentz;

namespace {

struct Counts {
  std::size_t hit = 0, never = 0, inside = 0, error = 0, duplicates = 0, undecided = 0, unsupported = 0;
  double longest = 0;
};

// Lengths are the time times |v|; cells have a size of about 1.
void count(const cases::Case& one, const Answer& answer, Counts& counts) {
  counts.hit += answer.outcome == Outcome::hit;
  counts.never += answer.outcome == Outcome::never;
  counts.inside += answer.outcome == Outcome::inside;
  counts.error += answer.outcome == Outcome::error;
  const Vec& v = one.query.v;
  if (answer.outcome == Outcome::hit && std::isfinite(*answer.time))
    counts.longest = std::max(counts.longest, *answer.time * std::hypot(v[0], v[1], v[2]));
}

void ask_reduction(const cases::Case& one, Counts& counts) {
  if (Reduction::beyond(one.scene))
    ++counts.unsupported;
  else
    counts.undecided += Reduction(one.scene).fly(one.query).outcome == Outcome::undecided;
}

void row(const cases::Family& family, std::uint64_t number) {
  Counts counts;
  std::set<std::tuple<double, Vec, Vec, bool>> seen;
  double making = 0, asking = 0;
  for (std::uint64_t index = 0; index < number; ++index) {
    const auto start = std::chrono::steady_clock::now();
    const cases::Case one = family.make(20161115, index);
    const auto made = std::chrono::steady_clock::now();
    const Answer answer = oracle::Oracle(one.scene).first_hit(one.query);
    const auto asked = std::chrono::steady_clock::now();
    making += std::chrono::duration<double, std::micro>(made - start).count();
    asking += std::chrono::duration<double, std::micro>(asked - made).count();
    count(one, answer, counts);
    ask_reduction(one, counts);
    const Atom& atom = one.scene.lattices[0].atoms[0];
    counts.duplicates += !seen.insert({atom.is_ball() ? atom.radius : atom.semiaxes[0][0], one.query.x,
                                       one.query.v, one.query.from.has_value()})
                              .second;
  }
  const double n = static_cast<double>(number);
  fmt::print("{:<18} {:5.1f} {:6.1f} {:7.1f} {:6} {:10} {:9} {:11} {:12.1f} {:10.1f} {:14.2g}\n",
             family.name(), 100 * static_cast<double>(counts.hit) / n,
             100 * static_cast<double>(counts.never) / n, 100 * static_cast<double>(counts.inside) / n,
             counts.error, counts.duplicates, counts.undecided, counts.unsupported, making / n, asking / n,
             counts.longest);
}

}  // namespace

int main(int count, char** arguments) {
  const std::uint64_t number = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 4000;
  fmt::print(
      "family             hit % never % inside % errors duplicates undecided unsupported us to make us to "
      "answer "
      "longest flight\n");
  for (const cases::Target& target : cases::targets())
    for (const cases::Family& family : target.families())
      if (count < 3 || family.name() == arguments[2]) row(family, number);
}
