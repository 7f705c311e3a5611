#include "cli/compare_questions.hpp"

#include <lorentz/exchange.hpp>
#include "files/messages.hpp"
#include "files/scene_file.hpp"

namespace lorentz::cli {

using question::Place, question::Question;

ComparedQuestions::ComparedQuestions(const CompareOptions& options, DisagreementFile& disagreements)
    : options_(options), claim_(options.claim.claim()), disagreements_(disagreements) {
  std::optional<Scene> scene;
  if (options.scene || !options.queries)
    scene = load_scene(options.scene.value_or("square"), options.radius, options.unknown_keys());
  else if (options.radius)
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  // The scene of --scene is rounded to the engine's precision. Scenes of a stream are used unchanged.
  if (scene) scene = rounded_scene(*scene, claim_.precision, options.scene.value_or("square"));
  if (scene) enter(*scene);
  if (options.queries) given_.emplace(*options.queries, scene, options.unknown_keys());
}

void ComparedQuestions::enter(const Scene& scene) {
  place_ = std::make_shared<Place>(scene, question::Truth::oracle, claim_);
  disagreements_.begin(place_);
  is_new_ = true;
}

std::vector<Question> ComparedQuestions::next(std::size_t most) {
  return given_ ? read(most) : draw(most);
}

// Answers are matched by id, so the ids of queries must be unique.
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
  for (GivenQuery given; questions.size() < most && given_->next(given);) {
    if (given.new_scene && !(place_ && place_->scene() == *given_->scene())) enter(*given_->scene());
    if (given.query) add(questions, *given.query, given.id);
  }
  return questions;
}

}  // namespace lorentz::cli
