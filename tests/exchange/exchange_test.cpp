#include <lorentz/exchange.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cstdio>
#include <fstream>

#include "tests/support/support.hpp"

using namespace lorentz;
using test::Draw;

namespace {

// A line as the reader wants it: with bytes behind it that may be read.
class Padded {
 public:
  explicit Padded(std::string_view text) : buffer_(text) {
    buffer_.append(LineReader::kPadding, ' ');
    size_ = text.size();
  }
  LineReader::Line line() const { return {std::string_view(buffer_.data(), size_), 1, false}; }

 private:
  std::string buffer_;
  std::size_t size_;
};

StreamItem read(std::string_view text, const Scene* scene) {
  ExchangeReader reader;
  StreamItem item;
  reader.read_query_line(Padded(text).line(), scene, item);
  return item;
}

const Scene kSquare = unit_scene(2, 0.1);

std::string without_line_end(std::string text) {
  text.pop_back();
  return text;
}

}  // namespace

TEST_CASE("Queries round-trip bit for bit, in decimal and in hexadecimal", "[exchange]") {
  Draw draw(41);
  INFO("seed 41");
  for (int i = 0; i < 20000; ++i) {
    Query query;
    for (int k = 0; k < 2; ++k) query.x[k] = draw.finite(), query.v[k] = draw.finite();
    std::string text;
    append_query_line(text, "\"a\"", query, 2);
    const StreamItem item = read(without_line_end(text), &kSquare);
    INFO(text);
    REQUIRE(item.kind == StreamItem::Kind::query);
    REQUIRE(item.id == "\"a\"");
    for (int k = 0; k < 2; ++k) {
      REQUIRE(std::bit_cast<std::uint64_t>(item.query.x[k]) == std::bit_cast<std::uint64_t>(query.x[k]));
      REQUIRE(std::bit_cast<std::uint64_t>(item.query.v[k]) == std::bit_cast<std::uint64_t>(query.v[k]));
    }
    char hex[200];
    std::snprintf(hex, sizeof hex, R"({"x":["%a","%a"],"v":["%a","%a"]})", query.x[0], query.x[1], query.v[0],
                  query.v[1]);
    const StreamItem again = read(hex, &kSquare);
    INFO(hex << again.message);
    REQUIRE(again.kind == StreamItem::Kind::query);
    REQUIRE(again.query.x == query.x);
    REQUIRE(again.query.v == query.v);
  }
}

TEST_CASE("Numbers of 17 digits and numbers as other languages write them", "[exchange]") {
  const auto x0 = [](const std::string& number) {
    const StreamItem item = read("{\"x\":[" + number + ",0],\"v\":[1,0]}", &kSquare);
    INFO(number << " " << item.message);
    REQUIRE(item.kind == StreamItem::Kind::query);
    return item.query.x[0];
  };
  CHECK(x0("0.10000000000000001") == 0.1);
  CHECK(x0("1E2") == 100);
  CHECK(x0("-0.0") == 0);
  CHECK(x0("100000000000000000000") == 1e20);  // as JavaScript writes it
  CHECK(x0("123456789012345678901234567890.5") == 123456789012345678901234567890.5);
  CHECK(x0("\"0x1p-1074\"") == 0x1p-1074);
  CHECK(x0("\"-0X1.8P+3\"") == -12);
  CHECK(x0("2.2250738585072011e-308") == 2.2250738585072011e-308);
}

TEST_CASE("Scenes round-trip", "[exchange]") {
  Draw draw(42);
  INFO("seed 42");
  for (int i = 0; i < 200; ++i) {
    Scene scene = test::scene_of(draw, test::Style::near_grid, draw.one_in(2) ? 2 : 3);
    if (draw.one_in(3)) {
      Atom& atom = scene.lattices[0].atoms[0];
      atom.radius = 0;
      for (int k = 0; k < scene.dimension; ++k) atom.semiaxes.push_back(draw.vec(scene.dimension, -1, 1));
    }
    std::string text, again;
    append_scene_line(text, scene);
    const StreamItem item = read(without_line_end(text), nullptr);
    INFO(text << item.message);
    REQUIRE(item.kind == StreamItem::Kind::scene);
    append_scene_line(again, item.scene);
    REQUIRE(again == text);
  }
}

