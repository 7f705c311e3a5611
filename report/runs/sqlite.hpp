// SQLite with exceptions: a connection, and statements that are prepared once.
#pragma once

#include <sqlite3.h>

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <lorentz/errors.hpp>

namespace lorentz::runs {

/// The size limit of a row; a finding's lines are far shorter.
inline constexpr int kMostBytes = 64 << 20;

/// A value that cannot occur at its place in a store.
struct BadValue : FileError {
  using FileError::FileError;
};

class Connection {
 public:
  /// `name`: the path in the form for SQLite.
  Connection(const std::string& path, const std::string& name, int flags) : path_(path) {
    const int status = sqlite3_open_v2(name.c_str(), &handle_, flags, nullptr);
    if (status != SQLITE_OK) {
      const std::string why = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
      sqlite3_close(handle_);
      throw FileError(path + ": " + why);
    }
    sqlite3_busy_timeout(handle_, 2000);
    // A store is data. Nothing else in a file may run, or take all memory.
    for (const auto& [option, on] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                     {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                     {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                     {SQLITE_DBCONFIG_ENABLE_VIEW, 0}})
      sqlite3_db_config(handle_, option, on, nullptr);
    sqlite3_limit(handle_, SQLITE_LIMIT_LENGTH, kMostBytes);
  }
  ~Connection() { sqlite3_close(handle_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void run(const char* sql) {
    if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }
  [[noreturn]] void fail() const {
    if (sqlite3_errcode(handle_) == SQLITE_NOTADB)
      throw FileError(path_ + ": is not a store of lorentz, nor any database");
    if (sqlite3_errcode(handle_) == SQLITE_CORRUPT)
      throw FileError(path_ + ": is damaged (" + sqlite3_errmsg(handle_) +
                      "); take a copy from before, or name another file");
    const bool is_full = sqlite3_errcode(handle_) == SQLITE_FULL || sqlite3_errcode(handle_) == SQLITE_IOERR;
    throw FileError(path_ + ": " + sqlite3_errmsg(handle_) +
                    (is_full ? "; with more space the same command can be given again" : ""));
  }
  sqlite3* handle() const { return handle_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  sqlite3* handle_ = nullptr;
};

/// Callers bind values in the order of the question marks, then step.
class Statement {
 public:
  Statement(const Connection& connection, std::string_view sql) : connection_(connection) {
    if (sqlite3_prepare_v2(connection.handle(), sql.data(), static_cast<int>(sql.size()), &handle_,
                           nullptr) != SQLITE_OK)
      connection.fail();
  }
  ~Statement() { sqlite3_finalize(handle_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::string_view text) {
    return bound(
        sqlite3_bind_text(handle_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  }
  template <std::integral T>
  Statement& bind(T n) {
    return bound(sqlite3_bind_int64(handle_, ++bound_, static_cast<std::int64_t>(n)));
  }

  /// True while there are rows.
  bool step() {
    const int status = sqlite3_step(handle_);
    if (status != SQLITE_ROW && status != SQLITE_DONE) connection_.fail();
    column_ = 0;
    return status == SQLITE_ROW;
  }
  /// Runs a statement without rows, and prepares it to be bound again.
  void done() {
    step();
    sqlite3_reset(handle_);
    bound_ = 0;
  }

  // The columns of a row, from the left. Throw BadValue for a value of another type.
  std::string text() {
    const int column = next(SQLITE_TEXT);
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
    return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column))) : "";
  }
  std::int64_t integer() { return sqlite3_column_int64(handle_, next(SQLITE_INTEGER)); }

 private:
  Statement& bound(int status) {
    if (status != SQLITE_OK) connection_.fail();
    return *this;
  }
  int next(int type) {
    if (sqlite3_column_type(handle_, column_) == type) return column_++;
    throw BadValue(connection_.path() + ": its value of \"" + sqlite3_column_name(handle_, column_) +
                   "\" is of another type");
  }
  const Connection& connection_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0, column_ = 0;
};

}  // namespace lorentz::runs
