// What is claimed of one formula: its inputs, what it is over the real numbers (written by hand), and the
// sizes that its error is relative to.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "oracle/proof/bounds/symbolic.hpp"

namespace lorentz::bounds {

/// A constant of bounds.hpp in the unit of the statement, and what docs/bounds.md derives.
struct Constant {
  std::string name;
  double used;
  std::string derived;
};

/// An input between two powers of 2.
struct PositiveInput {
  std::string name;
  int low, high;
};

struct FormulaClaim {
  Constant constant;
  std::string name;                    ///< of the theorem
  std::vector<std::string> variables;  ///< real numbers
  std::vector<std::string> given;      ///< hypotheses
  std::vector<std::string> no_underflow;
  Symbol computed;             ///< by the engine's template
  std::string exact, size;     ///< by hand
  bool wide = false;           ///< in double-double, in units of u^2
  double times = 1, plus = 0;  ///< what the constant has to hold: this much of the error, and more
  std::string because = "";    ///< why
  std::vector<PositiveInput> ranges =
      {};  ///< where Gappa proves a relative bound; empty: all inputs within 1

  FormulaClaim& taken(double as_much, std::string reason, double and_more = 0) {
    times = as_much, plus = and_more, because = std::move(reason);
    return *this;
  }
  FormulaClaim& within(std::vector<PositiveInput> these) {
    ranges = std::move(these);
    return *this;
  }

  /// The error that is claimed: what the rules bring it to, rounded up.
  double claimed() const { return std::ceil(computed.error * 1000 + 1e-6) / 1000; }
  /// What the constant has to be.
  double needed() const { return std::ceil((claimed() * times + plus) * 1000 - 1e-6) / 1000; }
  /// Has Gappa a script of it? Not of quotients whose terms cancel, nor of double-double.
  bool has_script() const { return !wide && (computed.size > 0 || !ranges.empty()); }
};

/// A real number as it is written by hand, and the sizes of its terms.
struct SizedTerms {
  std::string exact, size;

  friend SizedTerms operator+(const SizedTerms& a, const SizedTerms& b) {
    return {a.exact + " + " + b.exact, a.size + " + " + b.size};
  }
  friend SizedTerms operator-(const SizedTerms& a, const SizedTerms& b) {
    return {a.exact + " - " + b.exact, a.size + " + " + b.size};
  }
  friend SizedTerms operator*(const std::string& factor, const SizedTerms& a) {
    return {factor + " * " + a.exact, "Rabs " + factor + " * " + a.size};
  }
  friend SizedTerms operator*(const SizedTerms& a, const std::string& factor) {
    return {a.exact + " * " + factor, a.size + " * Rabs " + factor};
  }
  friend SizedTerms operator/(const SizedTerms& a, const std::string& divisor) {
    return {a.exact + " / " + divisor, a.size + " / Rabs " + divisor};
  }
};
/// A number, or a product of some.
inline SizedTerms term(const std::string& text) {
  return {text, text.find(' ') == text.npos ? "Rabs " + text : "Rabs (" + text + ")"};
}
/// In parentheses.
inline SizedTerms whole(const SizedTerms& a) {
  return {"(" + a.exact + ")", "(" + a.size + ")"};
}

/// Makes the inputs of one statement, and the statement.
class Inputs {
 public:
  explicit Inputs(bool wide = false) : wide_(wide) { must_not_underflow().clear(); }

  /// A binary64, as it is.
  Symbol number(const std::string& name) {
    variables_.push_back(name);
    if (!wide_) given_.push_back("number " + name);
    return {name};
  }
  /// A binary64 that stands for exact_NAME, from which it is `roundoffs` away at most, relative to `size`.
  Symbol rounded(const std::string& name, double roundoffs, const std::string& size = "") {
    variables_.insert(variables_.end(), {name, "exact_" + name});
    given_.push_back((size.empty() ? "rounded " : "rounded_of ") + name + " exact_" + name + " " +
                     (size.empty() ? "" : size + " ") + decimal(roundoffs));
    return {name, roundoffs};
  }
  /// Any real number.
  void real(const std::string& name) { variables_.push_back(name); }
  const std::vector<std::string>& variables() const { return variables_; }
  void given(const std::string& hypothesis) { given_.push_back(hypothesis); }

  FormulaClaim claim(Constant constant, std::string name, const Symbol& computed, std::string exact,
                     std::string size) const {
    return {std::move(constant), std::move(name), variables_, given_, must_not_underflow(), computed,
            std::move(exact),    std::move(size), wide_};
  }
  FormulaClaim claim(Constant constant, std::string name, const Symbol& computed,
                     const SizedTerms& terms) const {
    return claim(std::move(constant), std::move(name), computed, terms.exact, terms.size);
  }

  static std::string decimal(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    return text.back() == '.' ? text + "0" : text;
  }

 private:
  bool wide_;
  std::vector<std::string> variables_, given_;
};

}  // namespace lorentz::bounds
