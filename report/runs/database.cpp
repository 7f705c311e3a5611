#include "report/runs/database.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace lorentz::runs {
namespace {

// A path in the form that SQLite accepts in a URI.
std::string uri_of(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    char escape[4];
    std::snprintf(escape, sizeof escape, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    uri += c == '%' || c == '?' || c == '#' ? std::string(escape) : std::string(1, c);
  }
  return uri;
}

// SQLite reads a plain file, or one with a write-ahead log, without writing. A file that should have a log
// but lacks it (a copy of the file alone) must be opened as immutable.
Connection reading(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path + ": " + std::strerror(errno));
  char header[20] = {};
  file.read(header, sizeof header);
  struct stat ahead {};
  const bool is_plain = header[19] != 2;
  if (is_plain || ::stat((path + "-wal").c_str(), &ahead) == 0) return {path, path, SQLITE_OPEN_READONLY};
  return {path, uri_of(path) + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI};
}

Connection opened(const std::string& path, bool is_file, Access access) {
  if (is_file && std::filesystem::exists(path) && !std::filesystem::is_regular_file(path))
    throw FileError(path + ": is not a regular file; name one to keep the run in");
  if (is_file && access != Access::write) return reading(path);
  return {path, path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE};
}

std::int64_t number_of(const Connection& connection, const char* sql) {
  Statement statement(connection, sql);
  return statement.step() ? statement.integer() : 0;
}

// Tables, indices and all other objects, by name; white space is ignored.
std::vector<std::string> schema_of(const Connection& connection) {
  Statement row(connection,
                "SELECT type || ' ' || name || ' ' || tbl_name || ' ' || ifnull(sql, '') FROM "
                "sqlite_master ORDER BY type, name");
  std::vector<std::string> schema;
  while (row.step()) {
    std::istringstream words(row.text());
    schema.emplace_back();
    for (std::string word; words >> word;) schema.back() += word + ' ';
  }
  return schema;
}

std::vector<std::string> schema_of(const FileKind& kind) {
  Connection ours(Database::kMemory, Database::kMemory, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  ours.run(kind.schema);
  return schema_of(ours);
}

}  // namespace

Database::Database(const std::string& path, Access access, const FileKind& kind)
    : writes_(access == Access::write),
      is_file_(path != kMemory),
      lock_(is_file_ && writes_ ? std::make_unique<LockFile>(path, kind.busy) : nullptr),
      connection_(opened(path, is_file_, access)) {
  set_up(kind);
}

Database::~Database() {
  if (!writes_ || !is_file_) return;
  // Makes it a plain file, unless another process is reading it.
  if (in_transaction_) sqlite3_exec(connection_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
  if (is_ahead_)
    sqlite3_exec(connection_.handle(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
}

void Database::set_up(const FileKind& kind) {
  const bool is_empty = number_of(connection_, "SELECT count(*) FROM sqlite_master") == 0;
  if (!is_empty || !writes_) check(kind);
  if (!writes_) return connection_.run("BEGIN");  // everything that is read is of one moment
  if (!is_empty) return;
  write_ahead();
  const std::string mark = "BEGIN; PRAGMA application_id = " + std::to_string(kind.application) +
                           "; PRAGMA user_version = " + std::to_string(kind.format) + ';';
  connection_.run((mark + kind.schema + "COMMIT;").c_str());
}

// Called before anything is changed or trusted.
void Database::check(const FileKind& kind) const {
  if (number_of(connection_, "PRAGMA application_id") != kind.application)
    throw FileError(path() + ": is a database, but no " + kind.name);
  if (const auto format = number_of(connection_, "PRAGMA user_version"); format != kind.format)
    throw FileError(path() + ": is a store of another format (" + std::to_string(format) +
                    "); this program has format " + std::to_string(kind.format) +
                    ", and another version made it");
  if (schema_of(connection_) != schema_of(kind))
    throw FileError(path() +
                    ": has tables, views or triggers that no store has: another program changed it; take a "
                    "copy from before, or name another store");
}

// Starts at the first write, so that a file that is refused stays unchanged.
void Database::write_ahead() {
  if (is_ahead_) return;
  is_ahead_ = true;
  connection_.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;");
}

void Database::begin() {
  write_ahead();
  if (!in_transaction_) connection_.run("BEGIN IMMEDIATE");
  in_transaction_ = true;
}

void Database::commit() {
  if (!in_transaction_) return;
  connection_.run("COMMIT");
  in_transaction_ = false;
}

}  // namespace lorentz::runs
