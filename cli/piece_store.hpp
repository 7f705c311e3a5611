// The file in which a command keeps what is done of a run, piece by piece (--store).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "store/lock_file.hpp"
#include "store/pieces.hpp"

namespace lorentz::cli {

/// Reads one piece; what it throws as an InputError is told with file and line.
using ReadPiece = std::function<void(const std::string& piece)>;

/// Reads the pieces of a file that another process may be writing. `plan` is as in PieceStore. Throws
/// InputError or FileError.
void read_pieces(const std::string& path, const std::string& kind, const store::Plan& plan,
                 const ReadPiece& read);

class PieceStore {
 public:
  /// Without a path pieces are kept in memory only. With one the file is locked while this lives, read if it
  /// is there, else begun. `plan` gets the program's version in front. Throws InputError for a file that is
  /// not of this kind and plan, FileError if another process writes it.
  PieceStore(std::optional<std::string> path, std::string kind, store::Plan plan);

  /// Reads all pieces. Throws InputError.
  void each(const ReadPiece& read) const;

  /// The file then has these pieces. Killed at any moment, it has them or those before. Throws FileError.
  void set(std::vector<std::string> pieces);
  /// And these besides.
  void add(std::vector<std::string> pieces);

  const std::vector<std::string>& pieces() const { return pieces_; }
  explicit operator bool() const { return path_.has_value(); }

 private:
  void save() const;

  const std::optional<std::string> path_;
  const std::string kind_;
  const store::Plan plan_;
  std::unique_ptr<store::LockFile> lock_;
  std::vector<std::string> pieces_;
};

}  // namespace lorentz::cli
