// A SQLite file that a run is kept in: written ahead while the run writes it, so that whoever is killed loses at
// most what was not yet committed, and never the file; a plain file otherwise.
#pragma once

#include <memory>
#include <string>

#include "runs/lock_file.hpp"
#include "runs/sqlite.hpp"

namespace lorentz::runs {

enum class Access {
  write,    ///< makes the file if there is none; nobody else may write
  read,     ///< changes and makes no file; another process may write meanwhile
  settled,  ///< the same, of what nobody else may be writing
};

/// Files of one kind.
struct FileKind {
  std::string name;     ///< "store of lorentz fuzz"
  int application = 0;  ///< tells them from other databases
  int format = 1;
  const char* schema = "";  ///< the SQL that makes their tables
  std::string busy = "another process is writing this store; wait for it, stop it, or name another file";
};

/// For one thread. Everything throws FileError if the file does not do what it should.
class Database {
 public:
  static constexpr const char* kMemory = ":memory:";

  /// The path kMemory is a store that goes with this object. A file must have the tables of the kind, and
  /// nothing else; what it has of views and triggers never runs.
  Database(const std::string& path, Access access, const FileKind& kind);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  const std::string& path() const { return connection_.path(); }
  const Connection& connection() const { return connection_; }

  /// Writes from begin() on become durable together, by commit().
  void begin();
  void commit();

 private:
  void set_up(const FileKind& kind);
  void check(const FileKind& kind) const;
  void write_ahead();

  const bool writes_, is_file_;
  const std::unique_ptr<LockFile> lock_;
  Connection connection_;
  bool is_ahead_ = false, in_transaction_ = false;
};

}  // namespace lorentz::runs
