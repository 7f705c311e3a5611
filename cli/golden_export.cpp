// lorentz golden export: cases of single obstacles as plain tables, for programs that only know rays and
// balls.
#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include <lorentz/oracle.hpp>
#include "cli/app.hpp"
#include "cli/output.hpp"
#include "judge/golden/find_sets.hpp"
#include "judge/golden/reader.hpp"
#include "src/exchange/csv_table.hpp"
#include "src/exchange/nearest_name.hpp"

namespace lorentz::cli {
namespace {

struct ExportedRecord {
  std::string id, tags;
  int dimension;
  Atom obstacle;
  Query query;
  Answer exact;  // with the collision's details
  std::optional<double> margin;
};

// Throws InputError if the scene has more than one obstacle, because the table has no columns for it.
ExportedRecord exported(const golden::Reader& reader, golden::ReadRecord& read) {
  const Scene& scene = reader.scene();
  const Lattice& lattice = scene.lattices[0];
  if (scene.lattices.size() > 1 || lattice.atoms.size() > 1 || lattice.missing < scene.dimension ||
      !read.query)
    throw InputError(
        fmt::format("{}:{}: is not a query beside one single obstacle: such sets are ball-2d, ball-3d "
                    "and ellipsoid-alone",
                    reader.path(), read.line));
  oracle::Request request;
  request.detail = true;
  return {read.record.id,    fmt::format("{}", fmt::join(read.record.tags, " ")),
          scene.dimension,   lattice.atoms[0],
          *read.query,       oracle::Oracle(scene).first_hit(*read.query, request),
          read.record.margin};
}

// The numbers of a case in the order of the columns; empty where the case has no value.
using Columns = std::vector<std::optional<double>>;

void add(Columns& columns, const Vec& a) {
  columns.insert(columns.end(), a.begin(), a.end());
}

Columns asked_of(const ExportedRecord& one) {
  Columns columns;
  add(columns, one.obstacle.position);
  columns.push_back(one.obstacle.is_ball() ? std::optional(one.obstacle.radius) : std::nullopt);
  for (std::size_t i = 0; i < 3; ++i)
    if (i < one.obstacle.semiaxes.size())
      add(columns, one.obstacle.semiaxes[i]);
    else
      columns.insert(columns.end(), 3, std::nullopt);
  add(columns, one.query.x);
  add(columns, one.query.v);
  return columns;
}

Columns told_of(const ExportedRecord& one) {
  Columns columns{one.exact.time};
  if (one.exact.detail)
    add(columns, one.exact.detail->point), add(columns, one.exact.detail->normal);
  else
    columns.insert(columns.end(), 6, std::nullopt);
  columns.push_back(one.margin);
  return columns;
}

constexpr const char* kAsked = "c1,c2,c3,radius,a11,a12,a13,a21,a22,a23,a31,a32,a33,x1,x2,x3,v1,v2,v3";
constexpr const char* kTold = "time,p1,p2,p3,n1,n2,n3,margin";

std::string joined(const Columns& columns, const char* separator, const char* missing, const char* infinity) {
  std::vector<std::string> texts;
  for (const auto& number : columns)
    texts.push_back(!number ? missing : std::isinf(*number) ? infinity : json::text_of(*number));
  return fmt::format("{}", fmt::join(texts, separator));
}

std::string csv_line(const ExportedRecord& one) {
  return fmt::format("{},{},{},{},{},{},{}\n", csv_field(one.id), csv_field(one.tags), one.dimension,
                     joined(asked_of(one), ",", "", "inf"), one.query.from ? 1 : 0,
                     name_of(one.exact.outcome), joined(told_of(one), ",", "", "inf"));
}

// A text as a C string literal.
std::string literal(const std::string& text) {
  std::string quoted;
  for (const char c : text)
    if (static_cast<unsigned char>(c) < ' ')
      quoted += fmt::format("\\{:03o}", c);
    else
      quoted += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return '"' + quoted + '"';
}

// A text that may stand in a C comment: it cannot end the comment.
std::string in_comment(std::string text) {
  std::erase(text, '*');
  return text;
}

std::string c_line(const ExportedRecord& one) {
  return fmt::format("  {{{}, {}, {}, {{{}}}, {}, '{}', {{{}}}}},\n", literal(one.id), literal(one.tags),
                     one.dimension, joined(asked_of(one), ", ", "NAN", "INFINITY"), one.query.from ? 1 : 0,
                     name_of(one.exact.outcome)[0], joined(told_of(one), ", ", "NAN", "INFINITY"));
}

constexpr const char* kCsvHead = "id,tags,dimension,{},leaving,outcome,{}\n";

// The head of the C file: the entries of `asked` and `told`, and the meaning of the letters.
constexpr const char* kCHead =
    "/* {}: {}\n   Made by `lorentz golden export --format c {}`. A ray x + t v and the ball of a radius "
    "around c,\n"
    "   or the ellipsoid {{c + A y : |y| < 1}}, the columns of A the semiaxes. asked: {}.\n"
    "   leaving: the ray leaves this obstacle, which is ignored. outcome: 'h'it, 'i'nside, 'n'ever. told: "
    "{};\n"
    "   the time of entry correctly rounded, the point and the outward normal there, and how far the inputs "
    "may\n"
    "   move, in ulps of {}, until another outcome is right. NAN: does not apply. */\n"
    "#include <math.h>\n"
    "static const struct lorentz_case {{\n  const char *id, *tags;\n  int dimension;\n  double asked[19];\n"
    "  int leaving;\n  char outcome;\n  double told[8];\n}} lorentz_cases[] = {{\n";

int act(const std::string& name, const std::string& format) {
  const bool as_c = index_of_name(format, {"csv", "c"}, "--format") == 1;
  golden::Reader reader(golden::find_set(name));
  const golden::Header& header = reader.header();
  std::string text =
      as_c ? fmt::format(fmt::runtime(kCHead), in_comment(header.name), in_comment(header.description),
                         in_comment(name), kAsked, kTold, name_of(header.precision))
           : fmt::format(fmt::runtime(kCsvHead), kAsked, kTold);
  for (golden::ReadRecord read; reader.next(read);) {
    const ExportedRecord one = exported(reader, read);
    text += as_c ? c_line(one) : csv_line(one);
  }
  print(text + (as_c ? "};\n" : ""));
  return kDone;
}

}  // namespace

Command golden_export_command() {
  auto name = std::make_shared<std::string>();
  auto format = std::make_shared<std::string>("csv");
  return {"export",
          "A set of single obstacles (ball-2d, ball-3d, ellipsoid-alone) as a table, or as a header of C.",
          {
              {"set", name.get(), "SET", "a file, or the name of a committed set", kRequired},
              {"--format", format.get(), "csv|c", "of the table"},
          },
          "Numbers are written so that they are read as the same binary64.\n"
          "Example:\n  lorentz golden export ball-3d > ball-3d.csv\n"
          "  lorentz golden export --format c ball-3d > ball_3d.h",
          [name, format] { return act(*name, *format); }};
}

}  // namespace lorentz::cli
