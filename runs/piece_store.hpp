// What is done of a run, piece by piece, in one file (--store).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runs/database.hpp"

namespace lorentz::runs {

/// All that the pieces of a run depend on, as names and values. Runs are the same if all of it is the same.
using Plan = std::vector<std::pair<std::string, std::string>>;

/// Reads one piece; what it throws as an InputError is told with file and piece.
using ReadPiece = std::function<void(const std::string& piece)>;

/// What to do about a file that cannot be believed.
inline constexpr const char* kRemedy =
    "; take a copy from before, or name another file (this one stays as it is)";

/// The pieces of a run, texts whose meaning the run knows, in their order. Each has a checksum that begins with
/// that of the one before, and with the plan: what was changed, left out or moved is noticed before it is
/// believed.
class PieceStore {
 public:
  /// Without a path pieces are kept in memory. With one the file is locked while this lives if it is written,
  /// and begun if it is not there. `command`: whose run it is ("flights"). `plan` gets the program's version in
  /// front. Throws InputError for a file of another plan or command, or with damaged
  /// pieces, FileError for one that is no such file,
  /// or that another process writes.
  PieceStore(const std::optional<std::string>& path, const std::string& command, const Plan& plan,
             Access access = Access::write);

  /// Reads all pieces. Throws InputError.
  void each(const ReadPiece& read) const;
  std::uint64_t size() const { return size_; }
  bool is_file() const { return is_file_; }

  /// The store then has this piece alone. Killed at any moment, it has it or those before. Throws FileError.
  void set(const std::string& piece);
  /// And these besides.
  void add(const std::vector<std::string>& pieces);

 private:
  void begin_or_check(const Plan& plan, Access access);
  void check_all();
  void append(const std::string& piece);

  const bool is_file_;
  Database database_;
  std::uint64_t begin_, check_, size_ = 0;  ///< the checks of the plan, and of the last piece
};

}  // namespace lorentz::runs
