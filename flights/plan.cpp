#include "flights/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <lorentz/exchange.hpp>
#include "flights/account.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::flights {

std::uint64_t Plan::blocks() const {
  return count / kBlock + (count % kBlock != 0);
}

std::string Plan::text() const {
  std::string line;
  append_scene_line(line, scene);
  while (line.ends_with('\n')) line.pop_back();
  return fmt::format("{{\"engine\":{},\"from\":\"{}\",\"seed\":{},\"count\":{},\"cells\":{},\"of\":{}}}",
                     json_quoted(engine), from == Ensemble::uniform ? "uniform" : "surface", seed, count,
                     cells, line);
}

int unit_exponent(const Scene& scene) {
  const std::optional<Filling> filling = filling_of(scene);
  if (!filling || !(filling->surface > 0)) return 0;
  return std::clamp(std::ilogb((scene.dimension == 2 ? 3.14 : 4) / filling->surface), -900, 900);
}

bool flies_in_columns(const std::string& engine) {
  return engine == "batch" || engine == "reduction" || engine == "certified-batch" || engine == "certified";
}

}  // namespace lorentz::flights
