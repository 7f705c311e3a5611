// The questions of `lorentz compare`: drawn, or read from a stream or from columns.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "cli/disagreement_file.hpp"
#include "cli/examination_options.hpp"
#include "cli/given_queries.hpp"
#include "question/question.hpp"
#include "question/starts/varied_starts.hpp"

namespace lorentz::cli {

/// The questions that the options specify, part by part, without answers.
class ComparedQuestions {
 public:
  /// Throws InputError and FileError. The first scene is written at the beginning of the file of disagreements.
  ComparedQuestions(const ExaminationOptions& options, DisagreementFile& disagreements);

  /// The next questions, at most `most`; empty at the end.
  std::vector<question::Question> next(std::size_t most);

  bool had_bad_input() const { return bad_ids_ || (given_ && given_->had_bad_input()); }
  std::size_t count() const { return count_; }
  std::size_t not_asked() const { return not_asked_; }  ///< because their numbers have another precision
  std::size_t outside_domain() const { return outside_domain_; }  ///< not asked, as the engine claims
  /// The scene's name, or the number of scenes if there are several.
  std::string title() const;

  /// Takes out the questions that the engine is not asked because of their exact answers.
  void drop_outside(std::vector<question::Question>& questions);

  /// The questions since the last call that were not asked. Logged answers to them must be skipped.
  std::vector<question::Question> passed_over() { return std::exchange(passed_over_, {}); }

  /// Whether the queries are columns, which need a scene. Rows of answers are matched to them by number.
  bool are_columns() const { return given_ && given_->are_columns(); }
  Components components() const { return Components(place_->scene()); }

 private:
  using Questions = std::vector<question::Question>;

  void enter(const Scene& scene);
  void pass_over(const question::Question& question, std::size_t& count);
  Questions draw(std::size_t most);
  Questions read(std::size_t most);
  void add(Questions& questions, const Query& query, const Id& id, double max_time = question::kForEver);

  const ExaminationOptions& options_;
  const Claim claim_;
  DisagreementFile& disagreements_;
  std::vector<Scene> named_;                    // the scenes of --scene and --radius
  std::size_t drawn_ = 0, scene_ = 0;           // queries of the current one of these; the next one
  std::optional<starts::VariedStarts> starts_;  // in the current one
  std::optional<GivenQueries> given_;           // or drawn
  std::shared_ptr<question::Place> place_;
  bool is_new_ = false, bad_ids_ = false;
  std::vector<question::Question> passed_over_;
  std::size_t not_asked_ = 0, outside_domain_ = 0, count_ = 0, scenes_ = 0;
  std::unordered_set<Id> ids_;
};

}  // namespace lorentz::cli
