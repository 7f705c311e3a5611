#include "cli/compare_questions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <lorentz/exchange.hpp>
#include "cli/numbers.hpp"
#include "report/files/messages.hpp"
#include "report/files/scene_file.hpp"

namespace lorentz::cli {

using question::Place, question::Question;

namespace {

// Each scene at each radius, rounded to the engine's precision.
std::vector<Scene> scenes_named(const ExaminationOptions& options, NumberFormat precision) {
  std::vector<std::string> names = options.scenes;
  if (names.empty() && !options.queries) names = {"square"};
  if (names.empty() && !options.radii.empty())
    throw InputError("--radius: needs --scene (the scenes of a stream say their radii themselves)");
  std::vector<std::optional<std::string>> radii(options.radii.begin(), options.radii.end());
  if (radii.empty()) radii.emplace_back();
  std::vector<Scene> scenes;
  for (const std::string& name : names)
    for (const auto& radius : radii)
      scenes.push_back(rounded_scene(
          load_scene(name, positive_number(radius, "--radius"), options.unknown_keys()), precision, name));
  if (options.queries && scenes.size() > 1) throw InputError("--scene: with --queries there is one at most");
  return scenes;
}

}  // namespace

// Scenes of a stream are used unchanged.
ComparedQuestions::ComparedQuestions(const ExaminationOptions& options, DisagreementFile& disagreements)
    : options_(options),
      claim_(options.claim.claim()),
      disagreements_(disagreements),
      named_(scenes_named(options, claim_.precision)) {
  std::optional<Scene> first;
  if (!named_.empty()) enter(*(first = named_[0]));
  if (options.queries) given_.emplace(*options.queries, first, options.unknown_keys());
}

void ComparedQuestions::enter(const Scene& scene) {
  place_ = std::make_shared<Place>(scene, claim_);
  disagreements_.begin(place_);
  is_new_ = true;
}

std::string ComparedQuestions::title() const {
  if (scenes_ > 1) return fmt::format("{} scenes", scenes_);
  const std::string name =
      !options_.scenes.empty() ? options_.scenes[0] : options_.queries.value_or("square");
  return options_.radii.empty()
             ? name
             : fmt::format("{} (radius {})", name, *positive_number(options_.radii[0], "--radius"));
}

std::vector<Question> ComparedQuestions::next(std::size_t most) {
  return given_ ? read(most) : draw(most);
}

// Answers are matched by id, so the ids of queries must be unique.
void ComparedQuestions::add(Questions& questions, const Query& query, const Id& id, double max_time) {
  if (!options_.answers.empty() && id != "null" && !ids_.insert(id).second) {
    bad_ids_ = true;
    say("the query id {} comes twice: answers cannot be matched to its queries", id);
  }
  const Question question{.place = place_, .query = query, .id = id, .max_time = max_time};
  if (!place_->has_numbers_for(query)) return pass_over(question, not_asked_);
  const bool is_limit_taken = claim_.domain.limits || !question.has_limit();
  if (!is_limit_taken || !place_->takes(query)) return pass_over(question, outside_domain_);
  scenes_ += std::exchange(is_new_, false);
  ++count_;
  questions.push_back(question);
}

void ComparedQuestions::pass_over(const Question& question, std::size_t& count) {
  ++count;
  if (!options_.answers.empty()) passed_over_.push_back(question);
}

void ComparedQuestions::drop_outside(std::vector<Question>& questions) {
  const auto is_outside = [&](const Question& question) {
    if (question.place->takes(question.query, question.exact)) return false;
    pass_over(question, outside_domain_), --count_;
    return true;
  };
  std::erase_if(questions, is_outside);
}

std::vector<Question> ComparedQuestions::draw(std::size_t most) {
  Questions questions;
  for (; scene_ < named_.size(); ++scene_, drawn_ = 0) {
    if (drawn_ == 0 && scene_ > 0) enter(named_[scene_]);
    if (drawn_ == 0) starts_.emplace(place_->scene(), options_.seed, claim_);
    for (; drawn_ < options_.count && questions.size() < most; ++drawn_) {
      const starts::VariedStart start = (*starts_)[drawn_];
      add(questions, start.query, std::to_string(count_), start.max_time);
    }
    if (drawn_ < options_.count) break;
  }
  return questions;
}

std::vector<Question> ComparedQuestions::read(std::size_t most) {
  Questions questions;
  for (GivenQuery given; questions.size() < most && given_->next(given);) {
    if (given.new_scene && !(place_ && place_->scene() == *given_->scene())) enter(*given_->scene());
    if (given.query) add(questions, *given.query, given.id, given.max_time);
  }
  return questions;
}

}  // namespace lorentz::cli
