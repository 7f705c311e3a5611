// One case on a page: the question, the exact answer, perhaps a given answer, and the drawing of both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include <lorentz/verdict.hpp>
#include "cli/command.hpp"

namespace lorentz::cli {

struct CaseReport {
  std::string title;
  std::string command;     ///< the command that makes this report
  std::uint64_t seed = 0;  ///< of the campaign that found it
  std::string cause;       ///< the name of the cause
  std::string explanation;
  std::string where;    ///< the source of the case
  std::string verdict;  ///< wrong, ill-posed, wrong-time, undecided, ..; "exact": no answer was given
  Scene scene;
  Query query;
  std::optional<Answer> given;
  Answer exact;
  std::optional<ObstacleId> decisive;  ///< the obstacle that decides about the given answer
  std::optional<double> by_ulps;       ///< the distance that the inputs must move for the answer to be right
  std::vector<std::string> more;       ///< further lines after the reason
  Claim claim;                         ///< the claim by which it is judged,
  double ulps = oracle::kDefaultUlps;  ///< and the tolerance
  std::string engine;                  ///< the engine that gave the answer; empty: none
};

/// Further files to which a case is written.
struct CaseFiles {
  std::optional<std::string> html, svg;

  std::vector<Option> rows();  ///< --html, --svg
  bool any() const { return html || svg; }
  std::string as_typed() const;  ///< " --html FILE", or nothing

  /// Throws FileError, also if a page is requested and the program has none. Throws InputError if there is
  /// nothing to draw. Either both files are written or both are left untouched (except if the disk is full).
  void write(const CaseReport& report) const;
};

}  // namespace lorentz::cli