TEST_CASE("Answers round-trip, cells beyond 2^53 as strings", "[exchange]") {
  Answer hit = Answer::hit({1,
                            2,
                            {Integer(-3), *Integer::from_decimal("9007199254740993"),
                             *Integer::from_decimal("-18446744073709551616")}},
                           0.1);
  std::string text;
  append_answer_line(text, "7", hit, 3);
  CHECK(text ==
        "{\"id\":7,\"outcome\":\"hit\",\"lattice\":1,\"atom\":2,\"cell\":[-3,\"9007199254740993\",\"-"
        "18446744073709551616\"],"
        "\"time\":0.1}\n");
  ExchangeReader reader;
  Id id;
  Answer answer;
  std::size_t components = 0;
  REQUIRE(reader.read_answer_line(Padded(without_line_end(text)).line(), id, answer, components));
  CHECK(id == "7");
  CHECK(test::same(hit, answer));

  hit.time = INFINITY;
  text.clear();
  append_answer_line(text, "null", hit, 3);
  CHECK(text.find("\"time\":\"inf\"") != std::string::npos);
  REQUIRE(reader.read_answer_line(Padded(without_line_end(text)).line(), id, answer, components));
  CHECK(std::isinf(*answer.time));

  for (const Answer& other :
       {Answer::never(), Answer::undecided(), Answer::inside({0, 0, {Integer(1), Integer(2), Integer(0)}}),
        Answer::error("v is \"zero\"\n"), Answer::unsupported_because("too large")}) {
    text.clear();
    append_answer_line(text, "\"b\"", other, 2);
    INFO(text);
    REQUIRE(reader.read_answer_line(Padded(without_line_end(text)).line(), id, answer, components));
    CHECK(test::same(other, answer));
    CHECK(answer.message == other.message);
    CHECK(answer.unsupported == other.unsupported);
  }
}

TEST_CASE("Ids come back as they were given", "[exchange]") {
  const auto id = [](const std::string& text) {
    return read("{\"id\":" + text + ",\"x\":[0,0.5],\"v\":[1,0]}", &kSquare).id;
  };
  CHECK(id("\"a1\"") == "\"a1\"");
  CHECK(id("17") == "17");
  CHECK(id("-17") == "-17");
  CHECK(id("\"a\\\"b\\\\c\"") == "\"a\\\"b\\\\c\"");
  CHECK(id("\"\\u00e9\"") == "\"\xc3\xa9\"");
  CHECK(id("null") == "null");
}

TEST_CASE("Every sort of bad line is told by name, and keeps its id where it can be read", "[exchange]") {
  struct Case {
    const char* text;
    const char* message;
    const char* id;
  };
  const Case cases[] = {
      {"nonsense", "not JSON", "null"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0]", "not JSON", "null"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0]} 2", "not JSON", "null"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0]} {}", "more than one value", "1"},
      {"[1,2]", "not JSON", "null"},
      {"{\"id\":1,\"x\":[0,0.5]}", "v is missing", "1"},
      {"{\"id\":1,\"v\":[0,0.5]}", "x is missing", "1"},
      {"{\"id\":1,\"x\":[0,0.5,0],\"v\":[1,0]}", "x: has 3 components", "1"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1]}", "v: has 1 components", "1"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[0,-0.0]}", "v is zero", "1"},
      {"{\"id\":1,\"x\":[0,NaN],\"v\":[1,0]}", "", "1"},
      {"{\"id\":1,\"x\":[0,1e999],\"v\":[1,0]}", "x: is beyond the range", "1"},
      {"{\"x\":[0,\"nan\"],\"v\":[1,0],\"id\":\"late\"}", "not a hexadecimal float", "\"late\""},
      {"{\"id\":1,\"x\":[0,\"0x1p2000\"],\"v\":[1,0]}", "range", "1"},
      {"{\"id\":1,\"x\":[0,null],\"v\":[1,0]}", "x: needs a number", "1"},
      {"{\"id\":1,\"x\":5,\"v\":[1,0]}", "x: needs an array", "1"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0],\"from\":{}}", "from: needs lattice, atom and cell", "1"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0],\"from\":{\"lattice\":0,\"atom\":0,\"cell\":[0]}}",
       "from.cell: has 1", "1"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0],\"from\":{\"lattice\":1,\"atom\":0,\"cell\":[0,0]}}",
       "from names lattice 1", "1"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0],\"from\":{\"lattice\":0,\"atom\":0,\"cell\":[0,0.5]}}",
       "cell: needs an integer", "1"},
      {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0],\"other\":[1,}", "not JSON", "1"},
  };
  for (const Case& one : cases) {
    const StreamItem item = read(one.text, &kSquare);
    INFO(one.text << " -> " << item.message);
    CHECK(item.kind == StreamItem::Kind::bad);
    CHECK(item.message.find(one.message) != std::string::npos);
    CHECK(item.id == one.id);
  }
  CHECK(read("{\"id\":1,\"x\":[0,0.5],\"v\":[1,0]}", nullptr).message == "no scene before this query");
  CHECK(read(std::string("\0\0{\"id\":1}", 10), &kSquare).message.find("2 NUL bytes") != std::string::npos);
}

