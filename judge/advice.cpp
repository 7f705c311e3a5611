// What to do about a finding: the likely line of code, the remedy, and the document that has more; and the
// domain in which no fault was found.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "judge/findings.hpp"

namespace lorentz::judge {
namespace {

constexpr const char *kFormulas = "docs/ray_and_ball.md#a-ray-and-a-ball",
                     *kRemedies = "docs/ray_and_ball.md#what-to-do",
                     *kLimited = "docs/judging_yours.md#if-your-engine-cannot-do-all-of-this",
                     *kMaxTime = "docs/judging_yours.md#limits",
                     *kInside = "docs/judging_yours.md#starts-inside",
                     *kProgram = "docs/judging_yours.md#a-program-in-any-language",
                     *kScenes = "docs/formats.md#scenes", *kAnswers = "docs/formats.md#answers";

// What several faults have in common.
constexpr const char *kEnds =
                         "the walk ends after a fixed number of cells: answer undecided there, or declare "
                         "it (--domain flight=..N)",
                     *kCancelsFar =
                         "b^2 - a c cancels far from the obstacle: use the projection, p = x - (b / a) v",
                     *kAtEdge =
                         "b^2 - a c cancels at the edge, or a tolerance decides there: compare p.p with "
                         "r^2, p = x - (b / a) v";

// What advice is about: a quantity, a circumstance, a cause, or a cause and a circumstance
// ("cause+circumstance").
struct Advice {
  std::string_view about;
  const char *text, *document;
};

constexpr Advice kAdvice[] = {
    {kDistance, "the formula's root is a length, as if |v| were 1: divide it by |v|", kLimited},
    {kExit, "the larger root is taken: the entry is the smaller one, (-b - sqrt(b^2 - a c)) / a", kFormulas},
    {kNearest, "half the chord is missing: subtract sqrt((r^2 - p.p) / a) from -b / a", kFormulas},
    {kFraction, "the root counts in lengths of the segment: multiply it by max_time", kLimited},

    {"never-for-hit+long-flight", kEnds, kLimited},
    {"never-for-grazing+long-flight", kEnds, kLimited},
    {"later-for-hit+long-flight", kEnds, kLimited},
    {"wrong-time+long-flight", "the time is added up (t += dt): compute it from x, v and the obstacle alone",
     kRemedies},

    {"on-surface",
     "the start is on the surface, where rounding decides the sign of t: decide by (x - c).v < 0 and by from",
     kRemedies},
    {"near-surface",
     "the start is on the surface within rounding, where a sign or a tolerance decides: decide by from",
     kRemedies},
    {"at-once", "a hit at time 0 is lost: take t >= 0 where the line goes inwards, (x - c).v < 0", kRemedies},
    {"short-time", "a least time (t > t_min) drops early hits: leave out the obstacle from by its name",
     kRemedies},
    {"speed-not-1",
     "the formula takes v for a unit vector: divide by v.v, or normalise v and divide t by |v|", kLimited},
    {"x-negative", "the cell of x is truncated, which rounds negative numbers up: use floor", kLimited},
    {"x-outside", "the search does not begin in the cell of x: begin in floor of its coordinates", kLimited},
    {"centre", "the obstacle's centre is left out: replace x by x - c", kFormulas},
    {"from", "the obstacle from is to be left out by its name, and no other one: no tolerance does that",
     kLimited},
    {"leaving", "the obstacle from is to be left out by its name: no tolerance does that", kLimited},
    {"v-zero", "a division by a component of v that is 0: leave this axis out of the walk", kLimited},
    {"v-negative", "where v is negative the walk takes the wrong wall or neighbour of a cell", kLimited},
    {"several-lattices", "take the first hit of all lattices, not of one", kScenes},
    {"several-atoms", "take the first hit of all atoms of a cell, not of one", kScenes},
    {"ellipsoids", "an ellipsoid is a ball in other coordinates: both x and v must be changed to them",
     kScenes},
    {"other-cell", "x and v must be changed to the coordinates of the cell, v without the origin", kScenes},
    {"depth", kAtEdge, kRemedies},
    {"far-obstacle", kCancelsFar, kRemedies},
    {"long-flight-in-radii", kCancelsFar, kRemedies},
    {"long-flight", "positions or times are added up from cell to cell: compute each anew from x and v",
     kLimited},
    {"far-start", "far from the origin x - c is rounded: subtract the cell of x first, which is exact",
     kRemedies},
    {"far-cell",
     "the cell's numbers leave the range of the type, or c is rounded: subtract the cell of x first",
     kRemedies},
    {"high-speed", "v.v overflows: scale v by a power of two first, and the time back", kRemedies},
    {"extreme-speed", "v.v overflows or underflows: scale v by a power of two first, and the time back",
     kRemedies},
    {"short-chord", "steps of a fixed length jump over short chords: compute the entry from x and v",
     kFormulas},
    {"low-speed", "v.v underflows: scale v by a power of two first, and the time back", kRemedies},

    {"passed-over",
     "the walk leaves out cells, or the first hit found is not the first in time: compare all times",
     kLimited},
    {"later-for-hit", "the limit is compared with something else than t: a length, a number of cells",
     kMaxTime},
    {"never-for-hit", "the walk leaves out cells or ends too early, or a root is lost", kLimited},
    {"false-hit", "the discriminant is wrong: check a = v.v, the centre, and r^2", kFormulas},
    {"passed-over-grazing", kAtEdge, kRemedies},
    {"never-for-grazing", kAtEdge, kRemedies},
    {"false-hit-grazing", "b^2 - a c cancels at the edge, or a line that only touches counts (>= for >)",
     kRemedies},
    {"behind", "a negative time counts as a hit: both roots are negative behind the start", kFormulas},
    {"inside-unseen", "|x - c| < r is not asked; if that is on purpose, declare it (--starts-inside)",
     kInside},
    {"inside-not-so", "|x - c| < r is asked with a tolerance, or of the obstacle from", kRemedies},
    {"inside-another", "of several obstacles name the smallest (lattice, atom, cell)", kAnswers},
    {"tie", "of hits at the same time name the smallest obstacle (lattice, atom, cell)", kAnswers},
    {"no-obstacle", "lattices and atoms are numbered from 0", kAnswers},
    {"not-the-time",
     "t solves another equation than |x + t v - c| = r; no distance, exit, closest approach or fraction",
     kFormulas},
    {"wrong-time", "-b - sqrt(b^2 - a c) cancels, or the time is added up: use the projection", kRemedies},
    {"refused", "answer every valid question, or unsupported", kProgram},
    {"no-answer", "answer each question with one line, and flush it", kProgram},
    {"bad-line", "each line must be one answer, as JSON", kAnswers},
    {"answers-nonsense", "an invalid question is answered with the outcome error", kAnswers}};

const Advice* advice_about(std::string_view about) {
  const auto its = std::ranges::find(kAdvice, about, &Advice::about);
  return its == std::end(kAdvice) ? nullptr : its;
}

// ---- Domains

// The widest first, and first those of one quantity.
std::vector<Domain> domains_offered() {
  constexpr int kExponents[] = {30, 10, 6, 3};
  std::vector<Domain> speeds, coordinates, both;
  for (const int exponent : kExponents) {
    const double most = std::pow(10, exponent);
    const Domain::Range speed{std::pow(10, -exponent), most}, coordinate{0, most};
    speeds.emplace_back().speed = speed;
    coordinates.emplace_back().coordinates = coordinate;
    both.emplace_back().speed = speed, both.back().coordinates = coordinate;
  }
  for (const auto& more : {coordinates, both}) speeds.insert(speeds.end(), more.begin(), more.end());
  return speeds;
}

bool is_in(const Domain& domain, const Features& its) {
  return domain.speed.contains(its.speed) && domain.coordinates.contains(its.coordinates);
}

}  // namespace

std::string Finding::why() const {
  const std::string cause(name_of(this->cause())),
      circumstance(this->circumstance ? this->circumstance->name : std::string_view());
  for (const std::string& about : {std::string(quantity), cause + '+' + circumstance, circumstance, cause})
    if (const Advice* its = advice_about(about)) return fmt::format("{} ({})", its->text, its->document);
  return "";
}

std::optional<Domain> Findings::domain_without_fault() const {
  std::vector<Features> wrong;
  for (const auto& [key, finding] : findings_) {
    if (key.first == Severity::ill_posed || key.first == Severity::nonsense) continue;
    if (finding.count > finding.examples.size()) return std::nullopt;
    for (const Example& example : finding.examples)
      if (example.question.is_query()) wrong.push_back(example.features);
  }
  if (wrong.empty() || right_.empty()) return std::nullopt;
  for (const Domain& domain : domains_offered()) {
    const auto has = [&](const Features& its) { return is_in(domain, its); };
    if (std::ranges::none_of(wrong, has) && 2 * std::ranges::count_if(right_, has) >= std::ssize(right_))
      return domain;
  }
  return std::nullopt;
}

}  // namespace lorentz::judge
