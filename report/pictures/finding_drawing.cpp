#include "report/pictures/finding_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "report/pictures/finding_parts.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::pictures {

// ---- colours, clips and frames

std::string paint(Ink fill) {
  return fmt::format("fill=\"{1}\" style=\"fill:var({0},{1})\"", fill.variable, fill.otherwise);
}

std::string paint(Ink fill, Ink stroke, double width) {
  return fmt::format(
      "fill=\"{1}\" stroke=\"{3}\" stroke-width=\"{4}\" style=\"fill:var({0},{1});stroke:var({2},{3})\"",
      fill.variable, fill.otherwise, stroke.variable, stroke.otherwise, width);
}

std::string outline(Ink stroke, double width) {
  return fmt::format("stroke=\"{1}\" stroke-width=\"{2}\" style=\"stroke:var({0},{1})\"", stroke.variable,
                     stroke.otherwise, width);
}

// A nested <svg> cuts off everything beyond it, and needs no id.
void open_clip(Svg& svg, const Panel& panel) {
  svg.raw(
      fmt::format("<svg x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{3:.2f}\" "
                  "viewBox=\"{0:.2f} {1:.2f} {2:.2f} {3:.2f}\" overflow=\"hidden\">\n",
                  panel.left, panel.top, panel.width, panel.height));
}

void frame(Svg& svg, const Panel& panel, const std::string& style) {
  svg.rectangle({panel.left, panel.top}, {panel.right(), panel.bottom()}, "fill=\"none\" " + style);
}

double on_paper(double pixels) {
  constexpr double kFar = 1e5;
  return std::isnan(pixels) ? kFar : std::clamp(pixels, -kFar, kFar);
}

// ---- the sheet

