// The finished pieces of a run, each with its check, in one file (--store).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/runs/database.hpp"

namespace lorentz::runs {

/// Everything on which the pieces of a run depend, as names and values. Two runs are the same if all of it is
/// equal.
using Plan = std::vector<std::pair<std::string, std::string>>;

/// Reads one piece. If it throws InputError, the message is extended by file and piece.
using ReadPiece = std::function<void(const std::string& piece)>;

inline constexpr std::uint64_t kCheckOfNothing = 0xcbf29ce484222325;

/// FNV-1a in 64 bits, of a text that follows one whose check is `before`. A change of a single byte is always
/// detected, because each step is one-to-one.
constexpr std::uint64_t check_of(std::string_view text, std::uint64_t before = kCheckOfNothing) {
  for (const char c : text) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return before;
}

/// The remedy for a file that cannot be trusted.
inline constexpr const char* kRemedy =
    "; take a copy from before, or name another file (this one stays as it is)";

/// The pieces of a run in order; they are texts whose meaning the run knows. Each has a checksum that
/// continues that of the piece before, beginning with the plan, so that a piece that was changed, left out or
/// moved is detected before it is trusted.
class PieceStore {
 public:
  /// Without a path pieces are kept in memory. A file that is written is locked while this lives, and created
  /// if it does not exist. `command`: the command of the run ("flights"). The program's version is put in
  /// front of `plan`. Throws InputError for a file of another plan or command, or with damaged pieces;
  /// FileError for a file of another kind, or one that another process writes.
  PieceStore(const std::optional<std::string>& path, const std::string& command, const Plan& plan);

  /// Reads all pieces. Throws InputError.
  void each(const ReadPiece& read) const;
  std::uint64_t size() const { return size_; }
  bool is_file() const { return is_file_; }

  /// Replaces all pieces by this one. If the program is killed, the store has either the new or the old ones.
  /// Throws FileError.
  void set(const std::string& piece);
  /// Adds these pieces.
  void add(const std::vector<std::string>& pieces);

 private:
  void begin_or_check(const Plan& plan);
  void check_all();
  void append(const std::string& piece);

  const bool is_file_;
  Database database_;
  std::uint64_t begin_, check_, size_ = 0;  ///< the checks of the plan, and of the last piece
};

}  // namespace lorentz::runs
