#include "cli/chaos_options.hpp"

#include <chrono>
#include <cmath>

#include <lorentz/errors.hpp>
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "files/messages.hpp"
#include "runs/piece_store.hpp"

namespace lorentz::cli {

std::vector<Option> chaos_rows(ChaosOptions& options, const std::string& rows_of_csv) {
  return joined(scan_rows(options, rows_of_csv),
                {
                    {"--jobs", Whole{&options.jobs, 1, 1024}, "N", "threads; the result is the same"},
                    {"--store", &options.store, "FILE",
                     "where parts that are done are kept, and gone on from", kOutput},
                });
}

void check_store(const ChaosOptions& options) {
  if (options.store && options.is_of_several())
    throw InputError("--store: parts are kept of one scene at one radius; run several one by one");
}

void with_work(const ChaosOptions& options, const std::string& kind, const runs::Plan& plan,
               const std::function<void(const chaos::Work&)>& run) {
  const auto jobs = static_cast<unsigned>(options.jobs);
  runs::PieceStore store(options.store, kind, plan);
  if (store.size() > 0) say("{}: {} of {} parts are done", *options.store, store.size(), chaos::kGroups);
  const Interrupt interrupt;
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress("flying, part", chaos::kGroups, 1);
    chaos::Work work{jobs, &Interrupt::came(), [&](std::uint64_t done) { progress.at(done); }};
    if (store.is_file())
      work.kept = {[&](const runs::ReadPiece& read) { store.each(read); },
                   [&](const std::string& piece) { store.add({piece}); }};
    run(work);
  }
  say("{:.2f} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  if (Interrupt::came())
    say("{}; {}", Interrupt::what(),
        store.is_file() ? "the same command goes on" : "without --store nothing is kept to go on with");
}

}  // namespace lorentz::cli
