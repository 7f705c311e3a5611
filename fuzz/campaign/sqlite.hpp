// SQLite with exceptions: a connection, and statements that are prepared once. Private to store*.cpp.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <lorentz/errors.hpp>

namespace lorentz::fuzz {

class Connection {
 public:
  /// `name`: what SQLite is to call the path.
  Connection(const std::string& path, const std::string& name, int flags) : path_(path) {
    const int status = sqlite3_open_v2(name.c_str(), &handle_, flags, nullptr);
    if (status != SQLITE_OK) {
      const std::string why = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
      sqlite3_close(handle_);
      throw FileError(path + ": " + why);
    }
    sqlite3_busy_timeout(handle_, 2000);
  }
  ~Connection() { sqlite3_close(handle_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void run(const char* sql) {
    if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }
  [[noreturn]] void fail() const {
    if (sqlite3_errcode(handle_) == SQLITE_NOTADB)
      throw FileError(path_ + ": is no store of lorentz fuzz, nor any database");
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

/// Bind in the order of the question marks, then step.
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
    check(sqlite3_bind_text(handle_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
    return *this;
  }
  Statement& bind(std::int64_t n) {
    check(sqlite3_bind_int64(handle_, ++bound_, n));
    return *this;
  }
  Statement& bind(std::uint64_t n) { return bind(static_cast<std::int64_t>(n)); }
  Statement& bind(int n) { return bind(static_cast<std::int64_t>(n)); }
  Statement& bind(double x) {
    check(sqlite3_bind_double(handle_, ++bound_, x));
    return *this;
  }
  Statement& bind(const std::optional<double>& x) {
    if (x) return bind(*x);
    check(sqlite3_bind_null(handle_, ++bound_));
    return *this;
  }

  /// True while there are rows.
  bool step() {
    const int status = sqlite3_step(handle_);
    if (status != SQLITE_ROW && status != SQLITE_DONE) connection_.fail();
    column_ = 0;
    return status == SQLITE_ROW;
  }
  /// Runs a statement without rows, to be bound anew.
  void done() {
    step();
    sqlite3_reset(handle_);
    bound_ = 0;
  }

  // The columns of a row, from the left.
  std::string text() {
    const int column = column_++;
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
    return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column))) : "";
  }
  std::int64_t integer() { return sqlite3_column_int64(handle_, column_++); }
  std::uint64_t count() { return static_cast<std::uint64_t>(integer()); }
  double real() { return sqlite3_column_double(handle_, column_++); }
  std::optional<double> real_or_null() {
    if (sqlite3_column_type(handle_, column_) != SQLITE_NULL) return real();
    ++column_;
    return std::nullopt;
  }

 private:
  void check(int status) {
    if (status != SQLITE_OK) connection_.fail();
  }
  const Connection& connection_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0, column_ = 0;
};

}  // namespace lorentz::fuzz
