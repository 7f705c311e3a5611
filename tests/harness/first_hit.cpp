// Bytes as a scene and a few flights, one after the other (decoder.hpp gives the bounds). The harness
// compares the engines with the exact oracle, and checks the proof of its answer. `reduction` decides as the
// oracle does or answers `undecided`, the same on every processor. `certified` answers as the oracle does, to
// the bit. The oracle's answer has a proof that its check accepts.
#include <cmath>
#include <cstring>
#include <limits>

#include <lorentz/certificate_check.hpp>
#include <lorentz/certified.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/prover.hpp>
#include <lorentz/verdict.hpp>
#include "src/problem/same_answer.hpp"
#include "tests/harness/decoder.hpp"
#include "tests/harness/harness.hpp"

namespace lorentz::harness {
namespace {

constexpr int kFlights = 3;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

bool same_bits(const Flight& a, const Flight& b) {
  return a.outcome == b.outcome && a.stage == b.stage && a.time_is_rounded == b.time_is_rounded &&
         a.lattice == b.lattice && a.atom == b.atom && a.cell == b.cell &&
         std::memcmp(&a.time, &b.time, sizeof a.time) == 0;
}

/// A scene with all that answer in it.
class HarnessCheck {
 public:
  explicit HarnessCheck(const Scene& scene)
      : scene_(scene), oracle_(scene), certified_(scene), judge_(scene), prover_(scene), check_(scene) {
    if (Reduction::beyond(scene)) return;
    fused_.emplace(scene);
    split_.emplace(scene, Reduction::Processor::without_fma);
  }

  /// The exact answer, after all others have been compared with it.
  Answer check(const Query& query) const {
    oracle::Request digits;
    digits.digits = 40;
    const Answer exact = oracle_.first_hit(query, digits);
    require(exact.outcome != Outcome::error && exact.outcome != Outcome::undecided,
            "the oracle answers a query without flaws", stream(query, exact, exact));
    check_certified(query, exact);
    if (fused_) check_reduction(query, exact);
    bool too_long = false;
    const auto why = check_.refutation(query, exact, prover_.prove(query, exact), &too_long);
    if (why && !too_long)
      fail("the check accepts the proof of the exact answer", stream(query, exact, exact) + *why);
    return exact;
  }

 private:
  void check_certified(const Query& query, const Answer& exact) const {
    const Answer given = certified_.first_hit(query);
    require(same_answer(given, exact), "certified answers as the oracle does", stream(query, exact, given));
    if (exact.outcome != Outcome::hit || !(*exact.time > 0)) return;
    for (const double limit : {*exact.time, std::nextafter(*exact.time, kNoLimit)}) {
      oracle::Request request;
      request.max_time = limit;
      const Answer limited = certified_.first_hit(query, request), truth = oracle_.first_hit(query, request);
      require(same_answer(limited, truth), "certified answers as the oracle does before a time",
              stream(query, truth, limited));
    }
  }

  void check_reduction(const Query& query, const Answer& exact) const {
    const Flight flight = fused_->fly(query),
                 rounded = fused_->fly(query, kNoLimit, Reduction::Time::rounded);
    const ObstacleId* from = query.from ? &*query.from : nullptr;
    const Answer given = answer_of(flight);
    const std::string text = stream(query, exact, given);
    require(same_bits(flight, split_->fly(query)) &&
                same_bits(rounded, split_->fly(query, kNoLimit, Reduction::Time::rounded)),
            "reduction answers the same without fused multiply-add", text);
    const oracle::Verdict verdict = judge_.judge(query, exact, given).verdict;
    require(verdict == oracle::Verdict::agree || verdict == oracle::Verdict::undecided,
            "reduction decides as the oracle does, or not at all", text);
    if (rounded.outcome == Outcome::hit && rounded.time_is_rounded)
      require(same_answer(answer_of(rounded), exact), "a time that reduction calls rounded is rounded", text);
  }

  // A stream that `lorentz first-hit` can run again.
  std::string stream(const Query& query, const Answer& exact, const Answer& given) const {
    std::string text;
    append_scene_line(text, scene_);
    append_query_line(text, "1", query, scene_.dimension);
    text += "exact ";
    append_answer_line(text, "1", exact, scene_.dimension);
    text += "given ";
    append_answer_line(text, "1", given, scene_.dimension);
    return text;
  }

  const Scene scene_;
  oracle::Oracle oracle_;
  oracle::Certified certified_;
  oracle::Judge judge_;
  oracle::Prover prover_;
  oracle::CertificateCheck check_;
  std::optional<Reduction> fused_, split_;
};

/// A flight from the obstacle that was hit, at the rounded place, which may be in it or beside it; nothing if
/// that is too far away.
std::optional<Query> flight_after(const Query& query, const Answer& exact, const Vec& v) {
  if (exact.outcome != Outcome::hit) return std::nullopt;
  Query next{query.x, v, exact.obstacle};
  for (int i = 0; i < 3; ++i) {
    next.x[i] += *exact.time * query.v[i];
    if (!(std::fabs(next.x[i]) <= 0x1p60)) return std::nullopt;
  }
  return next;
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz;
  using namespace lorentz::harness;
  Decoder decoder(data, size);
  const Scene scene = decoder.scene();
  const HarnessCheck engines(scene);
  std::optional<Query> query = decoder.query(scene);
  for (int i = 0; query && i < kFlights; ++i) {
    const Answer exact = engines.check(*query);
    if (!decoder.flag()) break;
    query = flight_after(*query, exact, decoder.velocity(scene));
  }
  return 0;
}
