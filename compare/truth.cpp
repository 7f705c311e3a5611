#include "compare/truth.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "compare/registry.hpp"

namespace lorentz::compare {

Truth truth_named(const std::string& name, const std::vector<std::string>& judged) {
  if (name == "oracle") return Truth::oracle;
  if (name != "certified")
    throw InputError(fmt::format("--judge: {} is none; there are oracle and certified", json_quoted(name)));
  for (const std::string& engine : judged)
    if (traits_of(engine).uses_reduction)
      throw InputError(fmt::format(
          "--judge: certified rests on reduction, and is no judge of the engine {}; use oracle", engine));
  return Truth::certified;
}

}  // namespace lorentz::compare
