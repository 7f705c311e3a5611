#include "src/exchange/exchange_line.hpp"

#include <algorithm>

namespace lorentz {

json::Value ExchangeReader::Impl::open(const LineReader::Line& line) {
  if (line.too_long)
    throw InputError("line longer than " + std::to_string(LineReader::kMaxLine >> 20) + " MiB");
  document.open(line.text, line.text.size() + LineReader::kPadding);
  if (document.type() != json::Type::object)
    throw InputError("not JSON as it should be: a line is one object, {...}");
  return document.object();
}

void ExchangeReader::Impl::close() {
  if (!document.ended()) throw NotJson("more than one value in the line");
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

namespace {

// The number of a lattice or an atom.
int read_index(json::Value value, const std::string& place) {
  const Integer n = read_integer(value, place.c_str());
  if (!n.fits_int64() || n.int64() < 0 || n.int64() > 1'000'000'000)
    throw InputError(place + ": is not an index");
  return static_cast<int>(n.int64());
}

// Returns the number of coordinates.
std::size_t read_cell(json::Value value, const std::string& place, Cell& cell) {
  if (value.type() != json::Type::array) throw InputError(place + ": needs an array of integers");
  std::size_t count = 0;
  json::each_element(value, [&](json::Value element) {
    Integer n = read_integer(element, place.c_str());
    if (count < cell.size()) cell[count] = std::move(n);
    ++count;
  });
  return count;
}

// The obstacle that is left.
ObstacleRead read_from(json::Value value, const OnUnknownKey& on_unknown_key) {
  if (value.type() != json::Type::object)
    throw InputError("from: needs an object with lattice, atom and cell");
  ObstacleRead from;
  json::each_member(value, [&](std::string_view key, json::Value member) {
    if (from.read(key, member, "from.")) return;
    if (on_unknown_key) on_unknown_key("from." + std::string(key));
    skip(member, 2);
  });
  if (!from.is_whole()) throw InputError("from: needs lattice, atom and cell");
  return from;
}

// The keys that golden records, golden itineraries and files of disagreements have beside the query.
bool is_beside_query(std::string_view key) {
  constexpr std::string_view kKeys[] = {"golden",      "tags",        "expect",    "time_decimal", "margin",
                                        "condition",   "certificate", "itinerary", "times",        "end",
                                        "time_change", "acceptable",  "comment",   "source_id",    "engine",
                                        "verdict",     "departs",     "expected",  "given"};
  return std::find(std::begin(kKeys), std::end(kKeys), key) != std::end(kKeys);
}

}  // namespace

bool ObstacleRead::read(std::string_view key, json::Value value, const std::string& place) {
  if (key == "lattice") {
    obstacle.lattice = read_index(value, place + "lattice");
    lattice = true;
  } else if (key == "atom") {
    obstacle.atom = read_index(value, place + "atom");
    atom = true;
  } else if (key == "cell") {
    components = read_cell(value, place + "cell", obstacle.cell);
    cell = true;
  } else {
    return false;
  }
  return true;
}

void LineFields::read(std::string_view key, json::Value value, Id& id, const OnUnknownKey& on_unknown_key) {
  if (key == "id") {
    id = read_id(value);
  } else if (key == "from") {
    from = read_from(value, on_unknown_key);
  } else if (key == "scene") {
    scene = read_node(value);
  } else {
    golden |= key == "golden";
    skip(value);
    if (on_unknown_key && !is_beside_query(key)) on_unknown_key(std::string(key));
  }
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
           "and an engine that does not know answers undecided)";
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

}  // namespace lorentz
