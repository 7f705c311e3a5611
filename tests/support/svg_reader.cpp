#include "tests/support/svg_reader.hpp"

#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace lorentz::test {
namespace {

using Tree = boost::property_tree::ptree;

std::vector<double> numbers_in(const std::string& text) {
  static const std::regex kNumber(R"(-?[0-9.]+)");
  std::vector<double> numbers;
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it)
    numbers.push_back(std::stod(it->str()));
  return numbers;
}

// p -> M p + at
struct Transform {
  double xx = 1, xy = 0, yx = 0, yy = 1;
  Spot at;

  Spot turned(Spot p) const { return {xx * p.x + xy * p.y, yx * p.x + yy * p.y}; }
  Spot operator()(Spot p) const { return {turned(p).x + at.x, turned(p).y + at.y}; }
  Transform then(const Transform& inner) const {
    const Spot a = turned({inner.xx, inner.yx}), b = turned({inner.xy, inner.yy});
    return {a.x, b.x, a.y, b.y, (*this)(inner.at)};
  }
};

Transform transform_from(const std::string& text) {
  static const std::regex kPart(R"((translate|rotate)\(([^)]*)\))");
  if (!std::regex_replace(std::regex_replace(text, kPart, ""), std::regex(" "), "").empty())
    throw std::runtime_error("unknown transform: " + text);
  Transform all;
  for (std::sregex_iterator it(text.begin(), text.end(), kPart), end; it != end; ++it) {
    const std::vector<double> n = numbers_in((*it)[2]);
    const double angle = n.at(0) * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    all =
        all.then((*it)[1] == "rotate" ? Transform{c, -s, s, c, {}} : Transform{1, 0, 0, 1, {n[0], n.at(1)}});
  }
  return all;
}

// What groups hand down.
struct Around {
  Transform place;
  std::map<std::string, std::string> style;
  std::string hint;
  std::optional<Rectangle> clip;
};

Rectangle rectangle_of(std::map<std::string, std::string>& its) {
  const auto number = [&](const char* name) { return its.count(name) ? std::stod(its[name]) : 0; };
  const Spot low{number("x"), number("y")};
  return {low, {low.x + number("width"), low.y + number("height")}};
}

class Reader {
 public:
  explicit Reader(SvgPicture& picture) : picture_(picture) {}

  void read(const std::string& name, const Tree& tree, Around around) {
    std::map<std::string, std::string> own;
    if (const auto attributes = tree.get_child_optional("<xmlattr>"))
      for (const auto& [key, value] : *attributes) own[key] = value.data();
    for (const auto& [key, value] : own)
      if (key != "transform" && key != "clip-path") around.style[key] = value;
    if (const auto title = tree.get_child_optional("title")) around.hint = title->data();
    if (own.count("transform")) around.place = around.place.then(transform_from(own["transform"]));
    if (own.count("clip-path")) around.clip = clips_.at(own["clip-path"]);
    if (name == "svg") open_svg(own, around);
    if (name == "clipPath") {
      auto rect = attributes_of(tree.get_child("rect"));
      clips_["url(#" + own["id"] + ")"] = rectangle_of(rect);
    } else if (name == "radialGradient") {
      for (const auto& [child, stop] : tree)
        if (child == "stop")
          picture_.shades["url(#" + own["id"] + ")"].push_back(attributes_of(stop)["stop-color"]);
    } else if (name == "svg" || name == "g" || name == "defs") {
      for (const auto& [child, below] : tree)
        if (child != "<xmlattr>" && child != "title") read(child, below, around);
    } else {
      add_ink(name, tree, own, around);
    }
  }

 private:
  static std::map<std::string, std::string> attributes_of(const Tree& tree) {
    std::map<std::string, std::string> its;
    for (const auto& [key, value] : tree.get_child("<xmlattr>")) its[key] = value.data();
    return its;
  }

  // The page, or a picture within it, which cuts and does not move.
  void open_svg(std::map<std::string, std::string>& own, Around& around) {
    const std::vector<double> box = numbers_in(own["viewBox"]);
    const Rectangle seen{{box.at(0), box.at(1)}, {box[0] + box.at(2), box[1] + box.at(3)}};
    for (const char* key : {"x", "y", "width", "height"}) around.style.erase(key);
    if (is_open_) {
      const Rectangle place = rectangle_of(own);
      if (distance(place.low, seen.low) + distance(place.high, seen.high) > 1e-6)
        throw std::runtime_error("a picture within the picture is scaled");
      around.clip = {around.place(seen.low), around.place(seen.high)};
    } else {
      picture_.page = seen;
      picture_.title = around.hint.empty() ? own["aria-label"] : around.hint;
      around.hint.clear();
    }
    is_open_ = true;
  }

