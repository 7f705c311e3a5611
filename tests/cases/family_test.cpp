// The families of cases as such: repeatable, in order, without flaws, and marked with the tags that they
// explain.
#include "fuzz/families/family.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <thread>

#include <lorentz/scene_check.hpp>
#include "question/cases/bad_queries.hpp"
#include "question/cases/drawn_flights.hpp"
#include "question/cases/integer_vectors.hpp"
#include "question/cases/ulps.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;
using cases::Case;
using cases::Family;
using cases::Source;

namespace {

constexpr std::uint64_t kSeed = 4;
constexpr std::uint64_t kCount = 2000;

std::string scene_line(const Scene& scene) {
  std::string out;
  append_scene_line(out, scene);
  return out;
}

// Everything that there is to a case, to the bit.
std::string text_of(const Case& one) {
  std::string text = stream(one.scene, one.query);
  for (const std::string& tag : one.tags) text += tag + " ";
  return text;
}

}  // namespace

// Philox4x64-10 written down once more, from the paper: the multipliers, the Weyl keys, ten rounds.
std::array<std::uint64_t, 4> philox(std::array<std::uint64_t, 4> c, std::array<std::uint64_t, 2> key) {
  __extension__ using Wide = unsigned __int128;
  for (int round = 0; round < 10; ++round) {
    const Wide a = Wide{0xd2e7470ee14c6c93} * c[0], b = Wide{0xca5a826395121157} * c[2];
    c = {static_cast<std::uint64_t>(b >> 64) ^ c[1] ^ key[0], static_cast<std::uint64_t>(b),
         static_cast<std::uint64_t>(a >> 64) ^ c[3] ^ key[1], static_cast<std::uint64_t>(a)};
    key = {key[0] + 0x9e3779b97f4a7c15, key[1] + 0xbb67ae8584caa73b};
  }
  return c;
}

TEST_CASE("Random numbers are Philox4x64-10 of (seed, name), (index, use, block)", "[cases][family]") {
  // Random123's own table of known answers.
  CHECK(philox({}, {}) == std::array<std::uint64_t, 4>{0x16554d9eca36314c, 0xdb20fe9d672d0fdc,
                                                       0xd7e772cee186176b, 0x7e68b68aec7ba23b});
  constexpr std::uint64_t kNameA = 0xaf63dc4c8601ec8c;  // FNV-1a of "a"
  cases::Random random(20161115, "a", 7), scenes(20161115, "a", 7, cases::Use::scenes);
  for (const std::uint64_t block : {0, 1, 2})
    for (const std::uint64_t word : philox({7, 0, block, 0}, {20161115, kNameA}))
      CHECK(random.bits() == word);
  CHECK(scenes.bits() == philox({7, 1, 0, 0}, {20161115, kNameA})[0]);
  cases::Random once_more(20161115, "a", 7);
  CHECK(once_more.uniform() == std::ldexp(philox({7, 0, 0, 0}, {20161115, kNameA})[0] >> 11, -53));
}

TEST_CASE("Binary64 values by their order: both zeros are one, and the largest is the end", "[cases][ulps]") {
  constexpr double kTiny = 0x1p-1074, kLargest = std::numeric_limits<double>::max();
  for (const double zero : {0.0, -0.0}) {
    CHECK(cases::moved(zero, 0) == 0);
    CHECK(cases::moved(zero, 3) == 3 * kTiny);
    CHECK(cases::moved(zero, -3) == -3 * kTiny);
    CHECK(cases::middle(zero, 4 * kTiny) == 2 * kTiny);
    CHECK(cases::middle(-4 * kTiny, zero) == -2 * kTiny);
  }
  CHECK(cases::moved(kTiny, -2) == -kTiny);
  CHECK(cases::moved(1, 1) == std::nextafter(1, 2));
  CHECK(cases::moved(-1, 1) == std::nextafter(-1, 0));
  CHECK(cases::moved(kLargest, 1) == kLargest);
  CHECK(cases::moved(-kLargest, -1) == -kLargest);
  const NumberFormat binary32 = NumberFormat::binary32;
  CHECK(cases::moved(0.0, -3, binary32) == -3 * 0x1p-149);
  CHECK(cases::moved(0x1p-149, -2, binary32) == -0x1p-149);
  CHECK(cases::moved(1, 1, binary32) == 1 + 0x1p-23);
  CHECK(cases::moved(1 + 0x1p-40, -1, binary32) == 1 - 0x1p-24);  // rounded first
  CHECK(cases::moved(0x1.fffffep127, 1, binary32) == 0x1.fffffep127);
  CHECK(cases::middle(-4 * 0x1p-149, 0, binary32) == -2 * 0x1p-149);
  CHECK(cases::middle(-1, 1, binary32) == 0);
  CHECK(cases::middle(-1, 1) == 0);
}