namespace {

constexpr double kWidth = 640, kHeight = 410;
constexpr Panel kFlightPanel{12, 80, 616, 164}, kWholePanel{12, 80, 616, 314},
    kInsetPanel{316, 266, 312, 134}, kSidePanel{196, 284, 112, 116};
constexpr double kLine = 15, kHeadEnds = 85;  // baseline of the line after the head

// Words for an answer, in the unit in which it was given.
std::string words_of(const FindingCase& finding, const Answer& answer) {
  const std::string name =
      finding.names_obstacle(answer) ? finding.name_of(answer.obstacle) : "an obstacle that there is not";
  switch (answer.outcome) {
    case Outcome::hit:
      return (answer.time ? fmt::format("at t = {} it hits ", *answer.time) : "hits ") + name;
    case Outcome::never:
      return "never hits anything";
    case Outcome::inside:
      return "starts inside " + name;
    case Outcome::later:
      return "hits nothing before the time limit";
    case Outcome::undecided:
      return "undecided";
    case Outcome::error:
      return "error: " + answer.message;
  }
  return "";
}

// Splits a text at blanks into lines of at most `most` letters.
std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && line.size() + 1 + word.size() > most) {
      lines.push_back(line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

// A number with two digits.
std::string in_short(double a) {
  const std::string text = fmt::format("{:.2g}", a);
  return a >= 10 && a < 1e5 ? fmt::format("{:g}", std::strtod(text.c_str(), nullptr)) : text;
}

class Sheet {
 public:
  /// `given` and `exact` are in the original unit; `finding` has them in its own.
  Sheet(const FindingCase& finding, const Answer* given, const Answer& exact)
      : case_(finding), given_(given), exact_(exact) {}

  std::string draw() {
    double y = 17;
    add_answer(y, "exact", exact_, kExactInk, outline(kExactInk, 2.6));
    if (given_) add_answer(y += 3, "given", *given_, kGivenInk, outline(kGivenInk, 1.8) + kGivenDashes);
    add_text(y += 5, shortened(case_.words, 400), 82, " font-weight=\"bold\" font-size=\"12\"");
    const double lower = std::max(y - kHeadEnds, 0.0);  // how much lower than with a short text
    svg_.raw(fmt::format("<g transform=\"translate(0,{:.0f})\">\n", lower));
    const bool has_inset = case_.issue != Issue::none;
    const FlightPanel flight = draw_flight(svg_, case_, has_inset ? kFlightPanel : kWholePanel);
    if (has_inset)
      add_details(flight);
    else if (!flight.notes.empty())
      add_text(y = kHeight - 4, flight.notes[0], 100, " font-size=\"11\"");
    svg_.close();
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
        "style=\"max-width:100%;height:auto\" role=\"img\" aria-label=\"{2}\" "
        "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\">\n"
        "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" {3}/>\n{4}</svg>\n",
        kWidth, kHeight + lower, xml_escaped(label()), paint(kPaper), svg_.body());
  }

 private:
  // Adds an answer's text, and a sample of its line in the picture. Cells may have very large numbers.
  void add_answer(double& y, const char* who, const Answer& answer, Ink ink, const std::string& style) {
    constexpr std::size_t kLetters = 86, kMost = 5 * kLetters;
    const std::string words = fmt::format("{}: {}", who, words_of(case_, answer));
    open_hint(svg_, words);
    svg_.polyline({{12, y - 4}, {42, y - 4}}, style);
    for (const std::string& line : wrapped(shortened(words, kMost), kLetters)) {
      svg_.text({50, y}, shortened(line, kLetters), paint(ink) + " font-size=\"12\"");
      y += kLine;
    }
    svg_.close();
  }

  void add_text(double& y, const std::string& text, std::size_t letters, const std::string& style) {
    for (const std::string& line : wrapped(text, letters)) {
      svg_.text({12, y}, shortened(line, letters), paint(kInk) + style);
      y += kLine;
    }
  }

  // Adds the parts below the flight.
  void add_details(const FlightPanel& flight) {
    const bool in_space = case_.scene.dimension == 3;
    double y = kInsetPanel.top + 8;
    const std::size_t letters = in_space ? 28 : 46;
    add_text(y, case_.margin, letters, " font-size=\"11\"");
    for (const std::string& note : flight.notes) add_text(y, note, letters, " font-size=\"11\"");
    if (in_space) draw_side_view(svg_, case_, kSidePanel);
    add_inset(flight);
  }

  // Adds the inset, and a square around the part that it shows.
  void add_inset(const FlightPanel& flight) {
    if (flight.at) {
      const Point at = *flight.at;
      const Panel seen{at.x - 6, at.y - 6, 12, 12};
      frame(svg_, seen, outline(kInk, 1.2));
      svg_.polyline({{seen.left, seen.bottom()}, {kInsetPanel.left, kInsetPanel.top}},
                    outline(kFaintInk, 0.6));
      svg_.polyline({{seen.right(), seen.bottom()}, {kInsetPanel.right(), kInsetPanel.top}},
                    outline(kFaintInk, 0.6));
    }
    const double scale = draw_inset(svg_, case_, kInsetPanel);
    const double before = flight.scale / case_.in_radii(1);
    std::string words = fmt::format("magnified {} times", in_short(scale / before));
    if (!case_.atom_of(case_.obstacle).is_ball())
      words += case_.scene.dimension == 2 ? "; coordinates in which the ellipse is a disc"
                                          : "; coordinates in which the ellipsoid is a ball";
    svg_.text({kInsetPanel.right(), kInsetPanel.top - 5}, words,
              paint(kInk, kPaper, 3) + " paint-order=\"stroke\" font-size=\"11\" text-anchor=\"end\"");
  }

  std::string label() const {
    std::string label = "A flight. Exact: " + words_of(case_, exact_) + '.';
    if (given_) label += " Given: " + words_of(case_, *given_) + '.';
    return label + (case_.words.empty() ? "" : ' ' + case_.words + '.');
  }

  const FindingCase& case_;
  const Answer* const given_;
  const Answer& exact_;
  Svg svg_;
};

bool can_be_drawn(const Scene& scene, const Query& query, const Answer& exact) {
  if (flaw_of(scene) || flaw_of(query, scene)) return false;
  return exact.outcome == Outcome::never || names_obstacle(exact, query, scene);
}

// The exponent of the unit of length in which a scene has ordinary size; 0 in most cases. Scenes whose
// lengths are near the ends of binary64's range are drawn in another unit, so that squares and cubes of
// lengths stay in range.
int length_exponent(const Scene& scene) {
  double largest = 0;
  const auto see = [&](const Vec& vector) { largest = std::max(largest, largest_component(vector)); };
  const Lattice& lattice = scene.lattices[0];
  for (const Vec& u : lattice.vectors) see(u);
  if (largest == 0)  // a single obstacle is as large as its scene
    for (const Atom& atom : lattice.atoms)
      for (const Vec& axis : semiaxes_of(atom, scene.dimension)) see(axis);
  constexpr int kOrdinary = 100;
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  return std::abs(exponent) <= kOrdinary ? 0 : exponent;
}

// An answer in other units of length, with v as it is.
std::optional<Answer> in_units(std::optional<Answer> answer, int exponent) {
  if (answer && answer->time) answer->time = std::ldexp(*answer->time, -exponent);
  return answer;
}

}  // namespace

std::string finding_drawing(const Scene& scene, const Query& query, const std::optional<Answer>& given,
                            const Answer& exact, const std::optional<ObstacleId>& decisive,
                            NumberFormat precision) {
  if (!can_be_drawn(scene, query, exact)) return "";
  int exponent = length_exponent(scene);
  Scene its_scene = scaled(scene, -exponent);
  Query its_query{times_power_of_two(query.x, -exponent), query.v, query.from};
  if (scaled(its_scene, exponent) != scene ||
      times_power_of_two(its_query.x, exponent) != query.x)  // rounded
    its_scene = scene, its_query = query, exponent = 0;
  const auto its_given = in_units(given, exponent), its_exact = in_units(exact, exponent);
  const FindingCase finding(its_scene, its_query, its_given ? &*its_given : nullptr, *its_exact, decisive,
                            exponent, precision);
  return Sheet(finding, given ? &*given : nullptr, exact).draw();
}

}  // namespace lorentz::pictures
