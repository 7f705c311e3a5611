// Golden records: queries with their exact answers and the proofs of these (docs/formats.md has the
// format).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/certificate.hpp>
#include <lorentz/claim.hpp>
#include <lorentz/exchange.hpp>
#include "src/exchange/json_writer.hpp"

namespace lorentz::golden {

/// The first line of a set.
struct Header {
  std::string name, description;
  std::string generator;  ///< the command that makes the set again
  std::string version;    ///< of the program that made it
  std::uint64_t count = 0;
  std::vector<std::pair<std::string, std::string>> tags;  ///< each with what it is out to break
  /// Of all numbers of its scenes and queries, and of the ulps that margins and conditions count.
  NumberFormat precision = NumberFormat::binary64;
};

struct Record {
  std::string id;
  std::vector<std::string> tags;
  std::string question;  ///< the text after the tags to before `,"expect"`: what the id is made from
  Answer expect;         ///< with time_decimal, of a hit
  std::optional<double> margin, condition;
  std::optional<oracle::Certificate> certificate;
};

/// The id of a question: the beginning of the SHA-256 of the scene's line, a line feed, and the question.
std::string id_of(std::string_view scene_line, std::string_view question);

/// SHA-256 in hexadecimal.
std::string sha256(std::string_view text);

/// The text of a query as it stands in a record.
std::string question_of(const Query& query, const Components& count);

/// The number of significant digits of a record's time_decimal.
inline constexpr int kDigits = 40;

/// Adds its windows and rows; a lattice's bases have as many rows as it has vectors.
void add_certificate(json::Members& object, const oracle::Certificate& certificate, const Components& count);

/// Appends a line, with its line end.
void append_header_line(std::string& out, const Header& header);
void append_record_line(std::string& out, const Record& record, const Components& count);

/// The library that ids are made by, and its version.
std::string record_libraries();

}  // namespace lorentz::golden
