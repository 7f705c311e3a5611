#include "judge/golden/record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sha2.h>

#include <algorithm>

#include "src/exchange/exchange_json.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz::golden {
namespace {

void add_basis(json::Members& object, const oracle::CertificateBasis& basis, int rank) {
  std::vector<std::span<const Integer>> rows;
  for (const auto& row : components(basis, rank)) rows.push_back(components(row, rank));
  object.add("basis", rows);
}

// A number if a binary64 is exactly that, else a string.
std::string end_text(const oracle::WindowEnd& end) {
  if (end.infinite) return json::text_of("inf");
  const auto value = binary64_of(end);
  return value ? json::text_of(*value) : json::text_of(text_of(end));
}

}  // namespace

void add_certificate(json::Members& object, const oracle::Certificate& certificate, const Components& count) {
  if (!certificate.rows.empty())
    object.add("rows", json::objects(certificate.rows, [&](json::Members& one, const oracle::Rows& rows) {
                 one.add("lattice", rows.lattice, "atom", rows.atom);
                 add_basis(one, rows.basis, count.of_cells(rows.lattice));
               }));
  if (!certificate.windows.empty() || certificate.rows.empty())
    object.add("windows",
               json::objects(certificate.windows, [&](json::Members& one, const oracle::Window& window) {
                 one.add("lattice", window.lattice, "atom", window.atom, "from",
                         json::Raw{end_text(window.from)}, "to", json::Raw{end_text(window.to)});
                 add_basis(one, window.basis, count.of_cells(window.lattice));
               }));
}

bool Header::explains(const std::string& tag) const {
  return std::ranges::any_of(tags, [&](const auto& known) { return known.first == tag; });
}

bool needs_judge(const Record& record) {
  return std::ranges::find(record.tags, kNeedsJudge) != record.tags.end();
}

std::string sha256(std::string_view text) {
  SHA2_CTX state;
  SHA256Init(&state);
  SHA256Update(&state, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256Final(digest, &state);
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

std::string id_of(std::string_view scene_line, std::string_view question) {
  return sha256(fmt::format("{}\n{}", scene_line, question)).substr(0, 16);
}

std::string id_of(const Scene& scene, const Query& query) {
  return id_of(scene_line(scene), question_of(query, scene));
}

std::string question_of(const Query& query, const Components& count) {
  const std::string object =
      json::text_of([&](json::Members& question) { add_query(question, query, count); });
  return object.substr(1, object.size() - 2);
}

std::string question_in(std::string_view line) {
  std::string question;
  try {
    json::Document document;
    document.open(line);
    json::each_member(document.object(), [&](std::string_view key, json::Value value) {
      if (key != "x" && key != "v" && key != "from") return skip(value);
      question += (question.empty() ? "" : ",") + json_quoted(key) + ':' + value.raw();
    });
    return document.ended() ? question : "";
  } catch (const std::runtime_error&) {  // InputError, NotJson
    return "";
  }
}

void append_header_line(std::string& out, const Header& header) {
  json::append(out, [&](json::Members& line) {
    line.add("golden", [&](json::Members& golden) {
      golden.add("format", header.format, "name", header.name, "description", header.description, "generator",
                 header.generator, "version", header.version, "count", header.count);
      if (header.precision != NumberFormat::binary64) golden.add("precision", name_of(header.precision));
      golden.add("tags", [&](json::Members& tags) {
        for (const auto& [tag, note] : header.tags) tags.add_named(tag, note);
      });
    });
  });
  out += '\n';
}

void append_record_line(std::string& out, const Record& record, const Components& count) {
  json::append(out, [&](json::Members& line) {
    line.add("id", record.id, "tags", record.tags).add_members(record.question);
    line.add("expect", [&](json::Members& expect) {
      Answer answer = record.expect;
      answer.time_decimal.clear();  // a key of the record
      add_answer(expect, answer, count);
    });
    if (!record.expect.time_decimal.empty()) line.add("time_decimal", record.expect.time_decimal);
    if (record.margin) line.add("margin", *record.margin);
    if (record.condition) line.add("condition", *record.condition);
    if (record.time_change) line.add("time_change", *record.time_change);
    if (!record.acceptable.empty())
      line.add("acceptable", json::objects(record.acceptable, [&](json::Members& one, const auto& excused) {
                 add_answer(one, excused.answer, count);
                 one.add("ulps", excused.ulps);
               }));
    if (!record.comment.empty()) line.add("comment", record.comment);
    if (!record.source_id.empty()) line.add("source_id", json::Raw{record.source_id});
    if (record.certificate)
      line.add("certificate",
               [&](json::Members& object) { add_certificate(object, *record.certificate, count); });
  });
  out += '\n';
}

}  // namespace lorentz::golden
