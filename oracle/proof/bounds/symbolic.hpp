// A number that is a formula: run on it, a template of the engine writes down what it computes, each operation
// rounded. `error` is what the rules of Errors.v bring it to; Coq is not asked to believe that.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace lorentz::bounds {

/// Products and quotients that must not underflow, in the order in which they were computed.
inline std::vector<std::string>& must_not_underflow() {
  static std::vector<std::string> all;
  return all;
}

inline constexpr double kUnit = 0x1p-53;

struct Symbol {
  std::string text;  ///< as Coq and Gappa read it
  double error = 0;  ///< relative to the sizes of its terms, in roundoffs
  double size = 1;   ///< of its terms, if no input is larger than 1; 0: a quotient or a root is among them
  std::string before_rounding = text;

  Symbol() : Symbol("0") {}
  Symbol(std::string name, double its_error = 0, double its_size = 1)
      : text(std::move(name)), error(its_error), size(its_size) {}

  friend Symbol operator+(const Symbol& a, const Symbol& b) {
    return rounded(a.text + " + " + b.text, larger(a, b), sum(a, b));
  }
  friend Symbol operator-(const Symbol& a, const Symbol& b) {
    return rounded(a.text + " - " + b.text, larger(a, b), sum(a, b));
  }
  friend Symbol operator*(const Symbol& a, const Symbol& b) {
    return safe(a.text + " * " + b.text, both(a.error, b.error), a.size * b.size);
  }
  friend Symbol operator/(const Symbol& a, const Symbol& b) {
    return safe(a.text + " / " + b.text, (a.error + b.error) / (1 - b.error * kUnit), 0);
  }
  friend Symbol sqrt(const Symbol& a) {
    return rounded("sqrt (" + a.text + ")", a.error / (2 - a.error * kUnit), 0);
  }
  Symbol operator-() const { return {"(- " + text + ")", error, size}; }

  /// Without the rounding of its last operation: which no comparison with a number sees (Errors.v, above).
  Symbol unrounded() const { return {"(" + before_rounding + ")", error - 1, size}; }

 private:
  static double both(double a, double b) { return a + b + a * b * kUnit; }
  static double larger(const Symbol& a, const Symbol& b) { return std::max(a.error, b.error); }
  static double sum(const Symbol& a, const Symbol& b) {
    return a.size > 0 && b.size > 0 ? a.size + b.size : 0;
  }
  static Symbol rounded(const std::string& exactly, double error, double size) {
    Symbol result("rnd (" + exactly + ")", both(error, 1), size);
    result.before_rounding = exactly;
    return result;
  }
  static Symbol safe(const std::string& exactly, double error, double size) {
    must_not_underflow().push_back(exactly);
    return rounded(exactly, error, size);
  }
};

}  // namespace lorentz::bounds
