#include "report/files/unknown_keys.hpp"

#include "report/files/messages.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz {

constexpr std::size_t kMost = 20;

static void tell(const std::string& place, const std::string& what, std::size_t number, const char* things) {
  if (number <= kMost) say("warning: {}: {}, and is ignored", place, what);
  if (number == kMost + 1) say("warning: {}: more {} are not known, and are ignored", place, things);
}

void KeyCheck::operator()(const std::string& key) {
  static const std::vector<std::string> kKeys{
      "from",  "x",           "v",      "id",        "scene",          "dimension",  "lattices", "vectors",
      "atoms", "position",    "radius", "semiaxes",  "lattice",        "atom",       "cell",     "outcome",
      "time",  "message",     "reason", "precision", "time_tolerance", "dimensions", "domain",   "inside",
      "speed", "coordinates", "flight", "shapes",    "limits"};
  const std::string last = key.substr(key.rfind('.') + 1);  // npos + 1 is 0
  const std::string what = "the key " + json_quoted(key) + " is not known" + did_you_mean(last, kKeys);
  if (strict_) throw InputError(what);
  if (seen_.size() > kMost || !seen_.insert(key).second) return;
  tell(line > 0 ? fmt::format("{}:{}", name_, line) : name_, what, seen_.size(), "keys");
}

OnUnknownColumn unknown_columns(const std::vector<std::string>& known, bool strict) {
  return [known, strict, seen = std::size_t{0}](const std::string& place, const std::string& column) mutable {
    const std::string what =
        fmt::format("the column {} is not known{}", json_quoted(column), did_you_mean(column, known));
    if (strict) throw InputError(place + ": " + what);
    tell(place, what, ++seen, "columns");
  };
}

}  // namespace lorentz