  void add_ink(const std::string& name, const Tree& tree, std::map<std::string, std::string>& own,
               const Around& around) {
    Ink ink;
    ink.style = around.style;
    ink.hint = around.hint;
    ink.clip = around.clip;
    const Transform& place = around.place;
    const auto number = [&](const char* key) { return own.count(key) ? std::stod(own[key]) : 0; };
    if (name == "circle" || name == "ellipse") {
      ink.kind = "ellipse";
      ink.centre = place({number("cx"), number("cy")});
      const double rx = number(name == "circle" ? "r" : "rx"), ry = number(name == "circle" ? "r" : "ry");
      const Spot a = place.turned({rx, 0}), b = place.turned({0, ry});
      ink.oval = {a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y};
    } else if (name == "polyline" || name == "polygon") {
      ink.kind = name == "polyline" ? "line" : name;
      const std::vector<double> n = numbers_in(own["points"]);
      for (std::size_t i = 0; i + 1 < n.size(); i += 2) ink.points.push_back(place({n[i], n[i + 1]}));
    } else if (name == "rect") {
      ink.kind = "polygon";
      const Rectangle r = rectangle_of(own);
      ink.points = {place(r.low), place({r.high.x, r.low.y}), place(r.high), place({r.low.x, r.high.y})};
    } else if (name == "text") {
      ink.kind = "text";
      ink.words = tree.data();
      ink.centre = place({number("x"), number("y")});
      ink.direction = place.turned({1, 0});
    } else {
      throw std::runtime_error("unknown element: " + name);
    }
    picture_.inks.push_back(std::move(ink));
  }

  SvgPicture& picture_;
  std::map<std::string, Rectangle> clips_;
  bool is_open_ = false;
};

}  // namespace

double distance(Spot a, Spot b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

bool Rectangle::holds(Spot spot, double slack) const {
  return spot.x >= low.x - slack && spot.x <= high.x + slack && spot.y >= low.y - slack &&
         spot.y <= high.y + slack;
}

bool Ink::is(const std::string& attribute, const std::string& value) const {
  return (*this)[attribute] == value;
}

std::string Ink::operator[](const std::string& attribute) const {
  const auto it = style.find(attribute);
  return it == style.end() ? "" : it->second;
}

double Ink::number(const std::string& attribute) const {
  return std::stod(style.at(attribute));
}

double Ink::radius() const {
  const bool round = kind == "ellipse" && std::fabs(oval.xx - oval.yy) + std::fabs(oval.xy) < 1e-9 * oval.xx;
  return round ? std::sqrt(oval.xx) : -1;
}

SvgPicture::SvgPicture(const std::string& svg) {
  std::istringstream in(svg);
  Tree tree;
  boost::property_tree::read_xml(in, tree);
  Reader(*this).read("svg", tree.get_child("svg"), {});
}

Inks SvgPicture::all(const std::string& kind, const std::function<bool(const Ink&)>& which) const {
  Inks some;
  for (const Ink& ink : inks)
    if (ink.kind == kind && (!which || which(ink))) some.push_back(ink);
  return some;
}

Inks SvgPicture::all(const std::string& kind, const std::string& attribute, const std::string& value) const {
  return all(kind, [&](const Ink& ink) { return ink.is(attribute, value); });
}

Ink SvgPicture::text(const std::string& words) const {
  const Inks found = all("text", [&](const Ink& ink) { return ink.words == words; });
  if (found.size() != 1) throw std::runtime_error(std::to_string(found.size()) + " texts: " + words);
  return found[0];
}

bool SvgPicture::says(const std::string& part) const {
  return !all("text", [&](const Ink& ink) { return ink.words.find(part) != std::string::npos; }).empty();
}

Ink SvgPicture::mark_of(const std::string& words) const {
  text(words);
  for (std::size_t i = 1; i < inks.size(); ++i)
    if (inks[i].kind == "text" && inks[i].words == words) return inks[i - 1];
  throw std::runtime_error("no mark: " + words);
}

std::string SvgPicture::beyond_page() const {
  for (const Ink& ink : inks) {
    std::vector<Spot> reach = ink.points;
    if (ink.clip)
      reach = {ink.clip->low, ink.clip->high};
    else if (ink.kind == "text")
      reach = {ink.centre};
    else if (ink.kind == "ellipse")
      for (const int side : {-1, 1})
        reach.push_back(
            {ink.centre.x + side * std::sqrt(ink.oval.xx), ink.centre.y + side * std::sqrt(ink.oval.yy)});
    for (const Spot spot : reach)
      if (!page.holds(spot, 0.01))
        return ink.kind + ' ' + ink.words + " at " + std::to_string(spot.x) + ", " + std::to_string(spot.y);
  }
  return "";
}

}  // namespace lorentz::test