TEST_CASE("Text that is nearly JSON is refused, even where it would be ignored", "[exchange]") {
  for (const char* value : {"01", "1.", ".5", "-", "1e", "0x10", "+1", "tru", "nul", "1.2.3", "'a'"}) {
    const StreamItem item =
        read(std::string("{\"id\":1,\"x\":[0,0.5],\"v\":[1,0],\"other\":") + value + "}", &kSquare);
    INFO(value << " -> " << item.message);
    CHECK(item.kind == StreamItem::Kind::bad);
  }
  CHECK(read("{\"id\":01,\"x\":[0,0.5],\"v\":[1,0]}", &kSquare).kind == StreamItem::Kind::bad);
  CHECK(read("[1,2]", &kSquare).message.find("one object") != std::string::npos);
}

TEST_CASE("Nesting is bounded, in lines and in scene files", "[exchange]") {
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  for (const std::string& text : {"{\"id\":1,\"x\":[0,0.5],\"v\":[1,0],\"z\":" + deep + "}",
                                  "{\"scene\":" + deep + "}", "{\"golden\":" + deep + "}"}) {
    const StreamItem item = read(text, &kSquare);
    CHECK(item.kind == StreamItem::Kind::bad);
    CHECK(item.message.find("nested deeper") != std::string::npos);
  }
  std::string objects = "1";
  for (int i = 0; i < 60; ++i) objects = "{\"a\":" + objects + "}";
  const std::string square =
      R"({"dimension":2,"lattices":[{"vectors":[],"atoms":[{"position":[0,0],"radius":1}]}],"a":)";
  CHECK(read_scene_text(square + objects + "}").dimension == 2);
  CHECK_THROWS_AS(read_scene_text(deep), InputError);
  CHECK_THROWS_AS(read_scene_text("{\"a\":" + deep + "}"), InputError);
}

