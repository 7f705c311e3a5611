#include "question/cases/bad_queries.hpp"

namespace lorentz::cases {
namespace {

constexpr const char* kGood = "[0.25,0.5]";

std::string question(const std::string& x, const std::string& v) {
  return "\"x\":" + x + ",\"v\":" + v;
}

// JSON values that are not numbers, where a number is expected.
const char* const kNoNumbers[] = {"null",    "true",      "false",        "\"\"",     "\"1\"",
                                  "\"NaN\"", "\"nan\"",   "\"inf\"",      "\"-inf\"", "\"Infinity\"",
                                  "\"one\"", "\"1.5.2\"", "\"1,5\"",      "[0]",      "[]",
                                  "[[0]]",   "{}",        "{\"value\":0}"};
const char* const kBadHex[] = {"\"0x\"",       "\"0x1.8q3\"", "\"0x1.8p\"",    "\"0xg\"",       "\"x1.8p0\"",
                               "\"0x1.8p0 \"", "\" 0x1p0\"",  "\"0x1p99999\"", "\"0x1.8.1p0\"", "\"0x1p0x\""};
const char* const kTooLarge[] = {"1e999", "-1e999", "1e309", "1.8e308"};
const char* const kNoVectors[] = {"[]",           "[0.25]",        "[0.25,0.5,0]", "[0.25,0.5,0.75,1]",
                                  "null",         "0.25",          "\"0,0\"",      "{\"0\":1,\"1\":2}",
                                  "[[0.25,0.5]]", "[[0.25],[0.5]]"};
const char* const kNoObstacles[] = {"0",
                                    "\"0\"",
                                    "[]",
                                    "[0,0,[0,0]]",
                                    "true",
                                    "{}",
                                    "{\"lattice\":0}",
                                    "{\"lattice\":0,\"atom\":0}",
                                    "{\"cell\":[0,0]}"};
const char* const kUnknownObstacles[] = {"{\"lattice\":1,\"atom\":0,\"cell\":[0,0]}",
                                         "{\"lattice\":-1,\"atom\":0,\"cell\":[0,0]}",
                                         "{\"lattice\":0,\"atom\":2,\"cell\":[0,0]}",
                                         "{\"lattice\":0,\"atom\":-1,\"cell\":[0,0]}",
                                         "{\"lattice\":0,\"atom\":2147483648,\"cell\":[0,0]}",
                                         "{\"lattice\":4294967296,\"atom\":0,\"cell\":[0,0]}",
                                         "{\"lattice\":0.5,\"atom\":0,\"cell\":[0,0]}",
                                         "{\"lattice\":0,\"atom\":null,\"cell\":[0,0]}",
                                         "{\"lattice\":\"first\",\"atom\":0,\"cell\":[0,0]}"};
const char* const kNoCells[] = {"[]",       "[0]",         "[0,0,0]",   "0",           "null",
                                "[0,0.5]",  "[0,\"0.5\"]", "[0,\"\"]",  "[0,\"1e3\"]", "[0,\"0x10\"]",
                                "[0,null]", "[0,true]",    "[[0],[0]]", "[0,\"-\"]"};

std::vector<BadQuery> all() {
  std::vector<BadQuery> found;
  const auto add = [&](std::string text, const char* tag) { found.push_back({std::move(text), tag}); };
  for (const char* v : {"[0,0]", "[-0.0,0]", "[0e5,-0.0]", "[1e-999,0]", "[\"0x0p0\",0]"})
    add(question(kGood, v), "v-zero");
  add("\"v\":[1,0.5]", "missing");
  add("\"X\":[0.25,0.5],\"v\":[1,0.5]", "missing");
  add("\"x\":[0.25,0.5]", "missing");
  add("\"x\":[0.25,0.5],\"V\":[1,0.5]", "missing");
  for (const char* vector : kNoVectors) {
    add(question(vector, "[1,0.5]"), "no-vector");
    add(question(kGood, vector), "no-vector");
  }
  for (const char* value : kNoNumbers) {
    add(question(std::string("[0.25,") + value + "]", "[1,0.5]"), "no-number");
    add(question(kGood, std::string("[") + value + ",0.5]"), "no-number");
  }
  for (const char* value : kBadHex) add(question(kGood, std::string("[1,") + value + "]"), "bad-hexadecimal");
  for (const char* value : kTooLarge) {
    add(question(std::string("[") + value + ",0]", "[1,0.5]"), "too-large");
    add(question(kGood, std::string("[1,") + value + "]"), "too-large");
  }
  const std::string good = question(kGood, "[1,0.5]") + ",\"from\":";
  for (const char* from : kNoObstacles) add(good + from, "from-no-obstacle");
  for (const char* from : kUnknownObstacles) add(good + from, "from-unknown");
  for (const char* cell : kNoCells)
    add(good + "{\"lattice\":0,\"atom\":1,\"cell\":" + cell + "}", "from-cell");
  return found;
}

}  // namespace

const std::vector<BadQuery>& bad_queries() {
  static const std::vector<BadQuery> found = all();
  return found;
}

const std::vector<Tag>& bad_query_tags() {
  static const std::vector<Tag> tags{
      {"v-zero", "a velocity of zeros: no ray"},
      {"missing", "x or v is not there"},
      {"no-vector", "x or v with too many or too few components, or no array"},
      {"no-number", "a component is no number, or NaN or an infinity in words"},
      {"bad-hexadecimal", "a string that nearly is a hexadecimal float"},
      {"too-large", "a number beyond the largest binary64"},
      {"from-no-obstacle", "`from` is no object, or lacks a part"},
      {"from-unknown", "`from` names no lattice or atom of the scene"},
      {"from-cell", "`from` has a cell with a wrong number of coordinates, or of no integers"}};
  return tags;
}

const Scene& bad_query_scene() {
  static const Scene scene = [] {
    Scene two = unit_scene(2, 0.125);
    two.lattices[0].atoms.push_back({{0.5, 0}, 0.0625, {}});
    return two;
  }();
  return scene;
}

}  // namespace lorentz::cases
