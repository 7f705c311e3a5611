#include "python/lines.hpp"

#include <type_traits>

#include "question/introduction.hpp"

namespace lorentz::python {
namespace {

// The item of this kind in a line, read by `read`.
template <class Item, class TheScene>
Item item_in(const std::string& text, StreamItem::Kind wanted,
             void (ExchangeReader::*read)(const LineReader::Line&, const TheScene*, Item&),
             const std::type_identity_t<TheScene>* scene = nullptr) {
  Item item;
  ExchangeReader reader;
  reader.on_unknown_key(refuse_key);
  LineReader lines(text, "");
  LineReader::Line line;
  lines.next(line);
  (reader.*read)(line, scene, item);
  if (item.kind == wanted) return item;
  throw InputError(item.kind == StreamItem::Kind::bad  ? item.message
                   : wanted == StreamItem::Kind::scene ? "is not a scene"
                                                       : "is not a query");
}

}  // namespace

void refuse_key(const std::string& key) {
  throw InputError("the key " + json_quoted(key) + " is not known");
}

Scene read_scene(const std::string& text) {
  return item_in(text, StreamItem::Kind::scene, &ExchangeReader::read_query_line).scene;
}

RationalScene read_rational_scene(const std::string& text) {
  return item_in(text, StreamItem::Kind::scene, &ExchangeReader::read_start_line).scene;
}

Query read_query(const std::string& text, const Scene& scene) {
  return item_in(text, StreamItem::Kind::query, &ExchangeReader::read_query_line, &scene).query;
}

Start read_start(const std::string& text, const RationalScene& scene) {
  return item_in(text, StreamItem::Kind::query, &ExchangeReader::read_start_line, &scene).start;
}

Answer read_answer(const std::string& text, const Components& count) {
  Answer answer;
  Id id;
  std::size_t components = 0;
  ExchangeReader reader;
  reader.on_unknown_key(refuse_key);
  LineReader lines(text, "");
  LineReader::Line line;
  lines.next(line);
  if (!reader.read_answer_line(line, id, answer, components)) throw InputError("is not an answer");
  const bool names_one = answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
  const int needed = count.of_cells(answer.obstacle.lattice);
  // Columns have one coordinate per dimension; surplus ones are zero.
  bool fits = components == static_cast<std::size_t>(count.of_vectors());
  for (int i = needed; i < count.of_vectors(); ++i) fits &= answer.obstacle.cell[i] == Integer(0);
  if (names_one && !fits && components != static_cast<std::size_t>(needed))
    throw InputError("cell: has " + std::to_string(components) + " coordinates, the lattice has " +
                     std::to_string(needed) + " vectors");
  return answer;
}

Claim claim_of(const std::string& line) {
  std::optional<question::Introduction> said;
  try {
    said = question::introduction_in(line);
  } catch (const InputError& error) {  // the rest was checked in Python
    throw InputError("domain: " + std::string(error.what()));
  }
  return {said->precision.value_or(NumberFormat::binary64), said->time_tolerance,
          said->inside.value_or(StartInside::inside), said->domain.value_or(Domain())};
}

std::string answer_text(const Answer& answer, const Components& count) {
  std::string line;
  append_answer_line(line, "null", answer, count);
  return line;
}

}  // namespace lorentz::python
