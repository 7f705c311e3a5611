// What a program says of itself when its input is empty, and of the time of its own calls; and what is made of it.
#include "question/introduction.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include <lorentz/errors.hpp>
#include "tests/support/command_line.hpp"

using namespace lorentz;
using namespace lorentz::question;
using namespace lorentz::test;

namespace {

// Says its first argument where its input is empty; else answers as `reduction` does, and ends with its second.
constexpr const char* kProgram = R"(#!/bin/sh
cat >"$0.asked"
if [ -s "$0.asked" ]; then )" LORENTZ_PROGRAM
                                 R"( first-hit "$0.asked"; echo "$2"; else echo "$1"; echo complains >&2; fi
)";

std::string engine_of(const Folder& folder, const std::string& introduction, const std::string& end = "") {
  return " --engine 'cmd:sh " + folder.write("engine", kProgram) + " \"" + introduction + "\" \"" + end +
         "\"' ";
}

// As the shell's double quotes take it.
std::string said(const std::string& members) {
  std::string text;
  for (const char c : "{\"engine\":{" + members + "}}")
    text += c == '"' ? std::string("\\\"") : std::string(1, c);
  return text;
}

}  // namespace

TEST_CASE("An introduction is read, whatever is left out", "[compare][introduction]") {
  const auto whole = introduction_in(
      R"({"engine":{"name":"Ball","version":"1.2","precision":"binary32","time_tolerance":1e-4,"dimensions":[2,3],"new":1}})");
  REQUIRE(whole);
  CHECK(whole->name == "Ball");
  CHECK(whole->version == "1.2");
  CHECK(whole->precision == NumberFormat::binary32);
  CHECK(whole->time_tolerance == 1e-4);
  CHECK(whole->dimensions == std::vector{2, 3});
  CHECK(whole->unknown == std::vector<std::string>{"new"});
  const auto empty = introduction_in(R"( { "engine" : {"time_tolerance":null}} )");
  REQUIRE(empty);
  CHECK_FALSE((empty->precision || empty->time_tolerance));
  CHECK(empty->dimensions.empty());
  CHECK(introduction_in(R"({"engine":{"time_tolerance":"inf"}})")->time_tolerance ==
        std::numeric_limits<double>::infinity());
  for (const char* other :
       {"", "hello", "{}", R"({"id":1,"outcome":"never"})", R"({"engines":{}})", R"({"id":1,"engine":{}})"})
    CHECK_FALSE(introduction_in(other));
  CHECK(introduction_in(R"({"comment":"hi","engine":{"name":"m"}})")->name == "m");
  for (const char* bad : {"{", R"({"engine":1})", R"({"engine":{)", R"({"engine":{"precision":"float"}})",
                          R"({"engine":{"time_tolerance":-1}})", R"({"engine":{"dimensions":[4]}})",
                          R"({"engine":{"name":"a","name":"b"}})"})
    CHECK_THROWS_AS(introduction_in(bad), InputError);
}

TEST_CASE("A domain and a rule for starts inside are read", "[compare][introduction]") {
  const auto said = introduction_in(
      R"({"engine":{"dimensions":[3],"domain":{"speed":[0.5,2],"coordinates":[0,"inf"],"radius":[0.1,0.2],)"
      R"("flight":[0,100],"shapes":["ball"],"limits":false,"new":1},"inside":"miss"}})");
  REQUIRE((said && said->domain && said->inside == StartInside::miss));
  const Domain& domain = *said->domain;
  CHECK((domain.dimension_3 && !domain.dimension_2 && domain.balls && !domain.ellipsoids && !domain.limits));
  CHECK(domain.has(Query{{1e300, 0, 0}, {0, 2, 0}, {}}));
  CHECK_FALSE(domain.has(Query{{0, 0, 0}, {0, 2.1, 0}, {}}));
  CHECK(domain.has(unit_scene(3, 0.1)));
  CHECK_FALSE((domain.has(unit_scene(3, 0.25)) || domain.has(unit_scene(2, 0.1))));
  CHECK_FALSE(domain.has(Query{{}, {2, 0, 0}, {}}, Answer::hit({}, 51)));
  for (const char* bad :
       {R"({"engine":{"domain":1}})", R"({"engine":{"domain":{"speed":[1]}}})",
        R"({"engine":{"domain":{"speed":[2,1]}}})", R"({"engine":{"domain":{"speed":[-1,1]}}})",
        R"({"engine":{"domain":{"shapes":["box"]}}})", R"({"engine":{"inside":"behind"}})",
        R"({"engine":{"domain":{"limits":1}}})"}) {
    INFO(bad);
    CHECK_THROWS_AS(introduction_in(bad), InputError);
  }
}

