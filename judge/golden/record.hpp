// Golden records: queries with their exact answers and proofs (format: docs/formats.md).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/certificate.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/verdict.hpp>
#include "src/exchange/json_writer.hpp"

namespace lorentz::golden {

/// The format that is written. Format 1 is read, too; its records have no `time_change` and no `acceptable`.
inline constexpr int kFormat = 2;

/// A record lists the answers that input errors of at most kExcusedUlps ulps excuse, if they are at most
/// kMostAcceptable; otherwise it has the tag.
inline constexpr double kExcusedUlps = 16;
inline constexpr std::size_t kMostAcceptable = 32;
inline constexpr const char* kNeedsJudge = "needs-judge";
inline constexpr const char* kNeedsJudgeNote =
    "more than 32 other answers are within 16 ulps of the inputs, or endless many: none is listed";

/// The first line of a set.
struct Header {
  int format = kFormat;
  std::string name = {}, description = {};
  std::string generator = {};  ///< the command that makes the set again
  std::string version = {};    ///< version of the program that made it
  std::uint64_t count = 0;
  std::vector<std::pair<std::string, std::string>> tags = {};  ///< each with the weakness that it targets
  /// The format of all numbers of its scenes and queries, and of the ulps of margins and conditions.
  NumberFormat precision = NumberFormat::binary64;

  bool explains(const std::string& tag) const;
};

struct Record {
  std::string id = {};
  std::vector<std::string> tags = {};
  std::string comment = {};    ///< on the hard decision; empty: no decision is hard
  std::string source_id = {};  ///< as JSON: the id that the question came with; empty: it had none
  std::string question;        ///< the text between the tags and `,"expect"`, from which the id is made
  Answer expect;               ///< with time_decimal for a hit, and perhaps exit_time
  std::optional<double> margin = {}, condition = {};
  std::optional<double> time_change = {};  ///< for a hit: the effect of an ulp in each input on its time
  std::vector<oracle::ExcusedAnswer> acceptable = {};  ///< besides `expect`, in order of ulps
  std::optional<oracle::Certificate> certificate = {};
};

bool needs_judge(const Record& record);

/// The id of a question: the beginning of the SHA-256 of the scene's line, a line feed, and the question.
std::string id_of(std::string_view scene_line, std::string_view question);
std::string id_of(const Scene& scene, const Query& query);

/// SHA-256 in hexadecimal.
std::string sha256(std::string_view text);

/// The text of a query in a record.
std::string question_of(const Query& query, const Components& count);

/// For a line without a valid query: its text of x, v and `from`, unchanged. Empty if the line is not JSON,
/// or is an object without these.
std::string question_in(std::string_view line);

/// The number of significant digits of a record's time_decimal.
inline constexpr int kDigits = 40;

/// Adds the certificate's windows and rows; a lattice's bases have as many rows as it has vectors.
void add_certificate(json::Members& object, const oracle::Certificate& certificate, const Components& count);

/// Appends a line, with its line end.
void append_header_line(std::string& out, const Header& header);
void append_record_line(std::string& out, const Record& record, const Components& count);

}  // namespace lorentz::golden
