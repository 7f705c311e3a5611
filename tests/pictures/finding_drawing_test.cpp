// Drawings of findings: what the inset measures against numbers known by hand, places that binary64 cannot
// hold, and that whatever is asked the drawing is one.
#include "report/pictures/finding_drawing.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>
#include <regex>
#include <set>

#include <lorentz/surroundings.hpp>
#include "judge/golden/reader.hpp"
#include "report/pictures/finding_parts.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::pictures;
using oracle::PlaceOnLine;
using oracle::Surroundings;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

ObstacleId cell(std::int64_t x, std::int64_t y, std::int64_t z = 0) {
  return {0, 0, {x, y, z}};
}

// What is wrong with this as XML, of the sort that drawings are: elements, attributes in double quotes, the
// five entities.
std::string xml_flaw(const std::string& xml) {
  static const std::regex kTag(R"re(<(/?)([a-z]+)((?: [A-Za-z-]+="[^"<]*")*) *(/?)>)re"),
      kAttribute(R"re( ([A-Za-z-]+)="([^"]*)")re"), kLoose(R"re(&(?!(amp|lt|gt|quot);))re");
  std::vector<std::string> open;
  std::size_t at = 0, roots = 0;
  for (std::smatch tag; at < xml.size();) {
    const std::size_t next = std::min(xml.find('<', at), xml.size());
    const std::string text = xml.substr(at, next - at);
    if (contains(text, ">") || std::regex_search(text, kLoose)) return "text: " + text;
    if (next == xml.size()) break;
    const std::size_t end = std::min(xml.find('>', next), xml.size() - 1) + 1;
    const std::string whole = xml.substr(next, end - next);
    if (!std::regex_match(whole, tag, kTag) || std::regex_search(whole, kLoose)) return "tag: " + whole;
    std::set<std::string> names;
    const std::string attributes = tag[3];
    for (std::sregex_iterator it(attributes.begin(), attributes.end(), kAttribute), last; it != last; ++it)
      if (!names.insert((*it)[1]).second) return "twice: " + whole;
    if (tag[1].length() == 0) {
      roots += open.empty();
      if (tag[4].length() == 0) open.push_back(tag[2]);
    } else {
      if (open.empty() || open.back() != tag[2]) return "closes what is not open: " + whole;
      open.pop_back();
    }
    at = end;
  }
  return !open.empty() ? "not closed: " + open.back() : roots == 1 ? "" : "not one root";
}

// A coordinate that is not a number, or one beyond any paper.
std::string coordinate_flaw(const std::string& svg) {
  static const std::regex kPlace(
      R"re( (?:x|y|cx|cy|r|rx|ry|width|height|points|transform|viewBox)="([^"]*)")re");
  static const std::regex kBad(R"re([a-z]*nan|inf|[0-9]{6}|e[+-])re");
  for (std::sregex_iterator it(svg.begin(), svg.end(), kPlace), end; it != end; ++it) {
    const std::string value = (*it)[1];
    if (std::regex_search(value, kBad)) return value;
  }
  return "";
}

// The two ends of what the inset measures: its dots are the only ones of this size.
std::vector<std::array<double, 2>> measured(const std::string& svg) {
  static const std::regex kDot(R"re(<circle cx="([0-9.-]+)" cy="([0-9.-]+)" r="2.20")re");
  std::vector<std::array<double, 2>> ends;
  for (std::sregex_iterator it(svg.begin(), svg.end(), kDot), end; it != end; ++it)
    ends.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return ends;
}

constexpr double kInsetHeight = 134, kInsetWidth = 312;

}  // namespace

TEST_CASE("Surroundings: places that no binary64 holds", "[pictures][finding_drawing][surroundings]") {
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].atoms.push_back({{0x1p-70, 0, 0}, 0.25, {}});
  const Surroundings surroundings(scene);
  // After 2^60 cells, half a cell beside the centres.
  const Query query{{0.5, 0.5}, {2, 0}, {}};
  const PlaceOnLine far = PlaceOnLine::after(0x1p59);
  CHECK(surroundings.centre(query, far, cell((1ll << 60) + 1, 1)) == Vec{0.5, 0.5, 0});
  const auto around = surroundings.around(query, far, 0.75, 100);
  CHECK(around.complete);
  REQUIRE(around.obstacles.size() == 8);
  for (const oracle::Neighbour& one : around.obstacles) {
    CHECK(std::fabs(one.centre[0]) == Approx(0.5));  // of the second atom, give or take 2^-70
    CHECK(std::fabs(one.centre[1]) == 0.5);
  }
  CHECK_FALSE(surroundings.around(query, far, 0.75, 3).complete);
  CHECK(surroundings.way(query, PlaceOnLine::start(), far) == 0x1p60);
  const PlaceOnLine further{std::nullopt, 0x1p59, 0.25};
  CHECK(surroundings.centre(query, further, cell((1ll << 60) + 1, 1)) == Vec{0.25, 0.5, 0});
  const ObstacleId beside = cell((1ll << 60) + 1, 2);  // nearest after 2^60 + 1/2, which is not a binary64
  CHECK(surroundings.centre(query, PlaceOnLine::at(beside), beside) == Vec{0, 1.5, 0});
  // Two entries 2^-70 apart, 2^40 cells away; and one from where the line is nearest to a disc that it
  // misses.
  const Query through{{-0x1p40, 0}, {2, 0}, {}};
  const ObstacleId second{0, 1, {}};
  CHECK(surroundings.way(through, PlaceOnLine::at(cell(0, 0)), PlaceOnLine::at(second)) == 0x1p-70);
  CHECK(surroundings.centre(through, PlaceOnLine::at(cell(0, 0)), cell(0, 0)) == Vec{0.25, 0, 0});
  CHECK(surroundings.way(query, PlaceOnLine::start(), PlaceOnLine::at(cell(-7, 2))) == -7.5);
}

TEST_CASE("Surroundings: an ellipsoid is entered where it is", "[pictures][finding_drawing][surroundings]") {
  Scene scene = unit_scene(3, 0.25);
  scene.lattices[0].atoms[0].semiaxes = {{0.125, 0, 0}, {0.0625, 0.25, 0}, {0, 0, 0.375}};
  const Surroundings surroundings(scene);
  // y = A^-1 p: along x alone through the centre, |y| = 1 at p = 1/8.
  const Query query{{-0.5, 0, 0}, {1, 0, 0}, {}};
  CHECK(surroundings.way(query, PlaceOnLine::start(), PlaceOnLine::at(cell(0, 0))) == 0.375);
}

TEST_CASE("What the inset measures, against numbers by hand", "[pictures][finding_drawing]") {
  // y = r + gap beside a row of discs of radius 1/4: missed by gap / r.
  const double gap = GENERATE(0x1p-32, 0x1p-52);
  const double in_radii = 4 * gap;  // 9.3e-10, 8.9e-16
  const int dimension = GENERATE(2, 3);
  const Scene scene = unit_scene(dimension, 0.25);
  const Query query{{-0.5 - 0x1p30, 0.25 + gap, 0}, {1, 0, 0}, {}};
  const Answer given = Answer::hit(cell(0, 0), 0x1p30 + 0.5), never = Answer::never();
  const FindingCase finding(scene, query, &given, never);
  CHECK(finding.issue == Issue::line);
  CHECK(finding.distance == in_radii);
  const std::string svg = finding_drawing(scene, query, given, never);
  CHECK(xml_flaw(svg) == "");
  CHECK(contains(svg, gap == 0x1p-32 ? ">9.313e-10 radii<" : ">8.882e-16 radii<"));
  const auto ends = measured(svg);
  REQUIRE(ends.size() == 2);
  CHECK(ends[0][0] == ends[1][0]);
  CHECK(std::fabs(ends[0][1] - ends[1][1]) == Approx(0.36 * kInsetHeight).margin(0.02));
  CHECK(contains(svg, " cells</text>"));  // it is broken

  // The same disc, met by as much: the drawing says when, too: sqrt(2 gap) radii before.
  const Query lower{{-0.5, 0.25 - gap, 0}, {1, 0, 0}, {}};
  const Answer hit = Answer::hit(cell(0, 0), 0.5);
  const FindingCase passed_over(scene, lower, &never, hit);
  CHECK(passed_over.issue == Issue::line);
  CHECK(passed_over.distance == -in_radii);
  CHECK(contains(finding_drawing(scene, lower, never, hit),
                 gap == 0x1p-32 ? "the line, 4.32e-05 radii after" : "the line, 4.21e-08 radii after"));
}

TEST_CASE("A gap far below the last bit of every coordinate is drawn", "[pictures][finding_drawing]") {
  // |(1/4, 2^-40)| = 1/4 + 2^-79: 2^-77 radii.
  const std::string svg = finding_drawing(unit_scene(3, 0.25), {{-0.5, 0.25, 0x1p-40}, {1, 0, 0}, {}},
                                          Answer::hit(cell(0, 0), 0.5), Answer::never());
  CHECK(contains(svg, ">6.617e-24 radii<"));
  const auto ends = measured(svg);
  REQUIRE(ends.size() == 2);
  CHECK(std::fabs(ends[0][1] - ends[1][1]) == Approx(0.36 * kInsetHeight).margin(0.02));
}

TEST_CASE("What is in question: start, order, time, the hardest decision", "[pictures][finding_drawing]") {
  Scene scene = unit_scene(2, 0.25);
  const Answer first = Answer::hit(cell(0, 0), 0.25);
  const auto about = [&](const Query& query, const Answer* given, const Answer& exact) {
    const FindingCase finding(scene, query, given, exact);
    return std::pair(finding.issue, finding.distance);
  };
  using Found = std::pair<Issue, double>;
  // x outside by 2^-50 of a radius.
  const Query outside{{-0.25 - 0x1p-52, 0}, {-1, 0}, {}};
  const Answer inside = Answer::inside(cell(0, 0)), left = Answer::hit(cell(-1, 0), 0.5);
  CHECK(about(outside, &inside, left) == Found{Issue::start, 0x1p-50});
  // A time that is late by 2^-52: 2^-50 radii.
  const Query query{{-0.5, 0}, {1, 0}, {}};
  const Answer late = Answer::hit(cell(0, 0), 0.25 + 0x1p-52);
  CHECK(about(query, &late, first) == Found{Issue::time, 0x1p-50});
  const Answer nowhen = Answer::hit(cell(0, 0), kInfinity);
  CHECK(about(query, &nowhen, first).first != Issue::time);
  // Behind the start.
  const Answer behind = Answer::hit(cell(-1, 0), 3);
  CHECK(about(query, &behind, first) == Found{Issue::start, 1});
  // No answer, an undecided one, and one whose obstacle does not exist: the hardest decision.
  const Query low{{-0.5, 0x1.fffffffffffffp-3}, {1, 0}, {}};
  const Answer none = Answer::undecided(), strange = Answer::hit({5, 7, {}}, 1);
  const Answer low_hit = Answer::hit(cell(0, 0), 0.5);
  for (const Answer* given : {static_cast<const Answer*>(nullptr), &none, &strange})
    CHECK(about(low, given, low_hit) == Found{Issue::line, -0x1p-53});
  CHECK(about({{0.5, 0.5}, {1, 0}, {}}, nullptr, Answer::never()).first == Issue::none);
  // What is hardly met, and another one far behind it: no matter of their order.
  const Answer next = Answer::hit(cell(1, 0), 1.5);
  CHECK(about(low, &next, low_hit) == Found{Issue::line, -0x1p-53});
  CHECK_FALSE(FindingCase(scene, low, &next, low_hit).second);
  // Two discs 2^-60 apart on the line: of radius 1/4, entered 2^-58 radii after one another; and at once.
  scene.lattices[0].atoms.push_back({{0x1p-60, 0}, 0.25, {}});
  const Answer second = Answer::hit({0, 1, {}}, 0.25);
  CHECK(about(query, &second, first) == Found{Issue::order, 0x1p-58});
  scene.lattices[0].atoms[1].position[0] = 0;
  CHECK(about(query, &second, first) == Found{Issue::order, 0});
  const std::string svg = finding_drawing(scene, query, second, first);
  CHECK(xml_flaw(svg) == "");
  CHECK(contains(svg, ">at one point<"));
}

TEST_CASE("Two entries, drawn as far apart as they are", "[pictures][finding_drawing]") {
  Scene scene = unit_scene(2, 0.25);
  scene.lattices[0].atoms.push_back({{0x1p-60, 0}, 0.25, {}});
  const std::string svg = finding_drawing(scene, {{-0.5, 0}, {1, 0}, {}}, Answer::hit({0, 1, {}}, 0.25),
                                          Answer::hit(cell(0, 0), 0.25));
  const auto ends = measured(svg);
  REQUIRE(ends.size() == 2);
  CHECK(ends[1][0] - ends[0][0] == Approx(0.36 * kInsetWidth).margin(0.02));
  CHECK(ends[0][1] == ends[1][1]);
}

TEST_CASE("Texts of engines stay texts, no ids, no scripts, nothing from elsewhere",
          "[pictures][finding_drawing]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{-0.5, 0}, {1, 0}, {}};
  const std::string hostile = "</text></svg><script>alert(1)</script>\" onload=\"x' & \x01 \xc3\xa9";
  std::string longer;
  for (int i = 0; i < 40; ++i) longer += "\xc3\xa9\xe2\x82\xac";  // of two and three bytes: cut somewhere
  for (std::size_t begin = 0; begin < 6; ++begin) {
    const std::string message = begin == 5 ? hostile : std::string(begin, 'x') + longer;
    const std::string svg =
        finding_drawing(scene, query, Answer::error(message), Answer::hit(cell(0, 0), 0.25));
    CHECK(xml_flaw(svg) == "");
    CHECK_FALSE(contains(svg, "<script"));
    CHECK_FALSE(contains(svg, " onload=\"x"));
    for (const char* never : {" id=", "url(", "href", "<style", "<foreignObject"})
      CHECK_FALSE(contains(svg, never));
    // Every byte that begins a character of several is followed by the rest.
    for (std::size_t i = 0; i < svg.size(); ++i) {
      const auto byte = static_cast<unsigned char>(svg[i]);
      const int more = byte >= 0xe0 ? 2 : byte >= 0xc0 ? 1 : 0;
      for (int k = 1; k <= more; ++k) REQUIRE((static_cast<unsigned char>(svg[i + k]) & 0xc0) == 0x80);
    }
  }
  CHECK(finding_drawing(scene, {{0, 0}, {0, 0}, {}}, {}, Answer::never()).empty());  // no query
  CHECK(finding_drawing(scene, query, {}, Answer::hit({0, 3, {}}, 1)).empty());
}

TEST_CASE("Cells with long numbers are named in full, and the picture gives way",
          "[pictures][finding_drawing]") {
  const Scene scene = unit_scene(2, 0.25);
  const Query query{{0.5, 0, 0}, {1, 0, 0}, {}};
  ObstacleId far = cell(0, 0);
  far.cell[0] = *Integer::from_decimal("58368498836375891149534003");
  far.cell[1] = *Integer::from_decimal("-19456166278791963716511334");
  const Answer exact = Answer::hit(cell(1, 0), 0.25);
  const std::string plain = finding_drawing(scene, query, Answer::hit(cell(2, 0), 1.25), exact);
  const std::string drawing = finding_drawing(scene, query, Answer::hit(far, 1.9456166278791964e+26), exact);
  CHECK(contains(drawing, ">-19456166278791963716511334)<"));
  CHECK(contains(plain, "viewBox=\"0 0 640 410\""));
  CHECK(contains(plain, "<g transform=\"translate(0,0)\">"));
  CHECK(contains(drawing, "viewBox=\"0 0 640 425\""));
  CHECK(contains(drawing, "<g transform=\"translate(0,15)\">"));
  CHECK(xml_flaw(drawing) == "");
}

TEST_CASE("In any unit of length the drawing is the same", "[pictures][finding_drawing]") {
  const int exponent = GENERATE(900, -900);
  const auto drawn = [](int e) {
    Scene scene = unit_scene(2, std::ldexp(0.25, e));
    for (int k = 0; k < 2; ++k) scene.lattices[0].vectors[k][k] = std::ldexp(1, e);
    const Query query{{std::ldexp(-0.5, e), std::ldexp(0.25 + 0x1p-40, e)}, {1, 0x1p-50}, {}};
    Answer given = Answer::hit(cell(0, 0), 0), exact = Answer::hit(cell(5, 1), 0);
    given.time.reset(), exact.time.reset();
    static const std::regex kHint("<title>[^<]*</title>");
    return std::regex_replace(finding_drawing(scene, query, given, exact), kHint, "");
  };
  const std::string ordinary = drawn(0);
  CHECK(coordinate_flaw(ordinary) == "");
  CHECK(drawn(exponent) == ordinary);
}

namespace {

// Answers that are wrong in all sorts of ways.
std::vector<Answer> others(const Answer& exact, test::Draw& draw) {
  Answer elsewhere = exact, later = exact, far = exact;
  const auto step = static_cast<std::int64_t>(draw.below(3)) - 1;
  if (exact.outcome == Outcome::never) elsewhere = far = Answer::hit(cell(step, 1 - step), 3);
  if (elsewhere.obstacle.cell[0].fits_int64() && std::abs(elsewhere.obstacle.cell[0].int64()) < 1ll << 60)
    elsewhere.obstacle.cell[0] = elsewhere.obstacle.cell[0].int64() + 1 + step;
  far.obstacle.cell[1] = *Integer::from_decimal("-123456789012345678901234567890");
  if (later.time) *later.time = std::nextafter(*later.time, draw.one_in(2) ? kInfinity : 0);
  return {elsewhere, later, far, draw.one_in(2) ? Answer::never() : Answer::undecided()};
}

}  // namespace

TEST_CASE("Golden records are drawn with numbers only", "[pictures][finding_drawing]") {
  constexpr std::uint64_t kSeed = 19;
  test::Draw draw(kSeed);
  std::size_t records = 0, drawings = 0;
  for (const auto& set : std::filesystem::directory_iterator(LORENTZ_SOURCE_DIR "/data/golden")) {
    if (set.path().extension() != ".ndjson") continue;
    golden::Reader reader(set.path());
    for (golden::ReadRecord read; reader.next(read);) {
      if (!read.query || !draw.one_in(100)) continue;
      ++records;
      INFO(set.path() << " " << read.record.id);
      const auto check = [&](const std::string& svg) {
        ++drawings;
        CHECK(coordinate_flaw(svg) == "");
        CHECK(xml_flaw(svg) == "");
      };
      check(finding_drawing(reader.scene(), *read.query, {}, read.record.expect));
      for (const Answer& given : others(read.record.expect, draw))
        check(finding_drawing(reader.scene(), *read.query, given, read.record.expect));
    }
  }
  CHECK(records > 50);
  CHECK(drawings == 5 * records);
}
