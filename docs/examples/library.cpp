// How to use the library: a scene, the fast engine, `certified`, the oracle, a verdict, and one direction for
// many starts. The tests build and run it, in this tree and against an installed one.
#include <cstdio>
#include <lorentz/certified.hpp>
#include <lorentz/errors.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/reduction.hpp>
#include <lorentz/verdict.hpp>

using namespace lorentz;

namespace {

// Discs of radius 1/4 on the triangular lattice. One vector is rounded to binary64, and the rounded lattice
// is meant.
Scene triangular() {
  Scene scene;
  scene.dimension = 2;
  scene.lattices.push_back({{{{1, 0, 0}, {0.5, 0.8660254037844386, 0}}}, {Atom{{}, 0.25, {}}}});
  return scene;
}

void print(const char* who, const Answer& answer) {
  if (answer.outcome == Outcome::hit)
    std::printf("%-13s hits the disc of cell (%s, %s) at %.17g\n", who,
                answer.obstacle.cell[0].decimal().c_str(), answer.obstacle.cell[1].decimal().c_str(),
                *answer.time);
  else
    std::printf("%-13s %s\n", who, answer.outcome == Outcome::undecided ? "does not know" : "hits nothing");
}

}  // namespace

int main() try {
  const Scene scene = triangular();

  // A flight that grazes the discs of a row or passes them: it comes nearer by 1e-17 per cell.
  Query query;
  query.x = {-3.5, 0.25, 0};
  query.v = {1, -1e-17, 0};

  // The binary64 engine answers `undecided` when it cannot decide.
  const Reduction fast(scene);
  const Answer quick = answer_of(fast.fly(query));
  print("reduction", quick);

  // `certified` asks the oracle in such cases. It is always exact, with the time correctly rounded.
  const oracle::Certified certified(scene);
  const Answer answer = certified.first_hit(query);
  print("certified", answer);

  // The oracle, with the time to 30 digits.
  const oracle::Oracle oracle(scene);
  oracle::Request request;
  request.digits = 30;
  const Answer exact = oracle.first_hit(query, request);
  std::printf("%-13s at %s\n", "oracle", exact.time_decimal.c_str());

  // Is another program's answer right, wrong, or ill-posed, so that no program in binary64 can decide it?
  const oracle::Judge judge(scene);
  Answer other = answer;
  other.obstacle.cell[1] = 1;
  const oracle::Judgement judgement = judge.judge(query, exact, other);
  std::printf("%-13s %s, by %.3g ulps of the inputs\n", "the row above",
              judgement.verdict == oracle::Verdict::wrong ? "is wrong" : "is ill-posed", judgement.departs);

} catch (const InputError& error) {  // an invalid scene or query: the message says where and why
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
