// One case on a page: the question, the exact answer, perhaps another one, and the drawing of both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "cli/command.hpp"

namespace lorentz::cli {

struct CaseReport {
  std::string title;
  std::string command;  ///< that makes this report
  std::string cause;    ///< what it is called
  std::string explanation;
  std::string where;    ///< it comes from
  std::string verdict;  ///< wrong, ill-posed, wrong-time, undecided, ..; "exact": there is no other answer
  Scene scene;
  Query query;
  std::optional<Answer> given;
  Answer exact;
  std::optional<ObstacleId> decisive;  ///< that the answer given is judged by
  std::optional<double> by_ulps;       ///< the inputs must move for the answer to be right
  std::vector<std::string> more;       ///< lines that are said after the reason
  Claim claim;                         ///< by which it is judged
  std::string engine;                  ///< whose answer it is; empty: nobody's
};

/// The drawing, or an empty text if there is nothing to be drawn.
std::string drawing_of(const CaseReport& report);

/// The report of kind "case", with one finding, as docs/page.md has it.
std::string page_json(const CaseReport& report);

/// Where a case is written to besides.
struct CaseFiles {
  std::optional<std::string> html, svg;

  std::vector<Option> rows();  ///< --html, --svg
  bool any() const { return html || svg; }
  std::string as_typed() const;  ///< " --html FILE", or nothing

  /// Throws FileError, also if the program has no page and one was asked for; and InputError if there is
  /// nothing to be drawn. Either both files are made or none is touched (but for a disk that is full).
  void write(const CaseReport& report) const;
};

}  // namespace lorentz::cli
