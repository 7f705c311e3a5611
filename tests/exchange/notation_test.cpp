// A line means the same in any notation: drawn scenes and queries are written with all the freedom that JSON
// allows, in digits, order and escapes of keys, blanks and line ends, and are read as the same numbers.
#include <catch2/catch.hpp>

#include <charconv>
#include <cstdio>
#include <map>

#include <lorentz/exchange.hpp>
#include "fuzz/families/family.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using test::Draw;

namespace {

enum class Digits { shortest, general, fixed, scientific, hexadecimal, mixed };
constexpr const char* kNames[] = {"shortest", "%.17g", "%.20f", "%.40e", "hexadecimal", "of all kinds"};

template <class Value>
std::string printed(const char* format, Value value) {
  char text[400];  // %.20f writes up to 309 digits before the point
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Reads with correct rounding, whatever the reader under examination does.
bool means(const std::string& text, double value) {
  double read = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), read);
  return end.ec == std::errc() && read == value;
}

// Writes lines of a query stream in a drawn notation.
class FreeWriter {
 public:
  explicit FreeWriter(Draw& draw)
      : draw_(draw),
        digits_(static_cast<Digits>(draw.below(std::size(kNames)))),
        blanks_(draw.one_in(2)),
        shuffles_(draw.one_in(2)),
        escapes_(draw.one_in(4)) {}

  std::string notation() const {
    return std::string("digits ") + kNames[static_cast<int>(digits_)] + (blanks_ ? ", blanks" : "") +
           (shuffles_ ? ", keys in another order" : "") + (escapes_ ? ", escaped keys" : "");
  }

  std::string scene_line(const Scene& scene) {
    std::vector<std::string> lattices;
    for (const Lattice& lattice : scene.lattices) lattices.push_back(text_of(lattice, scene.dimension));
    return end(object({{"scene", object({{"dimension", std::to_string(scene.dimension)},
                                         {"lattices", array(lattices)}})}}));
  }

  std::string query_line(const Query& query, const Components& count) {
    const int dimension = count.of_vectors();
    std::vector<Member> members{
        {"id", "\"one\""}, {"x", text_of(query.x, dimension)}, {"v", text_of(query.v, dimension)}};
    if (query.from) {
      std::vector<std::string> cell;
      for (int i = 0; i < count.of_cells(query.from->lattice); ++i)
        append_integer(cell.emplace_back(), query.from->cell[i]);
      members.push_back({"from", object({{"lattice", std::to_string(query.from->lattice)},
                                         {"atom", std::to_string(query.from->atom)},
                                         {"cell", array(cell)}})});
    }
    return end(object(std::move(members)));
  }

 private:
  struct Member {
    std::string key, value;
  };

  std::string blank() {
    if (!blanks_ || draw_.one_in(2)) return {};
    return draw_.one_in(2) ? " " : "\t ";
  }

  std::string end(std::string text) { return text + (blanks_ ? "\r" : ""); }

  std::string array(const std::vector<std::string>& values) {
    std::string text = "[";
    for (const std::string& value : values) text += (text == "[" ? "" : ",") + blank() + value + blank();
    return text + "]";
  }

  std::string object(std::vector<Member> members) {
    if (shuffles_)
      for (std::size_t i = members.size(); i > 1; --i) std::swap(members[i - 1], members[draw_.below(i)]);
    std::string text = "{";
    for (const Member& member : members)
      text += (text == "{" ? "" : ",") + blank() + key(member.key) + blank() + ":" + blank() + member.value +
              blank();
    return text + "}";
  }

  std::string key(const std::string& name) {
    std::string text = "\"";
    for (const char c : name)
      text += escapes_ && draw_.one_in(4) ? printed("\\u%04x", static_cast<unsigned>(c)) : std::string(1, c);
    return text + "\"";
  }

