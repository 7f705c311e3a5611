#include "judge/calls.hpp"

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

void Calls::add(std::optional<double> radii, oracle::Verdict verdict) {
  const double size = std::fabs(radii.value_or(0));
  Call none;
  if (!(size > 0) || !std::isfinite(size) || !place_of(none, verdict)) return;
  ++*place_of(by_decade_[static_cast<int>(std::floor(std::log10(size)))], verdict);
}

void Calls::add(const Calls& others) {
  for (const auto& [decade, other] : others.by_decade_) {
    Call& its = by_decade_[decade];
    for (const auto part : {&Call::right, &Call::ill_posed, &Call::wrong, &Call::undecided})
      its.*part += other.*part;
  }
}

}  // namespace lorentz::judge
