#include "cli/chaos_options.hpp"

#include <chrono>
#include <cmath>

#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "files/messages.hpp"
#include "files/scene_file.hpp"
#include "runs/piece_store.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::cli {

std::vector<Option> chaos_rows(ChaosOptions& options) {
  return {
      {"--scene", &options.scene, "SCENE", "a file, or a name of the catalogue"},
      {"--radius", Positive{&options.radius}, "R", "radius of every ball"},
      {"--seed", Whole{&options.seed}, "N", "of the starts"},
      {"--jobs", Whole{&options.jobs, 1, 1024}, "N", "threads; the result is the same"},
      {"--store", &options.store, "FILE", "where parts that are done are kept, and gone on from", kOutput},
      {"--json", &options.json, "", "one JSON object instead of a table"}};
}

Scene scene_of(const ChaosOptions& options) {
  return load_crystal(options.scene, options.radius, "means of trajectories are taken");
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

std::string name_with_radius(const std::string& name, const Scene& scene) {
  std::optional<double> radius;
  bool same = true;
  for_each_atom(scene, [&](const Atom& atom) {
    same = same && atom.is_ball() && (!radius || *radius == atom.radius);
    radius = atom.radius;
  });
  return same && radius ? fmt::format("{}, r = {:g}", name, *radius) : name;
}

std::string remark_on_end(bool is_whole) {
  return is_whole ? "" : "interrupted: only the parts that were done by then\n";
}

}  // namespace lorentz::cli
