#include "cli/compare_questions.hpp"

#include <lorentz/exchange.hpp>
#include "cli/terminal.hpp"
#include "files/messages.hpp"
#include "files/scene_file.hpp"
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/columns_npy.hpp"

namespace lorentz::cli {

using question::Place, question::Question;

ComparedQuestions::ComparedQuestions(const CompareOptions& options, DisagreementFile& disagreements)
    : options_(options), claim_(options.claim.claim()), disagreements_(disagreements) {
  std::optional<Scene> scene;
  if (options.scene || !options.queries)
    scene = load_scene(options.scene.value_or("square"), options.radius, options.unknown_keys());
  else if (options.radius)
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  // What --scene names is rounded to what the engine can take; what a stream holds is asked as it is.
  if (scene) scene = rounded_scene(*scene, claim_.precision, options.scene.value_or("square"));
  if (scene) enter(*scene);
  if (!options.queries) return;
  if (is_columns(*options.queries))
    open_columns(*options.queries);
  else
    stream_.emplace(*options.queries, scene, options.unknown_keys());
}

void ComparedQuestions::enter(const Scene& scene) {
  place_ = std::make_shared<Place>(scene, question::Truth::oracle, claim_);
  disagreements_.begin(place_);
  is_new_ = true;
}

void ComparedQuestions::open_columns(const std::string& path) {
  if (!place_) throw InputError("--queries: columns hold no scene; --scene says it");
  const UnknownKeys policy = options_.unknown_keys();
  if (path.ends_with(".npy"))
    columns_ =
        std::make_unique<NpyQueryReader>(path, dimension(), unknown_columns(npy_query_fields(), policy));
  else
    columns_ = std::make_unique<CsvQueryReader>(path, components(),
                                                unknown_columns(csv_query_columns(dimension()), policy));
}

std::vector<Question> ComparedQuestions::next(std::size_t most) {
  return columns_ ? read_columns(most) : stream_ ? read(most) : draw(most);
}

// Answers are matched by id, so the queries' must be unique.
void ComparedQuestions::add(Questions& questions, const Query& query, const Id& id) {
  if (!options_.answers.empty() && id != "null" && !ids_.insert(id).second) {
    bad_ids_ = true;
    say("the query id {} comes twice: answers cannot be matched to its queries", id);
  }
  if (!place_->has_numbers_for(query)) {
    ++not_asked_;
    if (!options_.answers.empty()) passed_over_.push_back({.place = place_, .query = query, .id = id});
    return;
  }
  scenes_ += std::exchange(is_new_, false);
  ++count_;
  questions.push_back({.place = place_, .query = query, .id = id});
}

std::vector<Question> ComparedQuestions::draw(std::size_t most) {
  Questions questions;
  const std::size_t left = options_.count - count_;
  if (!starts_) starts_.emplace(place_->scene(), starts::Kind::uniform, options_.seed, claim_.precision);
  for (const Query& query : starts_->some(count_, std::min(most, left)))
    add(questions, query, std::to_string(count_));
  return questions;
}

std::vector<Question> ComparedQuestions::read(std::size_t most) {
  Questions questions;
  for (StreamItem item; questions.size() < most && stream_->next(item);) {
    if (item.kind == StreamItem::Kind::scene) enter(item.scene);
    if (item.kind == StreamItem::Kind::query) add(questions, item.query, item.id);
  }
  return questions;
}

std::vector<Question> ComparedQuestions::read_columns(std::size_t most) {
  Questions questions;
  for (QueryRows rows; questions.empty() && columns_->next(rows, most); rows.clear())
    take_rows(rows, questions);
  return questions;
}

void ComparedQuestions::take_rows(const QueryRows& rows, Questions& questions) {
  if (!rows.max_time.empty())
    throw InputError(columns_->name() + ": has limits (max_time); queries are compared without");
  auto flaw = rows.flaws.begin();
  for (std::size_t i = 0; i < rows.count; ++i, ++rows_) {
    const Query query = rows.query(i, dimension());
    const Id id = rows.id.empty() ? std::to_string(rows_) : json_quoted(rows.id[i]);
    const bool is_unreadable = flaw != rows.flaws.end() && flaw->row == i;
    if (is_unreadable)
      complain(id, (flaw++)->message);
    else if (const auto why = flaw_of(query, place_->scene()))
      complain(id, *why);
    else
      add(questions, query, id);
  }
}

void ComparedQuestions::complain(const Id& id, const std::string& why) {
  constexpr std::size_t kMost = 20;
  if (++bad_rows_ <= kMost) say("{}: row {}: {}", columns_->name(), id, why);
}

}  // namespace lorentz::cli
