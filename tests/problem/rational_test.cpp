// Numbers that are texts: exactly what they say.
#include <lorentz/rational.hpp>

#include <catch2/catch.hpp>
#include <limits>
#include <string>

using namespace lorentz;

namespace {

// "numerator/denominator", or the binary64 in its own way.
std::string told(std::string_view text) {
  const auto number = rational_from(text);
  if (!number) return "none";
  if (const double* value = std::get_if<double>(&*number)) return "double " + std::to_string(*value);
  const auto& fraction = std::get<Fraction>(*number);
  return fraction.numerator.decimal() + "/" + fraction.denominator.decimal();
}

}  // namespace

TEST_CASE("Rational numbers from texts") {
  CHECK(told("1/3") == "1/3");
  CHECK(told("-22/7") == "-22/7");
  CHECK(told("+2/4") == "2/4");
  CHECK(told("0.1") == "1/10");
  CHECK(told("-.5") == "-5/10");
  CHECK(told("5.") == "5/1");
  CHECK(told("2.5e-3") == "25/10000");
  CHECK(told("12e2") == "1200/1");
  CHECK(told("1.25E+1") == "125/10");
  CHECK(told("007") == "7/1");
  CHECK(told("123456789012345678901234567890/3") == "123456789012345678901234567890/3");
  CHECK(told("0x1.8p-1") == "double 0.750000");
  CHECK(told("-0x1p+3") == "double -8.000000");
  for (const char* mark : {"p", "P"})  // what follows it is not a digit of the fraction
    CHECK(told(std::string("0x1.80000000000000") + mark + "-1") == "double 0.750000");
  CHECK(std::get<double>(*rational_from("0xF.FFFFFFFFFFFF8p1020")) == std::numeric_limits<double>::max());
  CHECK(std::get<double>(*rational_from("0x.4p-1072")) == 0x1p-1074);
  for (const char* one :
       {"0x1.00000000000000000p0", "0x0.00000000000000000800p69", "0x10000000000000000p-64"})
    CHECK(told(one) == "double 1.000000");
  for (const char* zero : {"0x0", "0x.0", "0x00.000p5", "-0x0p-7"})
    CHECK(std::get<double>(*rational_from(zero)) == 0);
  for (const char* text :
       {"",   "-",     "1/0",  "1/", "/3",     "1/-3", "1//3", "1/3/5",   "a",   "1e",
        "e5", "1.2.3", "1 /3", "0x", "0x1.8p", "inf",  "nan",  "1e99999", "--1", "0x1.00000000000001p0",
        "."})
    CHECK(told(text) == "none");
  for (const std::string text :
       {".", "g", "1.8.0", "-1p-2", "1p1024", "3p-1075", "3fffffffffffffp-55", "1.0000000000001p-1060"})
    CHECK((told("0x" + text) == "none" && told("-0x" + text) == "none"));
}

TEST_CASE("Numbers with a square root from texts") {
  const auto root = surd_from("-sqrt(2/3)");
  REQUIRE(root);
  CHECK(std::get<double>(root->scale) == -1);
  CHECK(std::get<Fraction>(*root->root).denominator == Integer(3));
  const auto golden = surd_from("golden");
  REQUIRE(golden);
  CHECK(std::get<double>(golden->shift) == 0.5);
  CHECK(std::get<double>(*golden->root) == 5);
  CHECK(!surd_from("1/3")->root);
  for (const char* text :
       {"sqrt(-2)", "sqrt()", "sqrt(2", "sqrt 2", "silver", "sqrt(sqrt(2))", "sqr", "sqrt[2)", "sqrt2)"})
    CHECK(!surd_from(text));
}

TEST_CASE("A flaw of any atom of any lattice is found, by its place") {
  RationalScene good = rational(unit_scene(2, 0.25));
  good.lattices.push_back(good.lattices[0]);
  for (RationalLattice& lattice : good.lattices) lattice.atoms.resize(2, lattice.atoms[0]);
  CHECK_FALSE(flaw_of(good));
  for (std::size_t l = 0; l < 2; ++l)
    for (std::size_t a = 0; a < 2; ++a) {
      const std::string where = "lattice " + std::to_string(l) + ", atom " + std::to_string(a) + ": ";
      RationalScene bad = good;
      bad.lattices[l].atoms[a].radius = 0.0;
      CHECK(flaw_of(bad) == where + "radius must be above zero");
      bad = good;
      bad.lattices[l].atoms[a].semiaxes.resize(3);
      CHECK(flaw_of(bad) == where + "needs as many semiaxes as dimensions (2)");
    }
  good.lattices[1].atoms.clear();
  CHECK(flaw_of(good) == "lattice 1: needs at least one atom");
}
