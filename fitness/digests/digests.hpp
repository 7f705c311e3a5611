// What seeded flights come to, in 64 bits a family: the same on every computer, however the program was
// compiled, or something there is not fit for it (docs/determinism.md).
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz::fitness {

/// Of all answers of one engine in one family of queries: "discs reduction"; of starts: "starts ellipsoids";
/// of paths: "paths discs binary64".
struct Digest {
  std::string name;
  std::uint64_t value = 0;

  friend bool operator==(const Digest&, const Digest&) = default;
};

/// Computes those whose names begin with `only`, of so many flights each. With a stream: writes every number
/// of them, too. Their order, too, is the same everywhere.
std::vector<Digest> digests(std::uint64_t flights, std::string_view only = {}, std::ostream* trace = nullptr);

/// Those of kKnownFlights flights, as they should be.
inline constexpr std::uint64_t kKnownFlights = 512;
const std::vector<Digest>& known_digests();

}  // namespace lorentz::fitness
