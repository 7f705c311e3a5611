// How often the published 3D algorithm predicts a false collision: its three planes agree on a sphere (the
// line meets three cylinders around it), but the line misses the sphere. One line of CSV per radius. A flight
// may meet many such spheres, so flights are counted, too.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include <lorentz/oracle.hpp>
#include "question/starts/free_starts.hpp"
#include "src/engines/published/published.hpp"

using namespace lorentz;

int main(int argc, char** argv) {
  const std::size_t flights = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100'000;
  fmt::print("radius,flights,predicted,false,false_in_flights,most_in_a_flight\n");
  for (const double r : {0.3, 0.1, 0.03, 0.01, 0.003}) {
    const Scene scene = unit_scene(3, r);
    const Published published(scene);
    long long made = 0, wrong = 0, with_wrong = 0, most = 0;
    for (const Query& query :
         starts::free_starts(scene, starts::Kind::uniform, starts::kDefaultSeed, flights)) {
      Proposals proposals;
      published.first_hit_counted(query, HUGE_VAL, proposals);
      made += proposals.made, wrong += proposals.false_tricylinder;
      with_wrong += proposals.false_tricylinder > 0;
      most = std::max(most, proposals.false_tricylinder);
    }
    fmt::print("{},{},{},{},{},{}\n", r, flights, made, wrong, with_wrong, most);
    std::fflush(stdout);
  }
}
