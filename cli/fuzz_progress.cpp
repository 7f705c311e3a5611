#include "cli/fuzz_progress.hpp"

#include <cmath>
#include <limits>

#include "cli/fuzz_options.hpp"
#include "files/messages.hpp"

namespace lorentz::cli {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

JournalWithProgress::JournalWithProgress(fuzz::Store& store, std::int64_t campaign,
                                         const fuzz::Bounds& bounds, std::size_t targets,
                                         double seconds_a_line)
    : journal_(store, campaign),
      most_seconds_(bounds.seconds),
      by_time_(bounds.count > kMostCases),
      targets_(targets),
      seconds_a_line_(seconds_a_line),
      next_line_(isatty(STDERR_FILENO) != 1 && seconds_a_line > 0 ? seconds_a_line : kNever),
      progress_(by_time_ ? "seconds" : "indices",
                by_time_ ? static_cast<std::size_t>(bounds.seconds) : bounds.count * targets, 1) {}

void JournalWithProgress::record(const cases::Target& target, const fuzz::TargetTally& tally,
                                 const std::vector<fuzz::Finding>& kept) {
  Met& met = met_[target.name()];
  met = {tally.next, tally.cases, 0};
  for (const auto& [sort, number] : tally.sorts) met.findings += number;
  journal_.record(target, tally, kept);
}

// Like "1234 cases, 5 findings, 7 of 33 targets".
std::string JournalWithProgress::summary() const {
  Met all;
  std::size_t begun = 0;
  for (const auto& [target, met] : met_) {
    all.cases += met.cases;
    all.findings += met.findings;
    begun += met.cases > 0;
  }
  return fmt::format("{} cases, {} findings, {} of {} targets", all.cases, all.findings, begun, targets_);
}

void JournalWithProgress::tick() {
  journal_.tick();
  const double now = seconds();
  std::size_t done = 0;
  for (const auto& [target, met] : met_) done += met.next;
  progress_.at(by_time_ ? static_cast<std::size_t>(now) : done, [&] { return summary(); });
  if (now < next_line_) return;
  next_line_ = now + seconds_a_line_;
  const std::string of = std::isfinite(most_seconds_) ? fmt::format(" of {:.0f}", most_seconds_) : "";
  say("{:.0f}{} s: {}", now, of, summary());
}

}  // namespace lorentz::cli
