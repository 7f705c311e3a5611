#include "question/truth.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "question/engines.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::question {

Truth truth_named(const std::string& name, const std::vector<EngineInfo>& judged) {
  if (index_of_name(name, {"oracle", "certified"}, "--judge") == 0) return Truth::oracle;
  for (const EngineInfo& engine : judged)
    if (engine.traits.uses_reduction)
      throw InputError(fmt::format(
          "--judge: certified rests on reduction, and cannot judge the engine {}; use oracle", engine.name));
  return Truth::certified;
}

}  // namespace lorentz::question
