// lorentz golden make: produces a set, or all that are committed.
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <thread>

#include <lorentz/exchange.hpp>
#include "cli/claim_options.hpp"
#include "cli/exit_status.hpp"
#include "cli/golden.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "files/whole_file.hpp"
#include "golden/production.hpp"
#include "src/exchange/nearest_name.hpp"
#include "src/problem/write_error.hpp"
#include "starts/free_starts.hpp"

namespace lorentz::cli {

namespace {

namespace fs = std::filesystem;

struct MakeOptions {
  std::optional<std::string> set, folder, precision;
  std::optional<std::uint64_t> count;
  std::string output = "-";
  std::uint64_t seed = starts::kDefaultSeed, jobs = 1;
};

const golden::Set& set_of(const MakeOptions& options) {
  ClaimOptions claim;
  claim.precision = options.precision;
  const NumberFormat precision = claim.claim().precision;
  const golden::Set* set = golden::set_named(*options.set, precision);
  if (!set) {
    std::vector<std::string> names;
    for (const golden::Set& one : golden::sets()) names.push_back(one.name);
    index_of_name(*options.set, names, "--set");  // throws
  }
  if (options.precision && set->precision != precision)
    throw InputError(
        fmt::format("--precision: the set {} is of {} only", set->name, name_of(set->precision)));
  return *set;
}

void report(const golden::Order& order, const golden::RecordCounts& counts) {
  say("{}: {} records (seed {}): {} hit, {} inside, {} never, {} error", order.set->name, counts.records,
      order.seed, counts.hits, counts.insides, counts.nevers, counts.errors);
  const std::uint64_t answered = counts.records - counts.errors;
  if (answered > 0)
    say("{}: all {} answers agreed by their checked certificates, {} of them by walk, too", order.set->name,
        answered, counts.walked);
}

// A file that is no golden set is not overwritten: it would be somebody's loss.
void check_place(const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    throw FileError(path + ": is no regular file; name another, or use standard output");
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) == 0) return;
  const std::string_view kBeginning = "{\"golden\"";
  std::string start(kBeginning.size(), ' ');
  std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != kBeginning)
    throw InputError(path + ": is no golden set, and is left as it is; remove it, or name another file");
}

golden::RecordCounts make_file(const golden::Order& order, const std::string& path) {
  check_place(path);
  goes_on_when_repeated();
  const std::string part = path + ".part";
  if (fs::is_symlink(fs::symlink_status(part))) throw write_error(part, ELOOP);
  golden::RecordCounts counts;
  {
    runs::PieceStore kept(part, "golden make", golden::plan_of(order));
    WholeFile file(path);
    Progress progress(order.set->name.c_str(), order.count, 1);
    counts = golden::produce(
        order, [&](std::string_view text) { file.write(text); },
        [&](std::uint64_t done) { progress.at(done); }, &kept);
    file.commit();
  }
  fs::remove(part);
  return counts;
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int make_all(golden::Order order, const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  std::string sums;
  for (const golden::Set& set : golden::sets()) {
    if (!set.is_committed) continue;
    order.set = &set;
    order.count = set.count;
    const std::string name = set.name + ".ndjson", path = (fs::path(folder) / name).string();
    report(order, make_file(order, path));
    sums += golden::sha256(contents(path)) + "  " + name + '\n';
  }
  const std::string path = (fs::path(folder) / "SHA256SUMS").string();
  WholeFile file(path);
  file.write(sums);
  file.commit();
  return kDone;
}

int make_one(golden::Order order, const MakeOptions& options) {
  order.set = &set_of(options);
  order.count = options.count.value_or(order.set->count);
  if (order.count > order.set->most) {
    say("{}: there are {} records, not {}", order.set->name, order.set->most, order.count);
    order.count = order.set->most;
  }
  if (options.output != "-") {
    report(order, make_file(order, options.output));
    return kDone;
  }
  Progress progress(order.set->name.c_str(), order.count, 1);
  report(order, golden::produce(
                    order,
                    [](std::string_view text) {
                      print(text);
                      if (std::ferror(stdout)) finish_output();
                    },
                    [&](std::uint64_t done) { progress.at(done); }));
  return kDone;
}

int act(const MakeOptions& options) {
  golden::Order order;
  order.seed = options.seed;
  order.jobs = options.jobs;
  if (options.folder && (options.set || options.count || options.precision))
    throw InputError("--all makes every set as it is committed; leave --set, --count and --precision out");
  if (options.folder) return make_all(order, *options.folder);
  if (!options.set) throw InputError("name a set (--set NAME), or a folder for all of them (--all FOLDER)");
  return make_one(order, options);
}

}  // namespace

Command golden_make_command() {
  auto options = std::make_shared<MakeOptions>();
  return {
      "make",
      "Produces a set: the same, bit for bit, whatever --jobs.",
      {
          {"--set", &options->set, "SET", "which set (lorentz golden list)"},
          {"--precision", &options->precision, "binary64|binary32",
           "of the numbers of scenes and queries: cases are hard in its ulps, which margins and conditions "
           "count "
           "(default: binary64)"},
          {"--count", Whole{&options->count, 1, 1'000'000'000'000}, "N",
           "how many records (default: as many as are committed, or would be)"},
          {"--seed", Whole{&options->seed}, "N", "of the cases"},
          {"--jobs", Whole{&options->jobs, 1, 1024}, "N", "threads"},
          {"-o,--output", &options->output, "FILE",
           "file to write (- is standard output); killed in between, the same command goes on where it was",
           kOutput},
          {"--all", &options->folder, "FOLDER",
           "make all sets in this folder as they are committed, and SHA256SUMS"},
      },

      "Every record was agreed by two oracles: walk, where it can go, and the checked certificate.\n"
      "Example:\n  lorentz golden make --set near-rational --count 1e3 --jobs 2 -o near-rational.ndjson\n"
      "  lorentz golden make --set grazing --precision binary32 -o grazing-binary32.ndjson",
      [options] { return act(*options); }};
}

}  // namespace lorentz::cli
