#include "src/exchange/exchange_line.hpp"

#include <algorithm>

namespace lorentz {

json::Object JsonLine::open(const LineReader::Line& line) {
  if (line.too_long)
    throw InputError("line longer than " + std::to_string(LineReader::kMaxLine >> 20) + " MiB");
  document_.open(line.text, line.text.size() + LineReader::kPadding);
  if (document_.type() != json::Type::object)
    throw InputError("not JSON as it should be: a line is one object, {...}");
  return document_.object();
}

void JsonLine::close() {
  if (!document_.ended()) throw NotJson("more than one value in the line");
}

CellRead read_cell(json::Value value) {
  if (value.type() != json::Type::array) throw InputError("cell: needs an array of integers");
  CellRead result;
  json::each_element(value.array(), [&](json::Value element) {
    Integer n = read_integer(element, "cell");
    if (result.count < 3) result.cell[result.count] = std::move(n);
    ++result.count;
  });
  return result;
}

int read_index(json::Value value, const char* key) {
  const Integer n = read_integer(value, key);
  if (!n.fits_int64() || n.int64() < 0 || n.int64() > 1'000'000'000)
    throw InputError(std::string(key) + ": is not an index");
  return static_cast<int>(n.int64());
}

std::optional<Outcome> outcome_named(std::string_view name) {
  for (const Outcome outcome :
       {Outcome::hit, Outcome::never, Outcome::inside, Outcome::later, Outcome::undecided, Outcome::error})
    if (name_of(outcome) == name) return outcome;
  return std::nullopt;
}

Id read_id(json::Value value) {
  if (value.type() == json::Type::string) return json_quoted(value.text());
  if (value.type() == json::Type::null) {
    skip(value);
    return "null";
  }
  std::string id;
  append_integer(id, read_integer(value, "id"));
  return id;
}

FromRead read_from(json::Value value, const OnUnknownKey& on_unknown_key) {
  if (value.type() != json::Type::object)
    throw InputError("from: needs an object with lattice, atom and cell");
  FromRead from;
  json::each_member(value.object(), [&](std::string_view key, json::Value member) {
    if (key == "lattice") {
      from.obstacle.lattice = read_index(member, "from.lattice");
      from.lattice = true;
    } else if (key == "atom") {
      from.obstacle.atom = read_index(member, "from.atom");
      from.atom = true;
    } else if (key == "cell") {
      CellRead cell = read_cell(member);
      from.obstacle.cell = std::move(cell.cell);
      from.components = cell.count, from.cell = true;
    } else {
      if (on_unknown_key) on_unknown_key("from." + std::string(key));
      skip(member, 2);
    }
  });
  if (!from.lattice || !from.atom || !from.cell) throw InputError("from: needs lattice, atom and cell");
  return from;
}

namespace {

// Finds a word that programs write where a number is missing or infinite, and that JSON does not have.
std::string_view no_number_in(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      quoted = !quoted;
    else if (!quoted)
      for (const std::string_view word : {"NaN", "nan", "-Infinity", "Infinity", "-inf", "inf"})
        if (text.substr(i).starts_with(word)) return word;
  }
  return {};
}

}  // namespace

std::string not_json(const LineReader::Line& line, const std::string& why) {
  const auto nuls = std::count(line.text.begin(), line.text.end(), '\0');
  if (nuls > 0)
    return "not JSON: holds " + std::to_string(nuls) +
           " NUL bytes (was the file overwritten or cut while it was written?)";
  if (const std::string_view word = no_number_in(line.text); !word.empty())
    return "not JSON: " + std::string(word) +
           " is not a number there (Python's json writes it; a time beyond binary64 is \"inf\", in quotes, "
           "and "
           "what "
           "is not known is \"outcome\":\"undecided\")";
  return "not JSON: " + why;
}

bool is_blank(const LineReader::Line& line) {
  return !line.too_long && line.text.find_first_not_of(" \t\r") == std::string_view::npos;
}

bool begins_as_scene(std::string_view text) {
  for (const std::string_view part : {"{", "\"scene\"", ":"}) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    if (!text.starts_with(part)) return false;
    text.remove_prefix(part.size());
  }
  return true;
}

void check_dimension(const char* what, std::size_t count, int dimension) {
  if (count != static_cast<std::size_t>(dimension))
    throw InputError(std::string(what) + ": has " + std::to_string(count) +
                     " components, the scene has dimension " + std::to_string(dimension));
}

// The keys that golden records, golden itineraries and files of disagreements have beside the query.
bool is_beside_query(std::string_view key) {
  constexpr std::string_view kKeys[] = {"golden",      "tags",        "expect",    "time_decimal", "margin",
                                        "condition",   "certificate", "itinerary", "times",        "end",
                                        "time_change", "acceptable",  "comment",   "source_id",    "engine",
                                        "verdict",     "departs",     "expected",  "given"};
  return std::find(std::begin(kKeys), std::end(kKeys), key) != std::end(kKeys);
}

}  // namespace lorentz
