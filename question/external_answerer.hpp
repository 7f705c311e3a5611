// What the answerers of engines outside this program have in common: failures are reported on stderr, and too
// many of them end the asking.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "question/answerer.hpp"

namespace lorentz::question {

/// Reports a failure once, with a stream that reproduces it, and at the end how often it came again; messages
/// that differ in numbers only are one. At most 20 are reported. After 5 failures without an answer in between
/// the engine is given up.
class ExternalAnswerer : public Answerer {
 public:
  bool failed() const final { return failed_; }
  bool given_up() const final { return given_up_; }
  bool is_hopeless() const final { return given_up_ && !ever_answered_; }
  void try_again() final;
  std::optional<OwnTime> own_time() const final { return own_time_; }
  std::uint64_t batch_size() const final { return 256; }

 protected:
  /// `kind`: "cmd" or "lib", with which its name begins, and the errors that are given in place of answers.
  ExternalAnswerer(std::string kind, const std::string& name, const AnswererOptions& options)
      : options_(options), kind_(std::move(kind)), name_(kind_ + ':' + name) {}

  bool is_enough() const { return options_.enough && options_.enough(); }

  /// Reports something that is not a failure.
  void tell(const std::string& what) const;
  void complain(const std::string& what);
  /// `line`: the query at fault, as in a stream. The scene is reported if it differs from the last time.
  void complain(const std::string& what, const Scene& scene, std::string line);
  /// Must be called after the last failure.
  void finish_complaints();

  void note_answer();
  /// Notes a query without an answer. True if it was one too many: then the engine is given up.
  bool note_failure();
  /// The failures may have been due to the scene: the engine, if it ever answered, gets one more start.
  void allow_one_more_start();

  Answer error(const std::string& what) const { return Answer::error(kind_ + ' ' + what); }
  Reply not_asked() const;
  /// For a query that was not waited for, because it was enough.
  Reply not_awaited() const { return {error("was not waited for: the time was over"), Origin::not_asked}; }
  /// Adds to an answer what is requested and the engine does not give.
  void complete(Answer& answer, const Query& query, const Scene& scene, double max_time) const;

  const AnswererOptions options_;
  bool failed_ = false, ever_answered_ = false;
  std::optional<OwnTime> own_time_;

 private:
  // True the first time.
  bool is_new(const std::string& what);

  const std::string kind_, name_;
  struct Complaint {
    std::string what;
    std::size_t times = 0;
  };
  std::map<std::string, Complaint> complaints_;  // by the message without its numbers
  std::optional<Scene> told_scene_;
  int failures_in_row_ = 0;
  bool given_up_ = false;
};

}  // namespace lorentz::question