TEST_CASE("A flight at another speed is brought into the domain, exactly or not at all",
          "[compare][introduction]") {
  Domain domain;
  domain.speed = {0.5, 2};
  const auto speed = [&](const Vec& v) {
    const auto query = domain.bring_inside({{}, v, {}});
    return query ? query->v : Vec{};
  };
  CHECK(speed({1, 0, 0}) == Vec{1, 0, 0});
  CHECK(speed({0x3p100, 0, 0}) == Vec{1.5, 0, 0});
  CHECK(speed({0, 0x3p-100, 0}) == Vec{0, 0.75, 0});
  CHECK(speed({0x1p1023, 0x1p1023, 0}) == Vec{1, 1, 0});
  CHECK(speed({0x1p1000, 0x1p-1000, 0}) == Vec{});  // the small one would vanish
  domain.speed = {1, 1.5};
  CHECK(speed({7, 0, 0}) == Vec{});  // no power of two helps
  domain.speed = {0, 0};
  CHECK(speed({7, 0, 0}) == Vec{});
  domain.coordinates = {0, 1};
  CHECK_FALSE(domain.bring_inside({{2, 0, 0}, {1, 0, 0}, {}}));
  const Query fast{
      {-0.25, 0, 0}, {1.5e308, 1.5e308, 0}, {}};  // |v| is beyond binary64; a hit at once is a flight of 0
  CHECK((Domain{}.has(fast, Answer::hit({}, 0)) && !Domain{.flight = {1, 2}}.has(fast, Answer::hit({}, 0))));
}

TEST_CASE("The time of an engine's own calls is read", "[compare][introduction]") {
  const auto time = own_time_in(R"({"engine_time":{"seconds":0.5,"queries":250}})");
  REQUIRE(time);
  CHECK(time->ns_per_query() == 2e6);
  CHECK_FALSE(own_time_in(R"({"engine_time":{"seconds":0,"queries":0}})")->ns_per_query());
  CHECK_FALSE(own_time_in(R"({"id":1,"outcome":"never"})"));
  for (const char* bad :
       {R"({"engine_time":{"seconds":-1,"queries":1}})", R"({"engine_time":{"queries":-1}})",
        R"({"engine_time":{"seconds":"inf","queries":1}})"})
    CHECK_THROWS_AS(own_time_in(bad), InputError);
  // An answer may have members of any name and kind; no introduction, either, is a text with this key.
  for (const char* its : {"0.001", "null", R"("5 ms")", R"({"seconds":-1})"})
    CHECK_FALSE(own_time_in(R"({"id":2,"outcome":"later","engine_time":)" + std::string(its) + '}'));
  CHECK_FALSE(introduction_in(R"({"status":"ready","engine":"mine 1.0"})"));
  std::string unknown;
  const auto see = [&](const std::string& key) { unknown += key; };
  CHECK(own_time_in(R"({"engine_time":{"seconds":2,"querys":1}})", see)->seconds == 2);
  CHECK(unknown == "engine_time.querys");
}

