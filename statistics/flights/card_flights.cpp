#include "statistics/flights/card_flights.hpp"

#include <algorithm>
#include <bit>
#include <type_traits>

#include <lorentz/errors.hpp>
#include "question/cases/box.hpp"
#include "src/engines/gpu/gpu_batch.hpp"

namespace lorentz::flights {
namespace {

static_assert(gpu::kLogarithmic == Bins::kLogarithmic + 2 && gpu::kLinear == Bins::kLinear + 1 &&
              gpu::kPiece == kBlock && gpu::DigitSums::kDigits == std::tuple_size_v<ExactSum::Digits>);

static_assert(std::is_trivially_copyable_v<Bravais>);  // as it is on the card

gpu::DrawnFlights drawn_of(const FlightsPlan& plan, const PreparedScene& scene) {
  const cases::Box box = cases::Box::of(plan.scene, plan.cells);
  gpu::DrawnFlights drawn{};
  drawn.atom_count = scene.atoms.size();
  drawn.unit = scene.unit, drawn.inverse_unit = scene.inverse_unit;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) drawn.vectors[i][k] = box.vectors[i][k];
    drawn.cells[i] = box.cells[i], drawn.corner[i] = box.corner[i];
  }
  drawn.seed = plan.seed, drawn.series = starts::Candidates::kUniform.hash;
  drawn.bins_exponent = unit_exponent(plan.scene);
  return drawn;
}

ExactSum::Digits digits_of(const gpu::DigitSums& sums) {
  ExactSum::Digits digits;
  for (std::size_t i = 0; i < digits.size(); ++i) digits[i] = static_cast<std::int64_t>(sums.digits[i]);
  return digits;
}

FlightTally tally_of(const gpu::DrawnTally& counted, int exponent) {
  FlightTally tally(exponent);
  tally.hits = counted.hits, tally.never = counted.never, tally.inside = counted.inside;
  tally.logarithms = counted.hits - counted.zeros;
  tally.time.add(digits_of(counted.time)), tally.square.add(digits_of(counted.square));
  tally.log.add(digits_of(counted.log));
  if (counted.hits > 0) {
    tally.longest = std::bit_cast<double>(counted.longest);
    tally.shortest = std::bit_cast<double>(~counted.shortest);
  }
  std::copy_n(counted.logarithmic, gpu::kLogarithmic, tally.bins.logarithmic.begin());
  std::copy_n(counted.linear, gpu::kLinear, tally.bins.linear.begin());
  return tally;
}

}  // namespace

CardFlights::CardFlights(const FlightsPlan& plan, unsigned number, bool hard)
    : prepared_(gpu::prepared(plan.scene)),
      drawn_(drawn_of(plan, prepared_)),
      count_(plan.count),
      card_(number),
      kernel_(card_, gpu::drawn_kernels(), gpu::kind_of(prepared_), gpu::kind_of(prepared_)),
      atoms_(card_, prepared_.atoms.size() * sizeof(Bravais)),
      flights_(card_, sizeof(gpu::DrawnFlights)),
      tally_(card_, sizeof(gpu::DrawnTally) + gpu::kMostLeft * sizeof(gpu::LeftStart)) {
  atoms_.put(prepared_.atoms.data(), prepared_.atoms.size() * sizeof(Bravais));
  drawn_.hard = hard;
  drawn_.atoms = atoms_.at<const Bravais>();
}

std::uint64_t CardFlights::most_blocks() const {
  return prepared_.atoms[0].dimension == 2 ? 1024 : 256;  // some milliseconds
}

void CardFlights::start(const BlockRange& blocks) {
  const std::uint64_t first = blocks.first * gpu::kPiece,
                      end = (blocks.first + (blocks.count - 1) * blocks.every + 1) * gpu::kPiece;
  drawn_.first = first, drawn_.every = blocks.every;
  drawn_.count = blocks.count * gpu::kPiece - (end > count_ ? end - count_ : 0);
  flights_.put(&drawn_, sizeof drawn_);
  tally_.clear(sizeof(gpu::DrawnTally));
  kernel_.start({flights_.address(), tally_.address()});
}

void CardFlights::finish(FlightTally& tally, std::vector<gpu::LeftStart>& left) {
  kernel_.wait();
  const auto counted = std::make_unique<gpu::DrawnTally>();
  tally_.take(counted.get(), sizeof(gpu::DrawnTally));
  if (counted->left > gpu::kMostLeft)
    throw InputError(
        "gpu leaves nearly all flights in this scene to the processor; certified-batch flies them as fast");
  tally.add(tally_of(*counted, drawn_.bins_exponent));
  left.resize(counted->left);
  if (!left.empty()) tally_.take(left.data(), left.size() * sizeof(gpu::LeftStart), sizeof(gpu::DrawnTally));
  std::sort(left.begin(), left.end(),
            [](const gpu::LeftStart& a, const gpu::LeftStart& b) { return a.index < b.index; });
}

}  // namespace lorentz::flights
