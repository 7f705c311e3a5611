#include "cli/claim_options.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "cli/numbers.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {

NumberFormat number_format_named(const std::string& precision) {
  constexpr NumberFormat kFormats[] = {NumberFormat::binary64, NumberFormat::binary32};
  return kFormats[index_of_name(precision, {"binary64", "binary32"}, "--precision")];
}

namespace {

// "1e-3..1e3"; either end may be left out.
Domain::Range range_from(const std::string& text, const std::string& name) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) throw InputError(name + ": needs an interval, like 1e-3..1e3");
  const auto end_or = [&](const std::string& end, double otherwise) {
    return end.empty() ? otherwise : number_from_zero(end, name.c_str());
  };
  const Domain::Range range{end_or(text.substr(0, dots), 0),
                            end_or(text.substr(dots + 2), std::numeric_limits<double>::infinity())};
  if (range.low > range.high) throw InputError(name + ": the interval's ends are in the wrong order");
  return range;
}

void take_part(const std::string& part, Domain& domain, std::set<std::string>& said) {
  const std::size_t equals = part.find('=');
  const std::string key = part.substr(0, equals), value = equals == part.npos ? "" : part.substr(equals + 1);
  const std::string name = "--domain: " + key;
  std::vector<std::string> names;
  for (const NamedRange& its : kDomainRanges) names.emplace_back(its.name);
  const std::size_t ranges = names.size();
  names.insert(names.end(), {"dimension", "shape", "limits"});
  const std::size_t number = index_of_name(key, names, "--domain");
  if (!said.insert(key).second) throw InputError(name + ": comes twice");
  const auto choice = [&](const std::vector<std::string>& two) {
    return index_of_name(value, two, name) == 0;
  };
  if (number < ranges)
    domain.*kDomainRanges[number].range = range_from(value, name);
  else if (key == "dimension")
    domain.dimension_2 = choice({"2", "3"}), domain.dimension_3 = !domain.dimension_2;
  else if (key == "shape")
    domain.balls = choice({"ball", "ellipsoid"}), domain.ellipsoids = !domain.balls;
  else
    domain.limits = choice({"yes", "no"});
}

Domain domain_from(const std::string& text) {
  Domain domain;
  std::set<std::string> said;
  for (const std::string& part : items_of(text, "--domain")) take_part(part, domain, said);
  return domain;
}

StartInside rule_from(const std::string& name) {
  return static_cast<StartInside>(
      index_of_name(name, {"inside", "miss", "zero", "exit", "unsupported"}, "--starts-inside"));
}

template <class T>
void set_once(std::optional<T>& said, const T& value, const char* option) {
  if (said && !(*said == value))
    throw InputError(std::string(option) + ": the engines claim different ones; give it, or name one engine");
  said = value;
}

}  // namespace

std::vector<std::optional<question::Introduction>> ClaimOptions::ask(
    const std::vector<question::EngineInfo>& engines, bool strict) {
  std::vector<std::optional<question::Introduction>> all;
  claim();  // reports errors of the options first
  for (const question::EngineInfo& engine : engines) {
    const auto& said = all.emplace_back(engine.introduce ? engine.introduce() : std::nullopt);
    if (!said) continue;
    KeyCheck keys(engine.name, strict);
    for (const std::string& key : said->unknown) keys("engine." + key);
    if (said->precision && (!said_precision_ || bits_of(*said->precision) < bits_of(*said_precision_)))
      said_precision_ = said->precision;
    if (said->time_tolerance) said_tolerance_ = std::max(*said->time_tolerance, said_tolerance_.value_or(0));
    if (said->domain && !domain) set_once(said_domain_, *said->domain, "--domain");
    if (said->inside && !starts_inside) set_once(said_inside_, *said->inside, "--starts-inside");
  }
  return all;
}

Claim ClaimOptions::claim(NumberFormat otherwise) const {
  Claim claim{precision ? number_format_named(*precision) : said_precision_.value_or(otherwise),
              said_tolerance_, said_inside_.value_or(StartInside::inside), said_domain_.value_or(Domain())};
  if (domain) claim.domain = domain_from(*domain);
  if (starts_inside) claim.inside = rule_from(*starts_inside);
  if (!time_tolerance) return claim;
  constexpr double kNotJudged = std::numeric_limits<double>::infinity();
  claim.time_tolerance = *time_tolerance == "inf" || *time_tolerance == "Inf"
                             ? kNotJudged
                             : number_from_zero(*time_tolerance, "--time-tolerance");
  return claim;
}

Option ClaimOptions::precision_row(const std::string& otherwise) {
  return {
      "--precision", &precision, "binary64|binary32",
      "format of the engine's numbers: questions consist of such numbers, and ulps are theirs (default: what "
      "a cmd: or lib: engine claims, " +
          otherwise + ")"};
}

Option ClaimOptions::time_tolerance_row() {
  return {"--time-tolerance", &time_tolerance, "T",
          "a time is right if it is off by at most T times itself, not by ulps; inf: times are not judged "
          "(default: what a cmd: or lib: engine claims)"};
}

Option ClaimOptions::domain_row() {
  return {
      "--domain", &domain, "PART=VALUE",
      "the questions that the engine is made for, with commas between parts: speed=A..B, coordinates=A..B, "
      "radius=A..B, flight=A..B, dimension=2|3, shape=ball|ellipsoid, limits=yes|no (default: what a cmd: or "
      "lib: engine claims, else all)"};
}

Option ClaimOptions::starts_inside_row() {
  return {"--starts-inside", &starts_inside, "inside|miss|zero|exit|unsupported",
          "what the engine answers if x lies in an obstacle: that (inside); as if it were not there (miss); "
          "a hit at "
          "time 0 (zero), or when the line leaves it (exit); unsupported: it is not asked (default: what a "
          "cmd: or "
          "lib: engine claims, else inside)"};
}

}  // namespace lorentz::cli