TEST_CASE("Drawn integer vectors have integer lengths, no common divisor, and are many", "[cases]") {
  INFO("seed 4");
  cases::Random random(4, "integer vectors", 0);
  std::set<cases::IntVec> triples, quadruples;
  const auto check = [](const cases::Squared& one, std::set<cases::IntVec>& met) {
    const auto& [v, across, w] = one;
    REQUIRE(cases::content_of(v) == 1);
    for (const cases::IntVec& a : {v, across}) REQUIRE(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] == w * w);
    REQUIRE(v[0] * across[0] + v[1] * across[1] + v[2] * across[2] == 0);
    met.insert(v);
  };
  for (int i = 0; i < 500; ++i) {
    check(cases::drawn_triple(random, 9), triples);
    check(cases::drawn_quadruple(random, 3), quadruples);
  }
  CHECK(triples.size() > 20);
  CHECK(quadruples.size() > 100);
}

TEST_CASE("A case depends on seed, family and index: not on the order, the thread, or other families",
          "[cases][family]") {
  INFO("seed 4");
  std::vector<std::pair<const Family*, std::uint64_t>> order;
  std::map<std::pair<const Family*, std::uint64_t>, std::string> first, again;
  for (const Family& family : cases::families())
    for (std::uint64_t index = 0; index < 160; ++index) {
      order.emplace_back(&family, index);
      first[order.back()] = text_of(family.make(kSeed, index));
    }
  std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
  std::thread([&] {
    for (const auto& [family, index] : order) again[{family, index}] = text_of(family->make(kSeed, index));
  }).join();
  long different_seed = 0, different_family = 0;
  for (const auto& [key, text] : first) {
    INFO(key.first->name() << " " << key.second);
    CHECK(again[key] == text);
    different_seed += text_of(key.first->make(kSeed + 1, key.second)) != text;
  }
  const Family &flat = *cases::family_named("grazing"), &other = *cases::family_named("ties");
  for (std::uint64_t index = 0; index < 100; ++index)
    different_family += text_of(flat.make(kSeed, index)) != text_of(other.make(kSeed, index));
  CHECK(different_seed >= static_cast<long>(first.size()) - 20);  // the published examples are what they are
  CHECK(different_family == 100);
}

TEST_CASE("Cases are without flaws, their tags explained, and every explained tag occurs",
          "[cases][family]") {
  const auto precision = GENERATE(NumberFormat::binary64, NumberFormat::binary32);
  INFO("seed 4, " << name_of(precision));
  std::set<std::string_view> names;
  for (const Family& family : cases::families()) {
    INFO(family.name());
    CHECK(names.insert(family.name()).second);
    CHECK(cases::family_named(family.name()) == &family);
    CHECK_FALSE(family.description(precision).empty());
    std::map<std::string_view, long> met;
    for (const cases::Tag& tag : family.tags(precision)) {
      CHECK(met.emplace(tag.name, 0).second);
      CHECK(tag.note.size() > 10);  // 17 seen at least
    }
    std::string last;
    for (std::uint64_t index = 0; index < kCount; ++index) {
      const Case one = family.make(kSeed, index, precision);
      INFO("index " << index << " " << text_of(one));
      const std::string scene = scene_line(one.scene);
      if (scene != last) {
        REQUIRE_FALSE(flaw_of(one.scene));
        REQUIRE_FALSE(oracle::dependence_in(one.scene));
        last = scene;
      }
      REQUIRE_FALSE(flaw_of(one.query, one.scene));
      REQUIRE(consists_of(one.scene, precision));
      REQUIRE(consists_of(one.query, precision));
      if (one.scene.dimension == 2) REQUIRE((one.query.x[2] == 0 && one.query.v[2] == 0));
      for (const std::string& tag : one.tags)  // "tiny-2d"
        if (tag.ends_with("-2d") || tag.ends_with("-3d"))
          REQUIRE(tag[tag.size() - 2] - '0' == one.scene.dimension);
      REQUIRE_FALSE(one.tags.empty());
      REQUIRE(std::set<std::string>(one.tags.begin(), one.tags.end()).size() == one.tags.size());
      for (const std::string& tag : one.tags) {
        REQUIRE(met.contains(tag));
        ++met[tag];
      }
    }
    for (const auto& [tag, count] : met) {
      INFO(tag);
      CHECK(count > 8);  // 11 seen at least
    }
  }
  CHECK(names.size() == 21);
  CHECK(cases::family_named("no such family") == nullptr);
}

