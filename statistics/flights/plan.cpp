// The plan of a run: which flights to fly.
#include <algorithm>
#include <cmath>

#include "src/exchange/exchange_write.hpp"
#include "src/problem/scene_geometry.hpp"
#include "statistics/flights/account.hpp"

namespace lorentz::flights {

std::uint64_t FlightsPlan::blocks() const {
  return count / kBlock + (count % kBlock != 0);
}

std::vector<std::pair<std::string, std::string>> FlightsPlan::words() const {
  return {{"engine", engine},
          {"starts", name_of(from)},
          {"seed", std::to_string(seed)},
          {"count", std::to_string(count)},
          {"cells", std::to_string(cells)},
          {"scene", scene_line(scene)}};
}

int unit_exponent(const Scene& scene) {
  const std::optional<Filling> filling = filling_of(scene);
  if (!filling || !(filling->surface > 0)) return 0;
  return std::clamp(std::ilogb((scene.dimension == 2 ? 3.14 : 4) / filling->surface), -900, 900);
}

}  // namespace lorentz::flights
