#include "cli/logged_answers.hpp"

#include "cli/messages.hpp"

namespace lorentz::cli {

LoggedAnswers::LoggedAnswers(const std::string& path, UnknownKeys unknown)
    : lines_(path), keys_(path, unknown) {
  reader_.on_unknown_key([this](const std::string& key) { keys_(key); });
}

void LoggedAnswers::complain(std::size_t line, const std::string& what) {
  bad_input_ = true;
  say("{}:{}: {}", lines_.name(), line, what);
}

// The next good answer that has an id.
bool LoggedAnswers::read(Id& id, Logged& logged) {
  for (LineReader::Line line; lines_.next(line);) {
    keys_.line = line.number;
    try {
      if (!reader_.read_answer_line(line, id, logged.answer, logged.components)) continue;
      is_empty_ = false;
      logged.line = line.number;
      if (id == "null") continue;
      if (ids_.insert(id).second) return true;
      complain(line.number, "the id " + id + " came before; an answer stream has one answer a query");
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
  if (ids_.contains(id)) return false;  // of a query that came before
  for (Id other; read(other, logged); early_.emplace(std::move(other), std::move(logged)))
    if (other == id) return true;
  return false;
}

void LoggedAnswers::ask(const Id& id, const Query&) {
  Logged logged;
  if (id == "null" || !find(id, logged)) {
    Answer none = Answer::error("no answer");
    return deliver(none, Origin::not_asked);
  }
  ++matched_;
  if (logged.components != 0 && logged.components != static_cast<std::size_t>(dimension_)) {
    complain(logged.line, fmt::format("cell: has {} components, the scene has dimension {}",
                                      logged.components, dimension_));
    logged.answer = Answer::error("cell: has another dimension");
  }
  deliver(logged.answer);
}

void LoggedAnswers::finish() {
  Id id;
  for (Logged logged; read(id, logged);) continue;
  const std::string& file = lines_.name();
  if (is_empty_) {
    bad_input_ = true;
    say("{}: is empty: no answer in it", file);
  }
  if (ids_.size() > matched_)
    say("{}: {} answers have an id that no query has", file, ids_.size() - matched_);
  if (matched_ > 0 || ids_.empty()) return;
  bad_input_ = true;
  say("{}: no answer matches any query; is it the right file?", file);
}

}  // namespace lorentz::cli
