#include "report/files/unknown_keys.hpp"

#include "report/files/messages.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz {

void KeyCheck::operator()(const std::string& key) {
  static const std::vector<std::string> kKeys{"from",      "x",        "v",       "id",    "scene",
                                              "dimension", "lattices", "vectors", "atoms", "position",
                                              "radius",    "semiaxes", "lattice", "atom",  "cell",
                                              "outcome",   "time",     "message", "reason"};
  const std::string last = key.substr(key.rfind('.') + 1);  // npos + 1 is 0
  const std::string what = "the key " + json_quoted(key) + " is not known" + did_you_mean(last, kKeys);
  if (policy_ == UnknownKeys::errors) throw InputError(what);
  if (seen_.size() > kMost || !seen_.insert(key).second) return;
  const std::string place = line > 0 ? fmt::format("{}:{}", name_, line) : name_;
  if (seen_.size() <= kMost)
    say("warning: {}: {}, and is ignored (--strict: an error)", place, what);
  else
    say("warning: {}: more keys are not known, and are ignored", place);
}

OnUnknownColumn unknown_columns(const std::vector<std::string>& known, UnknownKeys policy) {
  constexpr int kMost = 20;
  return [known, policy, seen = 0](const std::string& place, const std::string& column) mutable {
    const std::string what =
        fmt::format("the column {} is not known{}", json_quoted(column), did_you_mean(column, known));
    if (policy == UnknownKeys::errors) throw InputError(place + ": " + what);
    if (++seen <= kMost)
      say("warning: {}: {}, and is ignored (--strict: an error)", place, what);
    else if (seen == kMost + 1)
      say("warning: {}: more columns are not known, and are ignored", place);
  };
}

}  // namespace lorentz
