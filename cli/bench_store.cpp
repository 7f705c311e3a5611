#include "cli/bench_store.hpp"

#include <algorithm>
#include <filesystem>

#include <lorentz/errors.hpp>
#include <lorentz/line_reader.hpp>
#include "cli/numbers.hpp"
#include "cli/whole_file.hpp"

namespace lorentz::cli {
namespace {

report::CellStore read(const std::string& path) {
  std::string text;
  LineReader lines(path);
  for (LineReader::Line line; lines.next(line);) text += std::string(line.text) + '\n';
  return report::CellStore::of(text);
}

}  // namespace

BenchStore::BenchStore(std::optional<std::string> path, report::CellStore::Run run, std::string manifest)
    : path_(std::move(path)), store_{std::move(run), std::move(manifest), {}} {
  if (!path_) return;
  lock_ = std::make_unique<fuzz::LockFile>(
      *path_, true, "another process is writing this store; wait for it, stop it, or name another file");
  if (std::filesystem::exists(*path_)) {
    if (!std::filesystem::is_regular_file(*path_))
      throw InputError("--store: " + *path_ + ": is no file; name one to keep the cells in");
    try {
      report::CellStore kept = read(*path_);
      kept.check(store_.run);
      store_ = std::move(kept);
    } catch (const InputError& error) {
      throw InputError("--store: " + *path_ + ": " + error.what() + "; name another file, or delete it");
    }
  }
  save();
}

std::optional<std::vector<report::Cell>> BenchStore::find(const BenchGroup& group,
                                                          const std::vector<std::string>& engines) const {
  std::vector<report::Cell> found;
  for (const std::string& engine : engines)
    for (const report::Cell& cell : store_.cells)
      if (cell.engine == engine && cell.scene == group.scene &&
          cell.radius == positive_number(group.radius, "--radius") &&
          cell.difficulty == compare::name_of(group.difficulty)) {
        found.push_back(cell);
        break;
      }
  if (found.size() < engines.size()) return std::nullopt;
  return found;
}

void BenchStore::add(const std::vector<report::Cell>& cells) {
  store_.cells.insert(store_.cells.end(), cells.begin(), cells.end());
  save();
}

void BenchStore::save() const {
  if (path_) write_whole(*path_, store_.text());
}

}  // namespace lorentz::cli
