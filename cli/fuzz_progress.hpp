// Private to cli/fuzz*.cpp: the progress of a running campaign.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>

#include "cli/progress.hpp"
#include "fuzz/campaign/store.hpp"

namespace lorentz::cli {

/// The store's journal. If stderr is a terminal, it shows a progress bar in seconds or in cases; if not, it
/// prints a line at intervals.
class JournalWithProgress final : public fuzz::Journal {
 public:
  /// `seconds_a_line`: the interval between lines; 0 for no lines.
  JournalWithProgress(fuzz::Store& store, std::int64_t campaign, const fuzz::Bounds& bounds,
                      std::size_t targets, double seconds_a_line);

  void record(const cases::Target& target, const fuzz::TargetTally& tally,
              const std::vector<fuzz::Finding>& kept) override;
  void tick() override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Met {
    std::uint64_t next = 0, cases = 0, findings = 0;
  };
  std::string summary() const;
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  fuzz::StoreJournal journal_;
  const double most_seconds_;
  const bool by_time_;
  const std::size_t targets_;
  const double seconds_a_line_;
  double next_line_;
  Progress progress_;
  std::map<std::string_view, Met> met_;  // by target
  Clock::time_point start_ = Clock::now();
};

}  // namespace lorentz::cli
