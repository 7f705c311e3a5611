// The cost of the published algorithm's transformation in cells that are not square: families of cells of
// growing stretch, false proposals per hit, wrong answers, and time compared with the reduction engine.
// Prints a Markdown table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "question/examine.hpp"
#include "question/race.hpp"
#include "question/starts/free_starts.hpp"
#include "src/engines/published/published.hpp"

using namespace lorentz;

namespace {

struct Family {
  std::string name;
  int dimension;
  std::array<Vec, 3> vectors;
  double shortest;  ///< shortest lattice vector: radii are relative to it
};

Family rectangle(double s) {
  return {fmt::format("rectangle 1 x {}", s), 2, {Vec{1, 0}, Vec{0, s}}, 1};
}

// The square lattice, described by increasingly oblique vectors.
Family sheared_square(double shear) {
  return {fmt::format("square as (1,0), ({},1)", shear), 2, {Vec{1, 0}, Vec{shear, 1}}, 1};
}

Family oblique(double degrees) {
  const double cot = 1 / std::tan(degrees * 3.14159265358979323846 / 180);
  const double u = cot - std::round(cot);
  return {fmt::format("oblique, {} degrees", degrees),
          2,
          {Vec{1, 0}, Vec{cot, 1}},
          std::min(1.0, std::hypot(u, 1.0))};
}

Family brick(double s) {
  return {fmt::format("brick 1 x 1 x {}", s), 3, {Vec{1, 0}, Vec{0, 1}, Vec{0, 0, s}}, 1};
}

std::vector<Family> families() {
  const double root3 = std::sqrt(3.0), root2 = std::sqrt(2.0);
  return {
      {"square", 2, {Vec{1, 0}, Vec{0, 1}}, 1},
      {"triangular", 2, {Vec{1, 0}, Vec{0.5, root3 / 2}}, 1},
      rectangle(2),
      rectangle(4),
      rectangle(16),
      oblique(40),
      oblique(20),
      oblique(10),
      sheared_square(1),
      sheared_square(2),
      sheared_square(4),
      {"cubic", 3, {Vec{1, 0}, Vec{0, 1}, Vec{0, 0, 1}}, 1},
      {"fcc", 3, {Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}}, 1 / root2},
      {"bcc", 3, {Vec{-0.5, 0.5, 0.5}, Vec{0.5, -0.5, 0.5}, Vec{0.5, 0.5, -0.5}}, root3 / 2},
      brick(2),
      brick(4),
      brick(8),
      {"triclinic", 3, {Vec{1, 0}, Vec{0.3, 1}, Vec{0.2, -0.4, 1.1}}, 1},
      {"cubic as (1,0,0), (1,1,0), (1,1,1)", 3, {Vec{1, 0}, Vec{1, 1}, Vec{1, 1, 1}}, 1},
  };
}

// The stretch sigma_1 / sigma_d of the cell: the ratio of the largest to the smallest singular value, from
// the Gram matrix by Jacobi rotations.
double stretch_of(const Family& family) {
  const int d = family.dimension;
  double g[3][3]{};
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j)
      for (int k = 0; k < d; ++k) g[i][j] += family.vectors[i][k] * family.vectors[j][k];
  for (int sweep = 0; sweep < 50; ++sweep)
    for (int p = 0; p < d; ++p)
      for (int q = p + 1; q < d; ++q) {
        const double angle = 0.5 * std::atan2(2 * g[p][q], g[q][q] - g[p][p]);
        const double c = std::cos(angle), s = std::sin(angle);
        for (int k = 0; k < d; ++k) {
          const double a = g[p][k], b = g[q][k];
          g[p][k] = c * a - s * b, g[q][k] = s * a + c * b;
        }
        for (int k = 0; k < d; ++k) {
          const double a = g[k][p], b = g[k][q];
          g[k][p] = c * a - s * b, g[k][q] = s * a + c * b;
        }
      }
  double low = g[0][0], high = g[0][0];
  for (int i = 1; i < d; ++i) low = std::min(low, g[i][i]), high = std::max(high, g[i][i]);
  return std::sqrt(high / low);
}

// `plain`: the time in the first family of this dimension and radius; 0 if this is the first.
std::string row(const Family& family, double relative_radius, std::size_t count, double& plain) {
  Scene scene = unit_scene(family.dimension, relative_radius * family.shortest);
  scene.lattices[0].vectors = family.vectors;
  const std::string head =
      fmt::format("| {} | {} | {:.2f} |", family.name, relative_radius, stretch_of(family));
  if (const auto why = Published::beyond(scene)) return head + " unsupported | | | | | | |\n";
  const auto place = std::make_shared<question::Place>(scene);
  std::vector<question::Question> questions = question::questions_of(
      place, starts::free_starts(scene, starts::Kind::uniform, starts::kDefaultSeed, count));
  question::answer_exactly(questions);
  const auto engines = question::engines_named({"published", "reduction"});
  std::size_t wrong = 0;
  question::examine(
      question::all_of(questions), *engines[0].answerer({}), oracle::kDefaultUlps,
      [&](const question::Judged& judged) { wrong += judged.judgement.verdict == oracle::Verdict::wrong; });
  const std::vector<question::Speed> speeds = question::race(questions, engines);
  Proposals proposals;
  const Published published(scene);
  std::size_t hits = 0;
  for (const question::Question& one : questions)
    hits +=
        published.first_hit_counted(one.query, std::numeric_limits<double>::infinity(), proposals).outcome ==
        Outcome::hit;
  const double per_hit = 1 / static_cast<double>(std::max<std::size_t>(hits, 1));
  const question::Speed &known = speeds[0], &ours = speeds[1];
  if (plain == 0) plain = known.ns_median;
  const auto time = [](const question::Speed& t) {
    return fmt::format("{:.0f} ({:.0f} to {:.0f})", t.ns_median, t.ns_low, t.ns_high);
  };
  const std::string tricylinder =
      family.dimension == 2
          ? "-"
          : fmt::format("{:.2f}", static_cast<double>(proposals.false_tricylinder) * per_hit);
  return head + fmt::format(" {:.2f} | {} | {} | {} | {} | {:.1f} | {:.1f} |\n",
                            static_cast<double>(proposals.false_ellipse) * per_hit, tricylinder, wrong,
                            time(known), time(ours), known.ns_median / plain,
                            known.ns_median / ours.ns_median);
}

}  // namespace

int main() {
  fmt::print(
      "| cell | r / shortest | stretch | false ellipse | false tricylinder | wrong | published, ns | "
      "reduction, ns | "
      "published / in the unit cell | published / reduction |\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::map<std::pair<int, double>, double> plain;
  for (const Family& family : families())
    for (const double radius : family.dimension == 2 ? std::vector{0.01, 0.001} : std::vector{0.05})
      fmt::print("{}", row(family, radius, family.dimension == 2 ? 10'000 : 4000,
                           plain[{family.dimension, radius}]));
}