  std::string text_of(double value) {
    const Digits digits = digits_ == Digits::mixed ? static_cast<Digits>(draw_.below(5)) : digits_;
    std::string text;
    if (digits == Digits::shortest) append_number(text, value);
    if (digits == Digits::general) text = printed("%.17g", value);
    if (digits == Digits::fixed) text = printed("%.20f", value);
    if (digits == Digits::hexadecimal) return printed("\"%a\"", value);
    return means(text, value) ? text : printed("%.40e", value);
  }

  std::string text_of(const Vec& a, int dimension) {
    std::vector<std::string> components;
    for (int i = 0; i < dimension; ++i) components.push_back(text_of(a[i]));
    return array(components);
  }

  std::string text_of(const Lattice& lattice, int dimension) {
    std::vector<std::string> vectors, atoms;
    for (int k = 0; k < lattice.rank_in(dimension); ++k)
      vectors.push_back(text_of(lattice.vectors[k], dimension));
    for (const Atom& atom : lattice.atoms) {
      std::vector<Member> members{{"position", text_of(atom.position, dimension)}};
      std::vector<std::string> axes;
      for (const Vec& axis : atom.semiaxes) axes.push_back(text_of(axis, dimension));
      members.push_back(atom.is_ball() ? Member{"radius", text_of(atom.radius)}
                                       : Member{"semiaxes", array(axes)});
      atoms.push_back(object(std::move(members)));
    }
    return object({{"vectors", array(vectors)}, {"atoms", array(atoms)}});
  }

  Draw& draw_;
  Digits digits_;
  bool blanks_, shuffles_, escapes_;
};

StreamItem read(ExchangeReader& reader, const std::string& line, const Scene* scene) {
  const std::string padded = line + std::string(LineReader::kPadding, ' ');
  StreamItem item;
  reader.read_query_line({std::string_view(padded).substr(0, line.size()), 1, false}, scene, item);
  return item;
}

}  // namespace

TEST_CASE("Scenes and queries are read as the same numbers in any notation", "[exchange][notation]") {
  constexpr std::uint64_t kSeed = 75;
  Draw draw(kSeed);
  ExchangeReader reader;
  std::map<std::string, int> misread, met;
  const auto note = [&](const FreeWriter& writer, const std::string& line, const StreamItem& item) {
    if (++misread[writer.notation()] == 1)
      UNSCOPED_INFO(writer.notation() << ": " << line << '\n' << item.message);
  };
  for (const cases::Target& target : cases::targets())
    for (std::uint64_t index = 0; index < 320; ++index) {
      const cases::Case one = target.make(kSeed, index);
      FreeWriter writer(draw);
      const std::string scene = writer.scene_line(one.scene), query = writer.query_line(one.query, one.scene);
      const StreamItem first = read(reader, scene, nullptr);
      if (first.kind != StreamItem::Kind::scene || first.scene != one.scene) note(writer, scene, first);
      const StreamItem second = read(reader, query, &one.scene);
      if (second.kind != StreamItem::Kind::query || second.query.x != one.query.x ||
          second.query.v != one.query.v || second.query.from != one.query.from)
        note(writer, query, second);
      const auto has = [text = scene + query](const char* part) { return text.find(part) != text.npos; };
      ++met["questions"];
      met["from"] += one.query.from.has_value();
      met["ellipsoids"] += has("\"semiaxes\"");
      met["blanks"] += has("\t ") && has("\r");
      met["escapes"] += has("\\u00");
      met["another order"] += has("\"v\"") && query.find("\"v\"") < query.find("\"x\"");
      met["shortest"] += has("\"position\":[0,");
      met["%.20f"] += has("0.00000000000000000000");
      met["%.40e"] += has("0.0000000000000000000000000000000000000000e+00");
      met["hexadecimal"] += has("\"0x1");
    }
  INFO("seed " << kSeed);
  CHECK(misread.empty());
  for (const auto& [word, number] : met) {
    INFO(word);
    CHECK(number > 1000);  // of 11 840 questions
  }
}