TEST_CASE("An engine is judged by what it says of itself, unless an option says otherwise",
          "[compare][introduction]") {
  const Folder folder;
  const std::string engine = engine_of(
      folder, said(R"("name":"Ball","version":"1.2","precision":"binary32","time_tolerance":0.001)"),
      R"({\"engine_time\":{\"seconds\":1,\"queries\":1000}})");
  const Run own = folder.lorentz("compare --json --count 8" + engine);
  INFO(own.err);
  CHECK(own.status == 0);
  CHECK(own.err.empty());
  CHECK(contains(own.out, R"("precision":"binary32","time_tolerance":0.001,)"));
  CHECK(contains(own.out, R"("engine_ns":1e+06,)"));
  CHECK(contains(folder.lorentz("compare --count 8" + engine).out,
                 "over all of its calls its process counted 1e+06 ns a query"));
  CHECK(contains(folder.lorentz("compare --json --count 8 --precision binary64" + engine).out,
                 R"("precision":"binary64","time_tolerance":0.001,)"));
  CHECK(contains(folder.lorentz("compare --json --count 8 --time-tolerance 0.5" + engine).out,
                 R"("precision":"binary32","time_tolerance":0.5,)"));
  CHECK(contains(folder.lorentz("golden check ball-3d --first 1 --json" + engine).out,
                 R"("precision":"binary32","time_tolerance":0.001,)"));
  const std::string judged = folder.lorentz("judge --questions 1 --json" + engine).out;
  CHECK(contains(judged, R"("precision":"binary32","time_tolerance":0.001,)"));
  CHECK(contains(judged, R"("library":"Ball 1.2","verdict")"));
  CHECK(contains(judged, R"("what":"Ball 1.2 (cmd:)"));
  CHECK(contains(judged, R"("engine_ns":1e+06,)"));

  CHECK(contains(
      folder.lorentz("bench --scene square --radius 0.1 --difficulty drawn --count 32 --json" + engine).out,
      R"("precision":"binary32","time_tolerance":0.001)"));
}

TEST_CASE("The coarsest claim of several engines holds", "[compare][introduction]") {
  const Folder folder;
  const std::string missing = engine_of(folder, said(R"("inside":"miss","domain":{"limits":false})"));
  CHECK(contains(folder.lorentz("compare --json --count 8 " + missing).out,
                 R"("domain":"limits=no","starts_inside":"miss")"));
  CHECK(contains(folder.lorentz("compare --json --count 8 --starts-inside exit " + missing).out,
                 R"("starts_inside":"exit")"));
  const std::string one = engine_of(folder, said(R"("precision":"binary32","time_tolerance":0.125)"));
  fs::create_directory(folder.file("other"));
  const std::string program = folder.write("other/engine", kProgram);
  const std::string two = " -e 'cmd:sh " + program + " \"" + said(R"("time_tolerance":0.25)") + "\" \"\"' ";
  for (const std::string& both : {one + two + "-e reduction", "-e reduction " + two + one})
    CHECK(contains(folder.lorentz("compare --json --count 8 " + both).out,
                   R"("precision":"binary32","time_tolerance":0.25,)"));
}

TEST_CASE("An impossible introduction is bad input, and a missing one is not a fault",
          "[compare][introduction]") {
  const Folder folder;
  const Run bad = folder.lorentz("compare --count 8" + engine_of(folder, said(R"("precision":"binary16")")));
  CHECK(bad.status == 2);
  CHECK(contains(bad.err, R"(says of itself: precision is binary64 or binary32, not "binary16")"));
  const std::string misspelt = engine_of(folder, said(R"("precison":"binary32","domain":{"sped":[0,1]})"));
  for (const char* command : {"compare --count 8", "golden check --first 8 ball-2d", "judge --questions 1"}) {
    const Run warned = folder.lorentz(command + misspelt),
              strict = folder.lorentz(command + misspelt + "--strict");
    INFO(warned.err << strict.err);
    CHECK(contains(warned.err,
                   R"(the key "engine.precison" is not known (did you mean precision?), and is ignored)"));
    CHECK(contains(warned.err, R"("engine.sped")"));
    CHECK(strict.status == 2);
    CHECK(contains(strict.err, R"(the key "engine.precison" is not known)"));
  }
  for (const char* other : {"", "usage: engine FILE"}) {
    const Run none = folder.lorentz("compare --json --count 8" + engine_of(folder, other));
    CHECK(none.status == 0);
    INFO(none.err);
    CHECK(none.err.empty());
    CHECK(contains(none.out, R"("precision":"binary64","time_tolerance":null,)"));
    CHECK(contains(none.out, R"("engine_ns":null,)"));
  }
}