// Also of the families of campaigns, which are not among families().
TEST_CASE("In binary32 every target's cases are sound, of such numbers, and the same in any order",
          "[cases][family]") {
  INFO("seed 4");
  constexpr std::uint64_t kFew = 320;
  const NumberFormat precision = NumberFormat::binary32;
  std::vector<std::string> first;
  for (const cases::Target& target : cases::targets())
    for (std::uint64_t index = 0; index < kFew; ++index) {
      const Case one = target.make(kSeed, index, precision);
      INFO(target.name() << " " << index << " " << text_of(one));
      REQUIRE(consists_of(one.scene, precision));
      REQUIRE(consists_of(one.query, precision));
      REQUIRE_FALSE(flaw_of(one.scene));
      REQUIRE_FALSE(oracle::dependence_in(one.scene));
      REQUIRE_FALSE(flaw_of(one.query, one.scene));
      first.push_back(text_of(one));
    }
  for (std::size_t target = cases::targets().size(); target-- > 0;)
    for (std::uint64_t index = kFew; index-- > 0;)
      REQUIRE(text_of(cases::targets()[target].make(kSeed, index, precision)) ==
              first[target * kFew + index]);
}

TEST_CASE("In binary32 a start that rounding puts into an obstacle is drawn again", "[cases][family]") {
  INFO("seed 4");
  // Starts 10^-9 radii outside a disc: rounded, about half of them are inside.
  const auto make = [](Source& source, Case& made) {
    const double r = 0.25;
    const Vec n = source.random.direction(2);
    made = {unit_scene(2, r), {{n[0] * r * (1 + 1e-9), n[1] * r * (1 + 1e-9), 0}, n, {}}, {"skin"}};
  };
  const Family skin("skin-of-a-disc", "a test's", {{"skin", "outside by 10^-9 radii"}}, make);
  const NumberFormat precision = NumberFormat::binary32;
  long rounded_in = 0;
  for (std::uint64_t index = 0; index < 1000; ++index) {
    const Case wide = skin.make(kSeed, index), narrow = skin.make(kSeed, index, precision);
    REQUIRE_FALSE(cases::starts_inside(wide.scene, wide.query));
    rounded_in += cases::starts_inside(rounded(wide.scene, precision), rounded(wide.query, precision));
    INFO(index << " " << text_of(narrow));
    REQUIRE_FALSE(cases::starts_inside(narrow.scene, narrow.query));
  }
  CHECK(rounded_in > 300);
}

TEST_CASE("Cases share a scene in rows of 32, and no query comes twice", "[cases][family]") {
  const auto precision = GENERATE(NumberFormat::binary64, NumberFormat::binary32);
  INFO("seed 4, " << name_of(precision));
  for (const Family& family : cases::families()) {
    INFO(family.name());
    std::set<std::string> scenes, cases;
    for (std::uint64_t index = 0; index < kCount; ++index) {
      const Case one = family.make(kSeed, index, precision);
      if (family.name() == "published-faults" && index < cases::kCasesPerScene) continue;
      if (index % cases::kCasesPerScene == 0) {
        const Case last = family.make(kSeed, index + cases::kCasesPerScene - 1, precision);
        CHECK(scene_line(one.scene) == scene_line(last.scene));
        scenes.insert(scene_line(one.scene));
      }
      cases.insert(stream(one.scene, one.query));
    }
    CHECK(scenes.size() > 20);  // 29 seen at least
    CHECK(cases.size() >= kCount - cases::kCasesPerScene - 2);
  }
}

TEST_CASE("Bad queries are well-formed, each different, and refused by the reader", "[cases][family]") {
  std::set<std::string> texts, used, explained;
  for (const cases::Tag& tag : cases::bad_query_tags()) explained.insert(std::string(tag.name));
  REQUIRE_FALSE(flaw_of(cases::bad_query_scene()));
  ExchangeReader reader;
  const auto read = [&](const std::string& text) {
    LineReader::Line line;
    const std::string padded = "{\"id\":\"a\"," + text + "}" + std::string(LineReader::kPadding, ' ');
    line.text = std::string_view(padded).substr(0, padded.size() - LineReader::kPadding);
    StreamItem item;
    reader.read_query_line(line, &cases::bad_query_scene(), item);
    return item;
  };
  for (const cases::BadQuery& bad : cases::bad_queries()) {
    INFO(bad.tag << ": " << bad.text);
    CHECK(texts.insert(bad.text).second);
    CHECK(explained.contains(bad.tag));
    used.insert(bad.tag);
    const StreamItem item = read(bad.text);
    CHECK(item.kind == StreamItem::Kind::bad);
    CHECK(item.id == "\"a\"");  // the line could be read, the question is what is bad
    CHECK(item.message.find("not JSON") == std::string::npos);
  }
  CHECK(used == explained);
  CHECK(texts.size() > 100);  // 115 seen
  CHECK(read("\"x\":[0.25,0.5],\"v\":[1,0.5],\"from\":{\"lattice\":0,\"atom\":1,\"cell\":[0,\"-7\"]}").kind ==
        StreamItem::Kind::query);
}

