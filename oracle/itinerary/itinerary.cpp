#include <lorentz/itinerary.hpp>

#include <lorentz/errors.hpp>
#include "oracle/itinerary/passage.hpp"

namespace lorentz::oracle {

std::string_view name_of(JourneyEnd end) {
  constexpr std::string_view kNames[] = {"collisions", "time", "never", "inside", "undecided"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(JourneyEnd::undecided) + 1);
  return kNames[static_cast<std::size_t>(end)];
}

namespace {

// The bits for the next passage: the bits that this passage lost, extrapolated to the journey's end. (A
// passage that stops tells what part it has done.) At least 1.5 and at most 4 times the bits of this passage.
template <std::size_t D>
long next_bits(const Passage<D>& passage, const Journey& journey) {
  const double lost = static_cast<double>(passage.bits_lost()) / std::max(passage.part_done(), 1e-6);
  const double wanted = 1.05 * lost + kBitsADigit * journey.digits + 64;
  const auto bits = static_cast<double>(passage.bits());
  return static_cast<long>(std::clamp(wanted, 1.5 * bits, 4 * bits));
}

template <std::size_t D>
Arrival follow_in(const RationalScene& scene, const Start& start, const Journey& journey,
                  const Itinerary::OnCollision& on_collision) {
  Route<D> route(scene, start, journey, on_collision);
  constexpr long kMostBits = 1L << 18;
  const long enough = static_cast<long>(kBitsADigit * journey.digits) + 64;
  const long most = journey.most_bits > 0 ? journey.most_bits : std::max(kMostBits, 2 * enough);
  for (long bits = journey.first_bits > 0 ? journey.first_bits : enough;;) {
    bits = std::min(bits, most);
    Passage<D> passage(route, bits);
    const bool arrived = passage.go();
    const bool is_stopped = journey.stop && *journey.stop;
    if (arrived || bits == most || is_stopped) return passage.arrival();
    bits = next_bits(passage, journey);
  }
}

// Checks that the vectors and semiaxes are independent.
template <std::size_t D>
void check(const RationalScene& scene) {
  const Start origin;
  const IntegerProblem<D> problem(scene, origin);
  for (std::size_t l = 0; l < problem.scene.lattices.size(); ++l) {
    const auto& lattice = problem.scene.lattices[l];
    const std::string place = "scene: lattice " + std::to_string(l);
    const auto independent = [&](const std::array<ZVec<D>, D>& vectors, std::size_t rank) {
      Basis<D> basis;
      for (std::size_t i = 0; i < rank; ++i) basis[i].p = vectors[i];
      complete<D>(basis, rank);
      return determinant<D>(basis) != 0;
    };
    if (!independent(lattice.vectors, lattice.rank))
      throw InputError(place + ": the primitive vectors are linearly dependent");
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a) {
      const auto& atom = lattice.atoms[a];
      if (atom.semiaxes && !independent(*atom.semiaxes, D))
        throw InputError(place + ", atom " + std::to_string(a) + ": the semiaxes are linearly dependent");
    }
  }
}

}  // namespace

struct Itinerary::Impl {
  RationalScene scene;
};

Itinerary::Itinerary(const RationalScene& scene) : impl_(std::make_unique<const Impl>(Impl{checked(scene)})) {
  if (scene.dimension == 2)
    check<2>(scene);
  else
    check<3>(scene);
}

Itinerary::Itinerary(Itinerary&&) noexcept = default;
Itinerary& Itinerary::operator=(Itinerary&&) noexcept = default;
Itinerary::~Itinerary() = default;

Arrival Itinerary::follow(const Start& start, const Journey& journey, const OnCollision& on_collision) const {
  checked(start, impl_->scene);
  if (journey.digits < 1 || journey.digits > kMostDigits)
    throw InputError("digits: needs from 1 to " + std::to_string(kMostDigits));
  for (const long bits : {journey.first_bits, journey.most_bits})
    if (bits < 0 || bits > kMostBits) throw InputError("bits: needs from 0 to " + std::to_string(kMostBits));
  if (journey.time && !is_positive(*journey.time)) throw InputError("time: must be finite and above zero");
  if (!journey.collisions && !journey.time && !journey.stop && !on_collision)
    throw InputError("journey: give it collisions, a time or a way to stop; else it never ends");
  return impl_->scene.dimension == 2 ? follow_in<2>(impl_->scene, start, journey, on_collision)
                                     : follow_in<3>(impl_->scene, start, journey, on_collision);
}

std::string itinerary_libraries() {
#if __FLINT_RELEASE >= 30000  // Arb is a part of it
  return std::string("FLINT ") + FLINT_VERSION;
#else
  return std::string("Arb ") + arb_version + ", FLINT " + FLINT_VERSION;
#endif
}

}  // namespace lorentz::oracle
