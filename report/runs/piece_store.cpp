#include "report/runs/piece_store.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>

namespace lorentz::runs {
namespace {

const FileKind& kind() {
  static const FileKind kind{"store of a run of lorentz", 0x6c6f7270,  // "lorp"
                             1, R"sql(
  CREATE TABLE plan (place INTEGER PRIMARY KEY, name TEXT NOT NULL, value TEXT NOT NULL);
  CREATE TABLE piece (number INTEGER PRIMARY KEY, text TEXT NOT NULL, "check" TEXT NOT NULL);
)sql"};
  return kind;
}

std::uint64_t check_of_plan(const Plan& plan) {
  std::uint64_t check = kCheckOfNothing;
  for (const auto& [name, value] : plan)
    for (const std::string& word : {name, value}) check = check_of(word + '\n', check);
  return check;
}

std::string digits(std::uint64_t check) {
  return fmt::format("{:016x}", check);
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw InputError(
      fmt::format("{}: {}; give what it was begun with, name another file, or remove this one", path, what));
}

Plan whole_plan(const std::string& command, const Plan& plan) {
  Plan whole{{"command", command}, {"version", LORENTZ_VERSION}};
  whole.insert(whole.end(), plan.begin(), plan.end());
  return whole;
}

}  // namespace

PieceStore::PieceStore(const std::optional<std::string>& path, const std::string& command, const Plan& plan)
    : is_file_(path.has_value()),
      database_(path.value_or(Database::kMemory), Access::write, kind()),
      begin_(check_of_plan(whole_plan(command, plan))),
      check_(begin_) {
  begin_or_check(whole_plan(command, plan));
  check_all();
}

void PieceStore::begin_or_check(const Plan& plan) {
  Statement row(database_.connection(), "SELECT name, value FROM plan ORDER BY place");
  std::size_t same = 0;
  for (; row.step(); ++same) {
    const std::string name = row.text(), value = row.text();
    if (same == 0 && value != plan[0].second)
      refuse(database_.path(), fmt::format("is a store of `lorentz {}`", value));
    if (same == plan.size() || name != plan[same].first)
      refuse(database_.path(), "is of another version of this program");
    if (value != plan[same].second)
      refuse(database_.path(), fmt::format("is of another run: its {} is {}, not {}", name,
                                           json_quoted(value), json_quoted(plan[same].second)));
  }
  if (same == plan.size()) return;
  if (same > 0) refuse(database_.path(), "is of another version of this program");
  database_.begin();
  Statement word(database_.connection(), "INSERT INTO plan (name, value) VALUES (?, ?)");
  for (const auto& [name, value] : plan) word.bind(name).bind(value).done();
  database_.commit();
}

void PieceStore::check_all() {
  Statement row(database_.connection(), "SELECT number, text, \"check\" FROM piece ORDER BY number");
  const auto is_next = [&] {
    try {
      if (row.integer() != static_cast<std::int64_t>(++size_)) return false;
      check_ = check_of(row.text(), check_);
      return row.text() == digits(check_);
    } catch (const BadValue&) {
      return false;
    }
  };
  while (row.step())
    if (!is_next())
      throw InputError(
          fmt::format("{}: piece {} is damaged, or one before it is missing: it is not what its checksum was "
                      "made of{}",
                      database_.path(), size_, kRemedy));
}

void PieceStore::each(const ReadPiece& read) const {
  Statement row(database_.connection(), "SELECT text FROM piece ORDER BY number");
  std::uint64_t number = 1;
  try {
    for (; row.step(); ++number) read(row.text());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: piece {} {}{}", database_.path(), number, error.what(), kRemedy));
  }
}

void PieceStore::append(const std::string& piece) {
  check_ = check_of(piece, check_);
  Statement(database_.connection(), "INSERT INTO piece VALUES (?, ?, ?)")
      .bind(++size_)
      .bind(piece)
      .bind(digits(check_))
      .done();
}

void PieceStore::set(const std::string& piece) {
  database_.begin();
  Statement(database_.connection(), "DELETE FROM piece").done();
  check_ = begin_, size_ = 0;
  append(piece);
  database_.commit();
}

void PieceStore::add(const std::vector<std::string>& pieces) {
  database_.begin();
  for (const std::string& piece : pieces) append(piece);
  database_.commit();
}

}  // namespace lorentz::runs