namespace {

// FNV-1a of what cases are: their tags, and three digits of each number, which no other libm changes.
std::string digest_of(const cases::Target& target) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](const std::string& text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  };
  const auto add_vec = [&](const Vec& a) { add(fmt::format("{:.3g} {:.3g} {:.3g}\n", a[0], a[1], a[2])); };
  for (std::uint64_t index = 0; index < 4096; index += 8) {
    const Case one = target.make(kSeed, index);
    for (const std::string& tag : one.tags) add(tag + ' ');
    for (const Lattice& lattice : one.scene.lattices) {
      for (int i = 0; i < one.scene.dimension; ++i) add_vec(lattice.vectors[i]);
      for (const Atom& atom : lattice.atoms) {
        add(fmt::format("{:.3g} ", atom.radius));
        add_vec(atom.position);
        for (const Vec& axis : atom.semiaxes) add_vec(axis);
      }
    }
    add_vec(one.query.x);
    add_vec(one.query.v);
    if (one.query.from) add(fmt::format("{} {}\n", one.query.from->lattice, one.query.from->atom));
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace

// Stores name a case by target, seed and index, and campaigns go on with a later version. If you
// change a family knowingly, put the new digest here.
TEST_CASE("The cases of a seed are those that they were, in every target", "[cases][family]") {
  INFO("seed " << kSeed);
  static const std::map<std::string_view, std::string> kDigests = {
      {"generic", "8ae99e9e2b2473dc"},
      {"near-rational", "61fb32cafdab1fdb"},
      {"corridor", "8f42895fe60cd20a"},
      {"tricylinder", "77308d79872175ae"},
      {"grazing", "6c4435b0582dcce0"},
      {"tie", "f2eb2d5df28c9699"},
      {"corner", "17d2acded8f4ba4c"},
      {"boundary", "717732beec271c5f"},
      {"scale", "9d5705b9883b93b4"},
      {"leaving", "0dc31f41d6f67218"},
      {"mixture", "800583f1f3e38d2f"},
      {"rounding", "61e188ebecf35537"},
      {"dense-layers", "0f20cee6dfffced8"},
      {"slender", "3d43271dda8f3814"},
      {"early", "a891026ba737d8d3"},
      {"nearly-parallel", "5e943d59b58fb337"},
      {"ellipsoid-edges", "eb2bdb64f0c92248"},
      {"drift", "92c7e7f52acb4de9"},
      {"vast-ellipsoids", "b842993a8b4648bf"},
      {"nearby", "b15849a0eb3a46ff"},
      {"unequal-radii", "b4434f83b216b476"},
      {"dense-rows", "db6b591d62a47b14"},
      {"far-starts", "81b7b98ecde43c6f"},
      {"skewed-cells", "ca39067304659836"},
      {"specks", "d61a7d2af5c5bcdb"},
      {"skin", "51847bebab244e55"},
      {"sizes", "281ca5506fad8c72"},
      {"large-radius", "a69f1f185c73e4d2"},
      {"tiny-radius", "f957a1dd245d70e6"},
      {"long-flight", "b6800b8167526dc6"},
      {"published-faults", "cdf48708f6dc5640"},
      {"crystals", "832e68cea3b1e769"},
      {"superpositions", "8e862933eeb96b02"},
      {"ellipsoids", "fc82f39fd99c0ebd"},
      {"never", "a514287884d39e74"},
      {"ray-ball", "c11146bd61e9ef9d"},
      {"rows-and-layers", "dbacdd765bdbcbdf"},
  };
  CHECK(kDigests.size() == cases::targets().size());
  for (const cases::Target& target : cases::targets()) {
    const std::string digest = digest_of(target);
    INFO("{\"" << target.name() << "\", \"" << digest << "\"},");
    const auto known = kDigests.find(target.name());
    CHECK((known != kDigests.end() && known->second == digest));
  }
}
