#include "fuzz/campaign/finding.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <lorentz/errors.hpp>
#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_write.hpp"

namespace lorentz::fuzz {
namespace {

constexpr double kFar = 1e6, kExtreme = 1e100;

// The kinds of findings in the order of rank_of().
constexpr Kind kInOrder[] = {Kind::wrong, Kind::wrong_time, Kind::error, Kind::undecided};

std::string outcomes_of(const Examined& examined) {
  return std::string(name_of(examined.given.outcome)) + " for " +
         std::string(name_of(examined.exact.outcome));
}

std::string dimension_of(const Scene& scene) {
  return scene.dimension == 2 ? ", 2D" : ", 3D";
}

std::string model_of(const Scene& scene) {
  bool ellipsoids = false;
  for_each_atom(scene, [&](const Atom& atom) { ellipsoids |= !atom.is_ball(); });
  std::string model = scene.lattices.size() > 1            ? ", several lattices"
                      : scene.lattices[0].atoms.size() > 1 ? ", several atoms"
                      : is_unit_scene(scene)               ? ", unit lattice"
                                                           : ", lattice";
  return model + (ellipsoids ? " of ellipsoids" : "");
}

bool is_extreme(double x) {
  return x != 0 && (std::fabs(x) > kExtreme || std::fabs(x) < 1 / kExtreme);
}

std::string features_of(const Scene& scene, const Query& query) {
  int zeros = 0;
  bool extreme = false, far = false;
  for (int i = 0; i < scene.dimension; ++i) {
    zeros += query.v[i] == 0;
    extreme |=
        is_extreme(query.v[i]) || is_extreme(query.x[i]) || is_extreme(scene.lattices[0].vectors[i][i]);
    const Vec& u = scene.lattices[0].vectors[0];
    far |= std::fabs(query.x[i]) > kFar * std::hypot(u[0], u[1], u[2]);
  }
  std::string text;
  if (query.from) text += ", leaving";
  if (zeros == scene.dimension - 1)
    text += ", along an axis";
  else if (zeros > 0)
    text += ", in a plane of axes";
  if (far) text += ", far start";
  if (extreme) text += ", extreme numbers";
  return text;
}

// Reads a line that text_of() wrote.
StreamItem read_stored(const std::string& line, const Scene* scene) {
  static thread_local ExchangeReader reader;
  const std::string padded = line + std::string(LineReader::kPadding, ' ');
  StreamItem item;
  reader.read_query_line({std::string_view(padded).substr(0, line.size()), 1, false}, scene, item);
  if (item.kind != (scene ? StreamItem::Kind::query : StreamItem::Kind::scene))
    throw FileError("the store holds an invalid line: " + line);
  return item;
}

Answer read_answer(const std::string& line) {
  static thread_local ExchangeReader reader;
  const std::string padded = line + std::string(LineReader::kPadding, ' ');
  Id id;
  Answer answer;
  std::size_t components;
  try {
    reader.read_answer_line({std::string_view(padded).substr(0, line.size()), 1, false}, id, answer,
                            components);
  } catch (const InputError&) {
    throw FileError("the store holds an invalid answer: " + line);
  }
  return answer;
}

// The answer as a line that can be read back. It leaves out a time that is NaN or minus infinity.
std::string answer_text(const std::string& id, Answer answer, const Scene& scene) {
  if (!(answer.time.value_or(0) > -HUGE_VAL)) answer.time.reset();
  std::string line;
  append_answer_line(line, id, answer, scene);
  line.pop_back();
  return line;
}

}  // namespace

CaseText text_of(const std::string& id, const Scene& scene, const Query& query, const Examined& examined) {
  const std::string quoted = json_quoted(id);
  std::string query_line;
  append_query_line(query_line, quoted, query, scene);
  query_line.pop_back();  // the line end
  return {scene_line(scene),
          std::move(query_line),
          answer_text(quoted, examined.given, scene),
          answer_text(quoted, examined.exact, scene),
          examined.departs,
          {}};
}

ReadCase case_in(const CaseText& text) {
  ReadCase one;
  one.scene = read_stored(text.scene, nullptr).scene;
  one.query = read_stored(text.query, &one.scene).query;
  one.given = read_answer(text.given);
  one.exact = read_answer(text.exact);
  return one;
}

int rank_of(std::string_view kind) {
  const auto found = std::find_if(std::begin(kInOrder), std::end(kInOrder),
                                  [&](Kind one) { return name_of(one).words == kind; });
  return static_cast<int>(found - kInOrder);
}

std::string sort_of(const Scene& scene, const Query& query, const Examined& examined) {
  return std::string(name_of(examined.kind).words) + dimension_of(scene) + ", " + outcomes_of(examined) +
         (query.from ? ", leaving" : "");
}

std::string cause_of(const Scene& scene, const Query& query, const Examined& examined) {
  std::string text(name_of(examined.kind).words);
  const Answer &given = examined.given, &exact = examined.exact;
  if (examined.kind == Kind::wrong && given.outcome == Outcome::hit && exact.outcome == Outcome::hit)
    text += !given.time                 ? ", another obstacle"
            : *given.time < *exact.time ? ", an obstacle that is missed"
                                        : ", an obstacle passed over";
  else if (examined.kind == Kind::wrong || examined.kind == Kind::undecided)
    text += ", " + outcomes_of(examined);
  return text + dimension_of(scene) + model_of(scene) + features_of(scene, query);
}

}  // namespace lorentz::fuzz
