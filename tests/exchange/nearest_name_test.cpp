// What was meant by a mistyped name.
#include "src/exchange/nearest_name.hpp"

#include <catch2/catch.hpp>

using lorentz::nearest_name;

TEST_CASE("The nearest name: one character too many, missing, wrong, or two exchanged",
          "[compare][nearest_name]") {
  const std::vector<std::string> names{"from", "compare", "convergents", "golden", "v"};
  for (const char* typed : {"compair", "comapre", "compre", "comparee", "conpare"})
    CHECK(nearest_name(typed, names) == "compare");
  CHECK(nearest_name("form", names) == "from");
  CHECK(nearest_name("FROM", names) == "from");
  CHECK(nearest_name("godlen", names) == "golden");
  CHECK(nearest_name("convergent", names) == "convergents");
}

TEST_CASE("A word that is far from every name has no nearest name", "[compare][nearest_name]") {
  const std::vector<std::string> names{"from", "compare", "golden", "v"};
  for (const char* typed : {"", "w", "position", "help", "xyzzy"}) CHECK(nearest_name(typed, names).empty());
  CHECK(nearest_name(std::string(1000, 'c'), names).empty());
  CHECK(nearest_name("anything", {}).empty());
  const std::string long_name(100, 'c');  // longer ones are no names
  CHECK(nearest_name(long_name, {long_name}) == long_name);
  CHECK(nearest_name(long_name + 'c', {long_name}).empty());
}

TEST_CASE("A name that stands where it means nothing was not mistyped", "[compare][nearest_name]") {
  CHECK(lorentz::did_you_mean("scene", {"scene", "from"}).empty());
  CHECK(lorentz::did_you_mean("scenes", {"scene", "from"}) == " (did you mean scene?)");
}
