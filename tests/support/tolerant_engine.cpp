// An engine with one planted fault: it passes over obstacles that the line enters by less than 1e-9 of their
// radii, as programs do that ask `discriminant > 1e-9`. Everything else is exact. For the tests of `lorentz
// judge`, which must say just that. Arguments give it another fault instead:
//   dies N      it dies at its Nth question
//   hangs N     it falls silent there
//   starts N    it takes N ms to start, and has no fault
//   dies-in N   it dies of every question in N dimensions
//   cuts N      it says never of flights longer than N
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <thread>

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

struct Fault {
  std::string what;
  long at = 0;
};

// Faults instead of an answer: the program dies or hangs.
void misbehave(const Fault& fault, long question, const std::optional<Scene>& scene) {
  if (fault.what == "dies-in" && scene && scene->dimension == fault.at) std::_Exit(3);
  if (question != fault.at) return;
  if (fault.what == "dies") std::_Exit(3);
  if (fault.what == "hangs") std::this_thread::sleep_for(std::chrono::hours(1));
}

Answer answer_of(const Fault& fault, const oracle::Oracle& oracle, const oracle::Margins& margins,
                 const Query& query) {
  if (fault.what.empty()) return first_hit(oracle, margins, query);
  const Answer exact = oracle.first_hit(query);
  const bool is_long = exact.time && *exact.time > static_cast<double>(fault.at);
  return fault.what == "cuts" && is_long ? Answer::never() : exact;
}

}  // namespace

int main(int argc, char** argv) {
  const Fault fault = argc > 2 ? Fault{argv[1], std::atol(argv[2])} : Fault{};
  if (fault.what == "starts") std::this_thread::sleep_for(std::chrono::milliseconds(fault.at));
  LineReader lines("-");
  ExchangeReader reader;
  std::optional<Scene> scene;
  std::optional<oracle::Oracle> oracle;
  std::optional<oracle::Margins> margins;
  StreamItem item;
  long questions = 0;
  for (LineReader::Line line; lines.next(line);) {
    reader.read_query_line(line, scene ? &*scene : nullptr, item);
    Answer answer = Answer::error(item.message);
    if (item.kind == StreamItem::Kind::scene) {
      scene = item.scene, oracle.emplace(item.scene), margins.emplace(item.scene);
      continue;
    }
    misbehave(fault, ++questions, scene);
    if (item.kind == StreamItem::Kind::query)
      answer = is_crystal(*scene) ? answer_of(fault, *oracle, *margins, item.query)
                                  : Answer::unsupported_because("does crystals only");
    std::string text;
    append_answer_line(text, item.id, answer, scene ? scene->dimension : 2);
    std::cout << text << std::flush;
  }
}
