#include "pictures/finding_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "pictures/finding_parts.hpp"

namespace lorentz::pictures {
namespace {

constexpr double kWidth = 640, kHeight = 410;
constexpr Panel kFlightPanel{12, 74, 616, 168}, kWholePanel{12, 74, 616, 320},
    kInsetPanel{316, 266, 312, 134}, kSidePanel{196, 284, 112, 116};
constexpr double kLine = 15;

std::string fill_of(Ink ink) {
  return fmt::format("fill:var({},{})", ink.variable, ink.otherwise);
}
std::string stroke_of(Ink ink) {
  return fmt::format("stroke:var({},{})", ink.variable, ink.otherwise);
}

// At most so many characters; what is cut ends in dots. No character of several bytes is cut in two.
std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

std::string words_of(const FindingCase& finding, const Answer& answer) {
  const std::string name =
      finding.names_obstacle(answer) ? finding.name_of(answer.obstacle) : "an obstacle that there is not";
  switch (answer.outcome) {
    case Outcome::hit:
      return answer.time ? fmt::format("hits {} at t = {}", name, *answer.time) : "hits " + name;
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

// At blanks, into lines of at most so many letters.
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

// Two digits of it.
std::string in_short(double a) {
  const std::string text = fmt::format("{:.2g}", a);
  return a >= 10 && a < 1e5 ? fmt::format("{:g}", std::strtod(text.c_str(), nullptr)) : text;
}

class Sheet {
 public:
  explicit Sheet(const FindingCase& finding) : case_(finding) {}
  std::string draw();

 private:
  void add_answer(double y, const char* who, const Answer& answer, Ink ink, const std::string& style);
  void add_text(double& y, const std::string& text, std::size_t letters, const std::string& style);
  void add_details(const FlightPanel& flight);
  void add_inset(const FlightPanel& flight, const Axes& axes);
  std::string label() const;

  const FindingCase& case_;
  Svg svg_;
};

// A line of text, with the line that stands for the answer in the picture.
void Sheet::add_answer(double y, const char* who, const Answer& answer, Ink ink, const std::string& style) {
  const std::string words = fmt::format("{}: {}", who, words_of(case_, answer));
  open_hint(svg_, words);
  svg_.polyline({{12, y - 4}, {42, y - 4}}, style);
  svg_.text({50, y}, shortened(words, 88), paint(ink));
  svg_.close();
}

void Sheet::add_text(double& y, const std::string& text, std::size_t letters, const std::string& style) {
  for (const std::string& line : wrapped(text, letters)) {
    svg_.text({12, y}, shortened(line, letters), paint(kInk) + style);
    y += kLine;
  }
}

// What stands below the flight.
void Sheet::add_details(const FlightPanel& flight) {
  const Axes axes = axes_of(case_);
  const bool in_space = case_.scene.dimension == 3;
  double y = kInsetPanel.top + 8;
  const std::size_t letters = in_space ? 28 : 46;
  add_text(y, case_.margin, letters, " font-size=\"11\"");
  for (const std::string& note : flight.notes) add_text(y, note, letters, " font-size=\"11\"");
  if (in_space) draw_side_view(svg_, case_, axes, kSidePanel);
  add_inset(flight, axes);
}

// The inset, and a square around what it shows.
void Sheet::add_inset(const FlightPanel& flight, const Axes& axes) {
  if (flight.at) {
    const Point at = *flight.at;
    const Panel seen{at.x - 6, at.y - 6, 12, 12};
    frame(svg_, seen, outline(kInk, 1.2));
    svg_.polyline({{seen.left, seen.bottom()}, {kInsetPanel.left, kInsetPanel.top}}, outline(kFaintInk, 0.6));
    svg_.polyline({{seen.right(), seen.bottom()}, {kInsetPanel.right(), kInsetPanel.top}},
                  outline(kFaintInk, 0.6));
  }
  const double scale = draw_inset(svg_, case_, axes, kInsetPanel);
  const double before = flight.scale / case_.in_radii(1);
  std::string words = fmt::format("magnified {} times", in_short(scale / before));
  if (!case_.atom_of(case_.obstacle).is_ball())
    words += case_.scene.dimension == 2 ? "; coordinates in which the ellipse is a disc"
                                        : "; coordinates in which the ellipsoid is a ball";
  svg_.text({kInsetPanel.right(), kInsetPanel.top - 5}, words,
            paint(kInk, kPaper, 3) + " paint-order=\"stroke\" font-size=\"11\" text-anchor=\"end\"");
}

std::string Sheet::label() const {
  std::string label = "A flight. Exact: " + words_of(case_, case_.exact) + '.';
  if (case_.given) label += " Given: " + words_of(case_, *case_.given) + '.';
  return label + (case_.words.empty() ? "" : ' ' + case_.words + '.');
}

std::string Sheet::draw() {
  double y = 17;
  add_answer(y, "exact", case_.exact, kExactInk, outline(kExactInk, 2.6));
  if (case_.given)
    add_answer(y += 18, "given", *case_.given, kGivenInk, outline(kGivenInk, 1.8) + kGivenDashes);
  add_text(y += 20, shortened(case_.words, 170), 88, " font-weight=\"bold\" font-size=\"12\"");
  const bool has_inset = case_.issue != Issue::none;
  const FlightPanel flight = draw_flight(svg_, case_, has_inset ? kFlightPanel : kWholePanel);
  if (has_inset)
    add_details(flight);
  else if (!flight.notes.empty())
    add_text(y = kHeight - 4, flight.notes[0], 100, " font-size=\"11\"");
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "style=\"max-width:100%;height:auto\" role=\"img\" aria-label=\"{2}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\">\n"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" {3}/>\n{4}</svg>\n",
      kWidth, kHeight, xml_escaped(label()), paint(kPaper), svg_.body());
}

}  // namespace

std::string paint(Ink fill) {
  return fmt::format("fill=\"{}\" style=\"{}\"", fill.otherwise, fill_of(fill));
}

std::string paint(Ink fill, Ink stroke, double width) {
  return fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\" style=\"{};{}\"", fill.otherwise,
                     stroke.otherwise, width, fill_of(fill), stroke_of(stroke));
}

std::string outline(Ink stroke, double width) {
  return fmt::format("stroke=\"{}\" stroke-width=\"{}\" style=\"{}\"", stroke.otherwise, width,
                     stroke_of(stroke));
}

// A picture within the picture cuts what is beyond it, and needs no id.
void open_clip(Svg& svg, const Panel& panel) {
  svg.raw(
      fmt::format("<svg x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{3:.2f}\" "
                  "viewBox=\"{0:.2f} {1:.2f} {2:.2f} {3:.2f}\" overflow=\"hidden\">\n",
                  panel.left, panel.top, panel.width, panel.height));
}

void close_clip(Svg& svg) {
  svg.raw("</svg>\n");
}

void frame(Svg& svg, const Panel& panel, const std::string& style) {
  svg.polygon({{panel.left, panel.top},
               {panel.right(), panel.top},
               {panel.right(), panel.bottom()},
               {panel.left, panel.bottom()}},
              "fill=\"none\" " + style);
}

void open_hint(Svg& svg, const std::string& words) {
  svg.raw("<g><title>" + xml_escaped(words) + "</title>\n");
}

double on_paper(double pixels) {
  constexpr double kFar = 1e5;
  return std::isnan(pixels) ? kFar : std::clamp(pixels, -kFar, kFar);
}

Axes axes_of(const FindingCase& finding) {
  const Vec& along = finding.along;
  Vec across{-along[1], along[0], 0};
  if (finding.scene.dimension == 3) {
    // Any at right angles, unless there is an obstacle to choose it by.
    const int smallest =
        static_cast<int>(std::min_element(along.begin(), along.end(),
                                          [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
                         along.begin());
    Vec axis{};
    axis[smallest] = 1;
    across = unit(cross(along, axis));
    if (finding.issue != Issue::none) {
      const Vec centre =
          finding.surroundings.centre(finding.query, place_in_question(finding), finding.obstacle);
      const Vec rest = sum(centre, scaled(along, -dot(centre, along)));
      if (length(rest) > 1e-9 * length(centre)) across = unit(rest);
    }
  }
  return {along, across, cross(along, across)};
}

std::optional<Ink> ink_of(const FindingCase& finding, const ObstacleId& id) {
  if (finding.names_obstacle(finding.exact) && finding.exact.obstacle == id) return kExactInk;
  if (finding.given && finding.names_obstacle(*finding.given) && finding.given->obstacle == id)
    return kGivenInk;
  if (finding.issue != Issue::none && (finding.obstacle == id || finding.second == id)) return kInk;
  return std::nullopt;
}

std::vector<ObstacleId> marked_obstacles(const FindingCase& finding) {
  std::vector<ObstacleId> marked;
  const auto add = [&](const ObstacleId& id) {
    if (std::find(marked.begin(), marked.end(), id) == marked.end()) marked.push_back(id);
  };
  if (finding.issue != Issue::none) add(finding.obstacle);
  if (finding.second) add(*finding.second);
  if (finding.given && finding.names_obstacle(*finding.given)) add(finding.given->obstacle);
  if (finding.names_obstacle(finding.exact)) add(finding.exact.obstacle);
  return marked;
}

std::string hint_of(const FindingCase& finding, const ObstacleId& id) {
  const oracle::Approach approach = finding.margins.approach(finding.query, id);
  const double way =
      finding.surroundings.way(finding.query, oracle::PlaceOnLine::start(), oracle::PlaceOnLine::at(id));
  return fmt::format(
      "{}: the line {} it by {:.6g} of its radii, {:.9g} of length from the start; x lies {} it by {:.6g}",
      finding.name_of(id), approach.gap < 0 ? "meets" : "misses", std::fabs(approach.gap), way,
      approach.start_gap < 0 ? "inside" : "outside of", std::fabs(approach.start_gap));
}

namespace {

bool can_be_drawn(const Scene& scene, const Query& query, const Answer& exact) {
  if (flaw_of(scene) || flaw_of(query, scene)) return false;
  if (exact.outcome == Outcome::never) return true;
  return (exact.outcome == Outcome::hit || exact.outcome == Outcome::inside) &&
         !flaw_of(Query{query.x, query.v, exact.obstacle}, scene);
}

std::string drawing(const Scene& scene, const Query& query, const Answer* given, const Answer& exact) {
  if (!can_be_drawn(scene, query, exact)) return "";
  const FindingCase finding(scene, query, given, exact);
  return Sheet(finding).draw();
}

}  // namespace

std::string finding_drawing(const Scene& scene, const Query& query, const Answer& given,
                            const Answer& exact) {
  return drawing(scene, query, &given, exact);
}

std::string finding_drawing(const Scene& scene, const Query& query, const Answer& exact) {
  return drawing(scene, query, nullptr, exact);
}

}  // namespace lorentz::pictures
