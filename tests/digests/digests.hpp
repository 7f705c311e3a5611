// Digests of the results of seeded flights, 64 bits per family. They are the same on every computer, however
// the program was compiled. If they differ, something on that computer is unfit for exact work
// (docs/determinism.md).
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz::digests {

/// The digest of all answers of one engine in one family of queries ("discs reduction"), of starts
/// ("starts ellipsoids"), or of paths ("paths discs binary64").
struct Digest {
  std::string name;
  std::uint64_t value = 0;

  friend bool operator==(const Digest&, const Digest&) = default;
};

/// Computes the digests whose names begin with `only`, each from `flights` flights. If `trace` is given, it
/// also gets every number. The order of the digests is the same everywhere, too.
std::vector<Digest> digests(std::uint64_t flights, std::string_view only = {}, std::ostream* trace = nullptr);

/// The correct digests of kKnownFlights flights.
inline constexpr std::uint64_t kKnownFlights = 512;
const std::vector<Digest>& known_digests();

}  // namespace lorentz::digests
