#include "cli/piece_store.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <lorentz/errors.hpp>
#include "cli/whole_file.hpp"

namespace lorentz::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char* kBusy =
    "another process is writing this store; wait for it, stop it, or name another file";

void check_regular(const std::string& path) {
  if (fs::exists(path) && !fs::is_regular_file(path))
    throw FileError(path + ": is not a regular file; name one to keep the run in");
}

std::string text_in(const std::string& path) {
  check_regular(path);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw FileError(path + ": cannot be read; is it there, and may you read it?");
  return std::move(text).str();
}

std::vector<std::string> pieces_of(const std::string& path, const std::string& kind,
                                   const store::Plan& plan) {
  try {
    return store::pieces_in(text_in(path), kind, plan);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
}

void read_each(const std::string& path, const std::vector<std::string>& pieces, const ReadPiece& read) {
  std::size_t line = store::kFirstPiece;
  try {
    for (const std::string& piece : pieces) read(piece), ++line;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: line {} {}{}", path, line, error.what(), store::kRemedy));
  }
}

store::Plan with_version(store::Plan plan) {
  plan.insert(plan.begin(), {"version", LORENTZ_VERSION});
  return plan;
}

}  // namespace

void read_pieces(const std::string& path, const std::string& kind, const store::Plan& plan,
                 const ReadPiece& read) {
  read_each(path, pieces_of(path, kind, with_version(plan)), read);
}

PieceStore::PieceStore(std::optional<std::string> path, std::string kind, store::Plan plan)
    : path_(std::move(path)), kind_(std::move(kind)), plan_(with_version(std::move(plan))) {
  if (!path_) return;
  check_regular(*path_);
  lock_ = std::make_unique<store::LockFile>(*path_, true, kBusy);
  if (!fs::exists(*path_)) return;
  pieces_ = pieces_of(*path_, kind_, plan_);
  save();  // before the work: can it be written?
}

void PieceStore::each(const ReadPiece& read) const {
  read_each(path_.value_or(""), pieces_, read);
}

void PieceStore::set(std::vector<std::string> pieces) {
  pieces_ = std::move(pieces);
  save();
}

void PieceStore::add(std::vector<std::string> pieces) {
  for (std::string& piece : pieces) pieces_.push_back(std::move(piece));
  save();
}

void PieceStore::save() const {
  if (path_) write_whole(*path_, store::text_of(kind_, plan_, pieces_));
}

}  // namespace lorentz::cli
