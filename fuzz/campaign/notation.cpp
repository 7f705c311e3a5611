#include "fuzz/campaign/notation.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string_view>
#include <vector>

#include <lorentz/exchange.hpp>

namespace lorentz::fuzz {

using namespace cases;

namespace {

enum class DigitsOfNumber { shortest, general, fixed, scientific, hexadecimal, mixed };
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

// Writes JSON with all the freedom that JSON allows.
class FreeJsonWriter {
 public:
  explicit FreeJsonWriter(Random& random)
      : random_(random),
        digits_(static_cast<DigitsOfNumber>(random.below(6))),
        blanks_(random.one_in(2)),
        shuffles_(random.one_in(2)),
        escapes_(random.one_in(4)) {}

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
    if (!blanks_ || random_.one_in(2)) return {};
    return random_.one_in(2) ? " " : "\t ";
  }

  std::string end(std::string text) { return text + (blanks_ ? "\r" : ""); }

  std::string array(const std::vector<std::string>& values) {
    std::string text = "[";
    for (const std::string& value : values) text += (text == "[" ? "" : ",") + blank() + value + blank();
    return text + "]";
  }

  std::string object(std::vector<Member> members) {
    if (shuffles_)
      for (std::size_t i = members.size(); i > 1; --i) std::swap(members[i - 1], members[random_.below(i)]);
    std::string text = "{";
    for (const Member& member : members)
      text += (text == "{" ? "" : ",") + blank() + key(member.key) + blank() + ":" + blank() + member.value +
              blank();
    return text + "}";
  }

  std::string key(const std::string& name) {
    std::string text = "\"";
    for (const char c : name)
      text +=
          escapes_ && random_.one_in(4) ? printed("\\u%04x", static_cast<unsigned>(c)) : std::string(1, c);
    return text + "\"";
  }

  std::string text_of(double value) {
    const DigitsOfNumber digits =
        digits_ == DigitsOfNumber::mixed ? static_cast<DigitsOfNumber>(random_.below(5)) : digits_;
    std::string text;
    if (digits == DigitsOfNumber::shortest) append_number(text, value);
    if (digits == DigitsOfNumber::general) text = printed("%.17g", value);
    if (digits == DigitsOfNumber::fixed) text = printed("%.20f", value);
    if (digits == DigitsOfNumber::hexadecimal) return printed("\"%a\"", value);
    return means(text, value) ? text : printed("%.40e", value);
  }

  std::string text_of(const Vec& a, int dimension) {
    std::vector<std::string> components;
    for (int i = 0; i < dimension; ++i) components.push_back(text_of(a[i]));
    return array(components);
  }

  std::string text_of(const Lattice& lattice, int dimension) {
    std::vector<std::string> vectors, atoms;
    for (int k = 0; k < lattice.rank(dimension); ++k)
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

  Random& random_;
  DigitsOfNumber digits_;
  bool blanks_, shuffles_, escapes_;
};

}  // namespace

StreamItem read_line(const std::string& line, const Scene* scene) {
  static thread_local ExchangeReader reader;
  const std::string padded = line + std::string(LineReader::kPadding, ' ');
  StreamItem item;
  reader.read_query_line({std::string_view(padded).substr(0, line.size()), 1, false}, scene, item);
  return item;
}

std::optional<Misreading> misreading(Random& random, const Scene& scene, const Query& query,
                                     const ReadLine& read) {
  FreeJsonWriter writer(random);
  const std::string scene_line = writer.scene_line(scene), query_line = writer.query_line(query, scene);
  const StreamItem first = read(scene_line, nullptr);
  if (first.kind != StreamItem::Kind::scene || first.scene != scene)
    return Misreading{writer.notation(), scene_line};
  const StreamItem second = read(query_line, &scene);
  if (second.kind != StreamItem::Kind::query || second.query.x != query.x || second.query.v != query.v ||
      second.query.from != query.from)
    return Misreading{writer.notation(), query_line};
  return std::nullopt;
}

}  // namespace lorentz::fuzz
