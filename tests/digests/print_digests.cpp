// print_digests [FLIGHTS [NAME]]: prints the digests, one per line; with NAME, every number of the digests
// whose names begin with NAME. ./run determinism compiles this program in many ways and compares the outputs.
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "tests/digests/digests.hpp"

int main(int count, char** arguments) {
  const std::uint64_t flights =
      count > 1 ? std::strtoull(arguments[1], nullptr, 10) : lorentz::digests::kKnownFlights;
  const bool traced = count > 2;
  for (const auto& [name, value] :
       lorentz::digests::digests(flights, traced ? arguments[2] : "", traced ? &std::cout : nullptr))
    if (!traced) std::printf("%016llx %s\n", static_cast<unsigned long long>(value), name.c_str());
}
