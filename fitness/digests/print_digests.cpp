// print_digests [FLIGHTS [NAME]]: the digests, a line each; with NAME, every number of those whose names
// begin so. What ./run determinism compiles in many ways, and compares.
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "fitness/digests/digests.hpp"

int main(int count, char** arguments) {
  const std::uint64_t flights =
      count > 1 ? std::strtoull(arguments[1], nullptr, 10) : lorentz::fitness::kKnownFlights;
  const bool traced = count > 2;
  for (const auto& [name, value] :
       lorentz::fitness::digests(flights, traced ? arguments[2] : "", traced ? &std::cout : nullptr))
    if (!traced) std::printf("%016llx %s\n", static_cast<unsigned long long>(value), name.c_str());
}
