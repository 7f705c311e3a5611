#include "chaos/free_starts.hpp"

#include <lorentz/errors.hpp>

namespace lorentz::chaos {

using flights::Starts;

void add_free_starts(const Starts& starts, const Reduction& engine, std::uint64_t first, std::uint64_t last,
                     Particles& particles) {
  Query start;
  for (std::uint64_t index = first; index < last; ++index) {
    std::uint64_t attempt = 0;
    do {
      if (attempt == Starts::kMostAttempts) throw InputError(flights::nowhere_to_start(attempt));
      starts.draw(index, attempt++, start);
    } while (engine.fly(start).outcome == Outcome::inside);
    particles.add(start);
  }
}

}  // namespace lorentz::chaos
