#include "cli/logged_answers.hpp"

#include "report/files/messages.hpp"

namespace lorentz::cli {

LoggedAnswers::LoggedAnswers(const std::string& path, bool strict)
    : lines_(std::make_unique<AnswerStream>(path, strict)), name_(lines_->lines.name()) {
  lines_->reader.on_unknown_key([this](const std::string& key) { lines_->keys(key); });
}

LoggedAnswers::LoggedAnswers(std::unique_ptr<AnswerReader> columns)
    : columns_(std::move(columns)), name_(columns_->name()) {}

void LoggedAnswers::complain(std::size_t line, const std::string& what) {
  bad_input_ = true;
  say("{}{}: {}", name_, columns_ ? "" : fmt::format(":{}", line), what);
}

// Reads the next valid answer with an id.
bool LoggedAnswers::read(Id& id, Logged& logged) {
  while (columns_ ? read_row(id, logged) : read_line(id, logged)) {
    is_empty_ = false;
    if (id == "null") continue;
    if (ids_.insert(id).second) return true;
    complain(logged.line, "the id " + id + " came before; an answer stream has one answer a query");
  }
  return false;
}

// Stops reading after a bad row.
bool LoggedAnswers::read_row(Id& id, Logged& logged) {
  try {
    return !is_broken_ && columns_->next(logged.answer, id);
  } catch (const InputError& error) {
    is_broken_ = bad_input_ = true;
    is_empty_ = false;
    say("{}", error.what());
    return false;
  }
}

bool LoggedAnswers::read_line(Id& id, Logged& logged) {
  for (LineReader::Line line; lines_->lines.next(line);) {
    lines_->keys.line = logged.line = line.number;
    try {
      if (const auto time = question::own_time_in(line.text, std::ref(lines_->keys)))
        own_time_ = time;
      else if (lines_->reader.read_answer_line(line, id, logged.answer, logged.components))
        return true;
    } catch (const InputError& error) {
      is_empty_ = false;
      complain(line.number, error.what());
    }
  }
  return false;
}

bool LoggedAnswers::find(const Id& id, Logged& logged) {
  if (const auto early = early_.find(id); early != early_.end()) {
    logged = std::move(early->second);
    early_.erase(early);
    return true;
  }
  if (ids_.contains(id)) return false;  // belongs to an earlier query
  for (Id other; read(other, logged); early_.emplace(std::move(other), std::move(logged)))
    if (other == id) return true;
  return false;
}

// Columns have one coordinate per dimension. For a lattice with fewer vectors the last ones must be zero.
std::string LoggedAnswers::flaw_of_cell(const Logged& logged) const {
  const ObstacleId& obstacle = logged.answer.obstacle;
  const bool named = logged.answer.outcome == Outcome::hit || logged.answer.outcome == Outcome::inside;
  if (!named || obstacle.lattice >= static_cast<int>(scene().lattices.size())) return "";
  const int needed = Components(scene()).of_cells(obstacle.lattice);
  int count = static_cast<int>(logged.components);
  if (columns_)
    for (int k = count = needed; k < 3; ++k)
      if (!(obstacle.cell[k] == Integer(0))) count = k + 1;
  return count == needed ? ""
                         : fmt::format("cell: has {} components, the lattice has {} vectors", count, needed);
}

void LoggedAnswers::ask(const Id& id, const Query&) {
  Logged logged;
  if (id == "null" || !find(id, logged))
    return deliver({Answer::error("no answer"), question::Origin::fault});
  ++matched_;
  if (const std::string flaw = flaw_of_cell(logged); !flaw.empty()) {
    complain(logged.line, flaw);
    return deliver({Answer::error("cell: has another dimension"), question::Origin::fault});
  }
  deliver({std::move(logged.answer)});
}

void LoggedAnswers::finish() {
  Id id;
  for (Logged logged; read(id, logged);) continue;
  if (is_empty_) {
    bad_input_ = true;
    say("{}: is empty: no answer in it", name_);
  }
  if (ids_.size() > matched_)
    say("{}: {} answers have an id that no query has", name_, ids_.size() - matched_);
  if (matched_ > 0 || ids_.empty()) return;
  bad_input_ = true;
  say("{}: no answer matches any query; is it the right file?", name_);
}

}  // namespace lorentz::cli