TEST_CASE("Dots nest in keys, but not in strings and comments", "[exchange]") {
  const std::string scene =
      "dimension = 2\nlattices = [{vectors = [], atoms = [{position = [0, 0], radius = 1}]}]\n";
  const std::string dots(100, '.');
  for (const std::string part : {"a", R"("=")", "'#'", R"("\"[")", R"("")", "' '"}) {
    std::string key = part;
    for (int i = 1; i < 60; ++i) key += "." + part;
    CHECK(read_scene_text(scene + key + " = 1\n").dimension == 2);
    while (key.size() < 1'000'000) key += "." + key;
    for (const std::string& text :
         {key + " = 1", "[" + key + "]", "a = {" + key + " = 1}", R"(a = [""".""""", {)" + key + " = 1}]"})
      CHECK_THROWS_WITH(read_scene_text(text), Catch::Contains("nested deeper"));
  }
  for (const std::string& odd :
       {"# " + dots, "a = '" + dots + "'", "a = \"" + dots + "\"", "'" + dots + "' = 1",
        "a = \"\"\"" + dots + "\n\"" + dots + "\"\"\"", "a = '''" + dots + "'''#" + dots})
    CHECK(read_scene_text(odd + "\n" + scene).dimension == 2);
}

TEST_CASE("A key that comes twice makes its line bad, wherever it is", "[exchange]") {
  const std::string query = R"("x":[0,0.5],"v":[1,0])";
  const auto twice = [](const StreamItem& item, const std::string& id, const std::string& key) {
    INFO(item.message);
    CHECK(item.kind == StreamItem::Kind::bad);
    CHECK(item.id == id);
    CHECK(item.message == "the key " + json_quoted(key) + " comes twice in an object");
  };
  REQUIRE(read(R"({"id":1,"a":{"b":1},"b":{"b":[{},{}]},)" + query + "}", &kSquare).kind ==
          StreamItem::Kind::query);
  twice(read(R"({"x":[9,9],)" + query + R"(,"id":7})", &kSquare), "7", "x");
  twice(read(R"({"x":[0,0.5],"v":[1,0],"\u0078":[0,0.5],"id":7})", &kSquare), "7", "x");
  twice(read(R"({"id":1,"id":1,)" + query + "}", &kSquare), "null", "id");
  twice(read(R"({"id":1,"more":{"deep":[{"a":1,"a":1}]},)" + query + "}", &kSquare), "1", "a");
  twice(read(R"({"id":1,"from":{"lattice":0,"atom":0,"atom":0,"cell":[0,0]},)" + query + "}", &kSquare), "1",
        "atom");
  // more than are held in place
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "\"k" + std::to_string(i) + "\":0,";
  REQUIRE(read("{" + many + query + "}", &kSquare).kind == StreamItem::Kind::query);
  for (const char* key : {"k3", "k8", "k999"})
    twice(read("{" + many + query + ",\"" + key + "\":0}", &kSquare), "null", key);
  const std::string atom = R"({"position":[0,0],"radius":1,"radius":2})";
  const std::string scene =
      R"({"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[)" + atom + "]}]}";
  const StreamItem bad = read("{\"scene\":" + scene + "}", nullptr);
  CHECK(bad.bad_scene);
  twice(bad, "null", "radius");
  const std::string path = test::temporary_file();
  std::ofstream(path) << scene;
  CHECK_THROWS_WITH(read_scene_file(path), Catch::Contains("\"radius\" comes twice"));
  std::remove(path.c_str());
}

TEST_CASE("What stands under a key that is not known may be anything", "[exchange]") {
  const std::string any = R"("more":[1e400,-1e999999,)" + std::string(5000, '9') + R"(,"x",{"inf":null}])";
  CHECK(read("{\"id\":1," + any + R"(,"x":[0,0.5],"v":[1,0]})", &kSquare).kind == StreamItem::Kind::query);
  const std::string atom = R"({"position":[0,0],)" + any + R"(,"radius":0.25})";
  const StreamItem item = read(R"({"scene":{"dimension":2,)" + any +
                                   R"(,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[)" + atom + "]}]}}",
                               nullptr);
  INFO(item.message);
  REQUIRE(item.kind == StreamItem::Kind::scene);
  CHECK(item.scene.lattices[0].atoms[0].radius == 0.25);
}

TEST_CASE("Long texts are read once, and fit", "[exchange]") {
  ExchangeReader reader;
  Answer answer;
  Id id;
  std::size_t components = 0;
  const std::string zeros(3'000'000, '0');
  const std::string text =
      R"({"id":1,"outcome":"hit","lattice":0,"atom":0,"cell":[27,1],"time":"0x)" + zeros + R"(1"})";
  REQUIRE(reader.read_answer_line(Padded(text).line(), id, answer, components));
  CHECK(answer.time == 1);
}

TEST_CASE("Only white space may stand behind a number", "[exchange]") {
  for (const char c : {' ', '\t', '\r', '\x04', '\x0b', '\x0c', '\x1f', '\x7f'}) {
    const std::string text = R"({"id":1,"from":{"lattice":0,"atom":0,"cell":[7)" + std::string(1, c) +
                             R"(,0]},"x":[0,0.5],"v":[1,0]})";
    INFO(static_cast<int>(c));
    CHECK((read(text, &kSquare).kind == StreamItem::Kind::query) == (c == ' ' || c == '\t' || c == '\r'));
  }
}

TEST_CASE("Integers have 2500 characters at most, levels are 64", "[exchange]") {
  const auto leaving = [](const std::string& n) {
    return read(R"({"id":1,"from":{"lattice":0,"atom":0,"cell":[)" + n + R"(,0]},"x":[0,0.5],"v":[1,0]})",
                &kSquare)
               .kind == StreamItem::Kind::query;
  };
  const std::string longest(2499, '7');
  for (const std::string& n : {"-" + longest, "\"-" + longest + "\"", "\"0" + longest + "\""})
    CHECK(leaving(n));
  for (const std::string& n : {"-7" + longest, "\"-7" + longest + "\"", "\"00" + longest + "\""})
    CHECK_FALSE(leaving(n));
  for (const std::size_t levels : {63UL, 64UL}) {  // in the line's object
    const std::string value = std::string(levels, '[') + std::string(levels, ']');
    CHECK((read(R"({"z":)" + value + R"(,"x":[0,0.5],"v":[1,0]})", &kSquare).kind ==
           StreamItem::Kind::query) == (levels == 63));
  }
}

TEST_CASE("Numbers too small are rounded, too large are refused, in every notation", "[exchange]") {
  CHECK(parse_number("1e-999") == 0);
  CHECK(parse_number("0x1p-2000") == 0);
  CHECK(parse_number("0x1.8p-1074") == 0x1p-1073);
  CHECK(parse_number("+0.5") == 0.5);
  CHECK(parse_number("-0x1p-3") == -0.125);
  for (const char* text :
       {"1e999", "0x1p2000", "inf", "nan", "", "-", "0x", "1x", "1 ", "--1", "+-1", "infinity", "0x1p"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_number(text), InputError);
  }
}

TEST_CASE("Large numbers never look like integers, large ids are strings", "[exchange]") {
  std::string text;
  append_number(text, 63050394783186936.0);
  CHECK(text == "6.3050394783186936e+16");
  CHECK(read("{\"id\":9007199254740993,\"x\":[0,0.5],\"v\":[1,0]}", &kSquare).id == "\"9007199254740993\"");
  CHECK(read("{\"id\":9007199254740992,\"x\":[0,0.5],\"v\":[1,0]}", &kSquare).id == "9007199254740992");
}

TEST_CASE("A bad answer line is refused, not guessed at", "[exchange]") {
  ExchangeReader reader;
  Id id;
  Answer answer;
  std::size_t components = 0;
  for (const char* text : {R"({"id":1})", R"({"id":1,"outcome":"maybe"})", R"({"id":1,"outcome":"hit"})",
                           R"({"id":1,"outcome":"hit","atom":0,"cell":[1,2],"time":1})",
                           R"({"id":1,"outcome":"hit","lattice":0,"atom":0})",
                           R"({"id":1,"outcome":"hit","lattice":-1,"atom":0,"cell":[1,2],"time":1})"}) {
    INFO(text);
    CHECK_THROWS_AS(reader.read_answer_line(Padded(text).line(), id, answer, components), InputError);
  }
  for (const char* text :
       {R"({"outcome":5})", R"({"outcome":"never","message":[]})", R"({"outcome":"error","reason":1})"})
    CHECK_THROWS_WITH(reader.read_answer_line(Padded(text).line(), id, answer, components),
                      Catch::Contains(": needs a text"));
  const Padded nulls(R"({"outcome":"error","message":null,"reason":null})");
  CHECK(reader.read_answer_line(nulls.line(), id, answer, components));
  CHECK((answer.message.empty() && !answer.unsupported));
  CHECK_FALSE(reader.read_answer_line(Padded("{\"golden\":{}}").line(), id, answer, components));
}

TEST_CASE("Blank lines and golden headers are passed over, unknown keys ignored", "[exchange]") {
  CHECK(read("", &kSquare).kind == StreamItem::Kind::nothing);
  CHECK(read(" \t\r", &kSquare).kind == StreamItem::Kind::nothing);
  CHECK(read("{\"golden\":{\"format\":1}}", nullptr).kind == StreamItem::Kind::nothing);
  CHECK(read("{\"id\":1,\"tags\":[\"a\",{\"b\":[1e999,true,null]}],\"x\":[0,0.5],\"v\":[1,0],\"expect\":{"
             "\"x\":[]}}\r",
             &kSquare)
            .kind == StreamItem::Kind::query);
}

TEST_CASE("Unknown keys: their place is told, and an objection makes the line bad", "[exchange]") {
  ExchangeReader reader;
  std::vector<std::string> told;
  reader.on_unknown_key([&](const std::string& key) {
    told.push_back(key);
    if (key == "worst") throw InputError("objection");
  });
  const Scene unit = unit_scene(2, 0.25);
  StreamItem item;
  const auto read = [&](const std::string& text) {
    told.clear();
    reader.read_query_line(Padded(text).line(), &unit, item);
    return told;
  };
  using Keys = std::vector<std::string>;
  CHECK(read(R"({"id":1,"x":[0.5,0],"v":[1,0],"form":{"lattice":7}})") == Keys{"form"});
  CHECK(item.kind == StreamItem::Kind::query);
  CHECK(read(R"({"x":[0.5,0],"v":[1,0],"from":{"lattice":0,"atom":0,"cell":[0,0],"kell":1}})") ==
        Keys{"from.kell"});
  CHECK(read(R"({"id":1,"x":[0.5,0],"v":[1,0],"worst":1})") == Keys{"worst"});
  CHECK((item.kind == StreamItem::Kind::bad && item.message == "objection" && item.id == "1"));
  CHECK(read(R"({"scene":{"dimension":2,"name":"s","lattices":[{"vectors":[[1,0],[0,1]],"basis":1,)"
             R"("atoms":[{"position":[0,0],"radius":0.25,"colour":"red"}]}]}})") ==
        Keys{"name", "lattices.basis", "lattices.atoms.colour"});
  CHECK(item.kind == StreamItem::Kind::scene);
  const std::string scene =
      R"("scene":{"dimension":2,"lattices":[{"vectors":[],"atoms":[{"position":[0,0],"radius":1}]}]})";
  CHECK(read("{" + scene + R"(,"max_time":1})") == Keys{"a query in the line of a scene"});
  read_scene_text("{" + scene + R"(,"id":1,"radius":0.4})",
                  [&](const std::string& key) { told.push_back(key); });
  StartItem start;
  reader.read_start_line(Padded("{" + scene + R"(,"x":[0,3],"v":[1,0]})").line(), nullptr, start);
  reader.read_start_line(Padded(R"({"x":[0,3],"direction":{"degrees":36,"foo":1}})").line(), &start.scene,
                         start);
  CHECK(told ==
        Keys{"a query in the line of a scene", "radius", "a query in the line of a scene", "direction.foo"});
  // What golden records, golden itineraries and files of disagreements have besides is known.
  CHECK(
      read(R"({"id":1,"tags":[],"x":[0.5,0],"v":[1,0],"expect":{"outcome":"never"},"margin":1,"condition":2,)"
           R"("certificate":{},"time_decimal":"1","engine":"e","verdict":"wrong","departs":9,"expected":{},)"
           R"("given":{},"itinerary":[[0,0,1,0]],"times":{"1":"0.25"},"end":{}})")
          .empty());
  Id id;
  Answer answer;
  std::size_t components;
  told.clear();
  CHECK(reader.read_answer_line(Padded(R"({"id":1,"outcome":"never","tiem":3})").line(), id, answer,
                                components));
  CHECK(told == Keys{"tiem"});
  CHECK(reader.read_answer_line(
      Padded(R"({"id":1,"outcome":"hit","lattice":0,"atom":0,"cell":[0,0],"time":1,)"
             R"("time_decimal":"1","point":[0,0],"normal":[0,1],"impact_parameter":0,"exit_time":"0x1.8p1",)"
             R"("exit_point":[0,0],"exit_normal":[0,1]})")
          .line(),
      id, answer, components));
  CHECK(told == Keys{"tiem"});
  CHECK(answer.exit_time == 3.0);
  CHECK_THROWS_AS(reader.read_answer_line(Padded(R"({"id":1,"outcome":"never","worst":3})").line(), id,
                                          answer, components),
                  InputError);
}

TEST_CASE("NaN and Infinity are told by name", "[exchange]") {
  for (const char* word : {"NaN", "Infinity", "-Infinity", "nan", "inf", "-inf"}) {
    INFO(word);
    StreamItem item;
    const Scene unit = unit_scene(2, 0.25);
    ExchangeReader().read_query_line(
        Padded(std::string(R"({"id":"NaN","x":[0.5,)") + word + R"(],"v":[1,0]})").line(), &unit, item);
    CHECK(item.kind == StreamItem::Kind::bad);
    CHECK(item.message.starts_with(std::string("not JSON: ") + word + " is not a number there"));
  }
  StreamItem item;
  ExchangeReader().read_query_line(Padded(R"({"id":"Infinity","x":[0.5,?],"v":[1,0]})").line(), nullptr,
                                   item);
  CHECK(item.message.find("Infinity") == std::string::npos);
}

TEST_CASE("Every sort of bad scene is told by its place", "[exchange]") {
  const auto message = [](const std::string& scene) {
    const StreamItem item = read("{\"scene\":" + scene + "}", nullptr);
    INFO(scene << " -> " << item.message);
    CHECK(item.kind == StreamItem::Kind::bad);
    CHECK(item.bad_scene);
    return item.message;
  };
  const auto with_atom = [](const std::string& atom) {
    return "{\"dimension\":2,\"lattices\":[{\"vectors\":[[1,0],[0,1]],\"atoms\":[" + atom + "]}]}";
  };
  const auto with_lattice = [](const std::string& vectors) {
    return R"({"dimension":2,"lattices":[{"atoms":[],"vectors":)" + vectors + "}]}";
  };
  const std::pair<std::string, const char*> cases[] = {
      {"5", "needs an object"},
      {R"({"dimension":4,"lattices":[]})", "must be 2 or 3"},
      {R"({"dimension":2,"lattices":[]})", "at least one lattice"},
      {with_lattice("[[1,0],[0,1],[1,1]]"), "needs 2 vectors at most, has 3"},
      {with_lattice("[[1,0],[0,1]]"), "at least one atom"},
      {with_atom(R"({"position":[0,0]})"), "lattices[0].atoms[0]: radius is missing"},
      {with_atom(R"({"radius":1})"), "position is missing"},
      {with_atom(R"({"position":[0,0],"radius":0})"), "above zero"},
      {with_atom(R"({"position":[0,0],"radius":-1})"), "above zero"},
      {with_atom(R"({"position":[0,0,0],"radius":1})"), "has 3 components"},
      {with_atom(R"({"position":[0,0],"radius":1,"semiaxes":[[1,0],[0,1]]})"), "both"},
      {with_atom(R"({"position":[0,0],"semiaxes":[[1,0]]})"), "needs 2 vectors"}};
  for (const auto& [scene, why] : cases) CHECK_THAT(message(scene), Catch::Contains(why));
}

TEST_CASE("Scene files: TOML and JSON, with the place of what is wrong", "[exchange]") {
  const std::string path = test::temporary_file();
  const auto read_text = [&](const std::string& text) {
    std::ofstream(path) << text;
    return read_scene_file(path);
  };
  const std::string toml =
      "dimension = 2\n[[lattices]]\nvectors = [[1, 0], [\"0x1p-1\", 1.5]]\n[[lattices.atoms]]\nposition = "
      "[0, 0]\nradius = 0.25\n";
  const Scene scene = read_text(toml);
  CHECK(scene.lattices[0].vectors[1] == Vec{0.5, 1.5, 0});
  CHECK(scene.lattices[0].atoms[0].radius == 0.25);
  std::string json;
  append_scene_line(json, scene);
  const Scene again = read_text(json);
  CHECK(again.lattices[0].vectors == scene.lattices[0].vectors);
  CHECK_THROWS_WITH(read_text(""), Catch::Contains("is empty"));
  CHECK_THROWS_WITH(read_text("dimension = 2\nlattices = [[\n"),
                    Catch::Contains("line 2") && Catch::Contains("not TOML"));
  CHECK_THROWS_WITH(read_text("dimension = 2\n"), Catch::Contains("lattices is missing"));
  CHECK_THROWS_WITH(read_text("{\"dimension\":2"), Catch::Contains("not JSON"));
  // What the parser refuses as a whole, before it stands anywhere.
  CHECK_THROWS_WITH(read_text("{\"dimension\":2,\"lattices"), Catch::Contains("not JSON"));
  CHECK_THROWS_WITH(read_text("{\"\xff\":2}"), Catch::Contains("not JSON"));
  CHECK_THROWS_WITH(read_text("dimension = 2\n[[lattices]]\nvectors = [[1, 0], [0, "
                              "inf]]\n[[lattices.atoms]]\nposition = [0, 0]\nradius = 1\n"),
                    Catch::Contains("vectors[1][1]: is beyond the range of binary64"));
  std::remove(path.c_str());
  CHECK_THROWS_AS(read_scene_file(path), FileError);
  CHECK_THROWS_AS(read_scene_file("/"), FileError);
}
