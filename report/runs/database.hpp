// A SQLite file that keeps a run. While the run writes it, it has a write-ahead log, so that a killed process
// loses at most what was not yet committed, and never the file. Otherwise it is a plain file.
#pragma once

#include <memory>
#include <string>

#include "report/runs/lock_file.hpp"
#include "report/runs/sqlite.hpp"

namespace lorentz::runs {

enum class Access {
  write,  ///< creates the file if it is missing; no other process may write
  read    ///< changes and creates no file; another process may write meanwhile
};

/// Files of one kind.
struct FileKind {
  std::string name;     ///< "store of lorentz fuzz"
  int application = 0;  ///< distinguishes them from other databases
  int format = 1;
  const char* schema = "";  ///< the SQL that makes their tables
  std::string busy = "another process is writing this store; wait for it, stop it, or name another file";
};

/// For one thread. All functions throw FileError if the file is unusable.
class Database {
 public:
  static constexpr const char* kMemory = ":memory:";

  /// The path kMemory names a store that lives as long as this object. A file must have the tables of the
  /// kind and nothing else; its views and triggers never run.
  Database(const std::string& path, Access access, const FileKind& kind);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  const std::string& path() const { return connection_.path(); }
  const Connection& connection() const { return connection_; }

  /// Writes from begin() on become durable together at commit().
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
