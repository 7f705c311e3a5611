// Any bytes as scene lines and golden records, after a given header. The harness checks that nothing crashes
// or hangs, and that a claim that the checker accepts, whatever its proof, is the oracle's answer, to the
// last digit. Besides the record's own claim it tries a false one that looks right in itself: the obstacle
// that would be hit if the first were not there, at the time at which it would be hit.
#include <algorithm>

#include <lorentz/certificate_check.hpp>
#include <lorentz/oracle.hpp>
#include "judge/golden/reader.hpp"
#include "tests/harness/decoder.hpp"
#include "tests/harness/harness.hpp"
#include "tests/harness/input_file.hpp"

namespace lorentz::harness {
namespace {

// A proof that needs more is refused. That loses nothing, because those of the golden sets need a few tens.
constexpr long kMostWork = 20'000;

// A decimal number in any notation: its digits without zeros at either end, and its power of ten.
struct DecimalDigits {
  std::string digits;
  long exponent = 0;

  explicit DecimalDigits(std::string_view text) {
    const std::string_view mantissa = text.substr(0, text.find('e'));
    if (mantissa.size() < text.size()) exponent = std::stol(std::string(text.substr(mantissa.size() + 1)));
    const auto point = mantissa.find('.');
    if (point != std::string_view::npos) exponent -= static_cast<long>(mantissa.size() - point - 1);
    std::copy_if(mantissa.begin(), mantissa.end(), std::back_inserter(digits),
                 [](char c) { return c != '.'; });
    digits.erase(0, digits.find_first_not_of('0'));
    written = static_cast<int>(digits.size());
    while (digits.ends_with('0')) digits.pop_back(), ++exponent;
    if (digits.empty()) exponent = 0;
  }
  int written = 0;  ///< significant digits in the text
  friend bool operator==(const DecimalDigits& a, const DecimalDigits& b) {
    return a.digits == b.digits && a.exponent == b.exponent;
  }
};

void hold_against_oracle(const Scene& scene, const Query& query, const Answer& claim,
                         const std::string& text) {
  oracle::Request request;
  const DecimalDigits claimed(claim.time_decimal);
  request.digits = claim.outcome == Outcome::hit ? claimed.written : 0;
  request.detail = claim.exit_time.has_value();
  const Answer exact = oracle::Oracle(scene).first_hit(query, request);
  const auto same = [&](bool holds, const char* what) {
    require(holds, "what the checker accepts is the oracle's answer", std::string(what) + " of\n" + text);
  };
  same(claim.outcome == exact.outcome, "the outcome");
  if (exact.outcome == Outcome::never) return;
  same(claim.obstacle == exact.obstacle, "the obstacle");
  if (claim.exit_time) same(claim.exit_time == exact.exit_time, "the exit");
  if (exact.outcome != Outcome::hit) return;
  same(claim.time == exact.time, "the time");
  if (request.digits > 0) same(claimed == DecimalDigits(exact.time_decimal), "the decimal time");
}

/// The current scene, with its checker.
class ProofCheck {
 public:
  explicit ProofCheck(const Scene& scene)
      : scene_(scene), checker_(scene, kMostWork), is_ordinary_(harness::is_ordinary(scene)) {}

  void check(const golden::ReadRecord& read, const std::string& text) const {
    const Answer& claim = read.record.expect;
    const auto refutation = checker_.refutation(*read.query, claim, *read.record.certificate);
    if (!refutation) hold_against_oracle(scene_, *read.query, claim, text);
    if (refutation)
      require(!refutation->empty() && refutation->find('\n') == std::string::npos,
              "a refutation is a line that says why", text);
    if (!is_ordinary_) return;  // the oracle may be slow
    const oracle::Oracle oracle(scene_);
    const Answer first = oracle.first_hit(*read.query);
    const auto require_refuted = [&](const Answer& lie, const char* promise) {
      require(checker_.refutation(*read.query, lie, *read.record.certificate).has_value(), promise, text);
    };
    if (first.outcome != Outcome::never) require_refuted(Answer::never(), "no proof makes a hit none");
    if (first.outcome != Outcome::hit) return;
    const Answer second = oracle.first_hit({read.query->x, read.query->v, first.obstacle});
    if (second.outcome == Outcome::hit)
      require_refuted(second, "no proof makes the second obstacle the first");
  }

 private:
  const Scene scene_;
  const oracle::CertificateCheck checker_;
  const bool is_ordinary_;
};

void check(const std::string& path) {
  golden::Reader reader(path);
  std::optional<ProofCheck> proofs;
  std::size_t scenes = 0;
  for (golden::ReadRecord read; reader.next(read);) {
    if (!read.query || !read.record.certificate) continue;
    if (scenes != reader.scene_number()) proofs.emplace(reader.scene());
    scenes = reader.scene_number();
    proofs->check(read, reader.scene_line() + '\n' + read.text);
  }
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz;
  using namespace lorentz::harness;
  static BytesAsFile file;
  file.set(R"({"golden":{"format":1,"count":0,"tags":{}}})"
           "\n" +
           std::string(text_of(data, size)));
  try {
    check(file.path());
  } catch (const InputError&) {
  }
  return 0;
}
