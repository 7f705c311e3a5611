// An engine with one planted fault: it passes over obstacles that the line enters by less than 1e-9 of their
// radii, as programs do that ask `discriminant > 1e-9`. Everything else is exact. For the tests of `lorentz
// judge`, which must say just that.
#include <cstdio>
#include <iostream>
#include <optional>
#include <string>

#include <lorentz/exchange.hpp>
#include <lorentz/margin.hpp>
#include <lorentz/oracle.hpp>

namespace {

using namespace lorentz;

constexpr double kTolerance = 1e-9;

// Obstacles that are hardly entered are left as if the particle came from them: one at a time, so that after
// a second one in a row it does not know.
Answer first_hit(const oracle::Oracle& oracle, const oracle::Margins& margins, const Query& query) {
  const Answer exact = oracle.first_hit(query);
  if (exact.outcome != Outcome::hit || margins.approach(query, exact.obstacle).gap < -kTolerance)
    return exact;
  if (query.from) return Answer::undecided();
  const Answer next = oracle.first_hit({query.x, query.v, exact.obstacle});
  const bool hardly =
      next.outcome == Outcome::hit && margins.approach(query, next.obstacle).gap >= -kTolerance;
  return hardly ? Answer::undecided() : next;
}

}  // namespace

int main() {
  LineReader lines("-");
  ExchangeReader reader;
  std::optional<Scene> scene;
  std::optional<oracle::Oracle> oracle;
  std::optional<oracle::Margins> margins;
  StreamItem item;
  for (LineReader::Line line; lines.next(line);) {
    reader.read_query_line(line, scene ? &*scene : nullptr, item);
    Answer answer = Answer::error(item.message);
    if (item.kind == StreamItem::Kind::scene) {
      scene = item.scene, oracle.emplace(item.scene), margins.emplace(item.scene);
      continue;
    }
    if (item.kind == StreamItem::Kind::query) answer = first_hit(*oracle, *margins, item.query);
    std::string text;
    append_answer_line(text, item.id, answer, scene ? scene->dimension : 2);
    std::cout << text << std::flush;
  }
}
