#include "judge/calls.hpp"

#include <algorithm>
#include <cmath>

namespace lorentz::judge {
namespace {

std::size_t* place_of(Call& call, oracle::Verdict verdict) {
  switch (verdict) {
    case oracle::Verdict::agree:
      return &call.right;
    case oracle::Verdict::ill_posed:
      return &call.ill_posed;
    case oracle::Verdict::wrong:
      return &call.wrong;
    case oracle::Verdict::undecided:
      return &call.undecided;
    default:
      return nullptr;
  }
}

}  // namespace

const char* name_of(Measure measure) {
  constexpr const char* kNames[kMeasures] = {
      "radii by which the line enters or misses the obstacle in question",
      "radii from the start to the obstacle in question", "length of the flight, in lattice vectors",
      "distance of the start from the origin, in lattice vectors", "smallest radius, in lattice vectors"};
  return kNames[static_cast<int>(measure)];
}

void Calls::add(std::optional<double> size, oracle::Verdict verdict, std::optional<double> radii_off) {
  const double its = std::fabs(size.value_or(0));
  Call none;
  if (!(its > 0) || !std::isfinite(its) || !place_of(none, verdict)) return;
  Call& call = by_decade_[static_cast<int>(std::floor(std::log10(its)))];
  ++*place_of(call, verdict);
  call.radii_off = std::max(call.radii_off, radii_off.value_or(0));
}

void Calls::add(const Calls& others) {
  for (const auto& [decade, other] : others.by_decade_) {
    Call& its = by_decade_[decade];
    for (const auto part : {&Call::right, &Call::ill_posed, &Call::wrong, &Call::undecided})
      its.*part += other.*part;
    its.radii_off = std::max(its.radii_off, other.radii_off);
  }
}

}  // namespace lorentz::judge
