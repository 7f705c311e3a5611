// A scene as Python has it: in binary64, or in rational numbers that no binary64 is. Private to python/.
#pragma once

#include <memory>
#include <string>

#include <lorentz/rational.hpp>
#include "python/module.hpp"

namespace lorentz::python {

class PyScene {
 public:
  /// Without flaws and with independent vectors.
  explicit PyScene(Scene scene) : nearest_(std::move(scene)), exact_(rational(nearest_)) {}

  /// Throws InputError for a scene that is none, naming the place in it. Numbers may be texts, as "1/3".
  static PyScene from_json(const std::string& text);

  /// A file, or a name of the catalogue.
  static PyScene load(const std::string& name_or_file);

  int dimension() const { return nearest_.dimension; }

  /// True if every number is a binary64, which first hits in arrays need.
  bool is_binary64() const { return is_binary64_; }

  /// Throws InputError if that is not so.
  const Scene& scene() const;

  /// The same of lattices in all directions. Throws InputError for another: `what` ("flights are counted") is done in
  /// crystals only.
  const Scene& crystal(const std::string& what) const;

  /// With every number rounded, if need be. Throws InputError where that is no scene: a number beyond the
  /// range of binary64, a radius that becomes 0, vectors that become dependent.
  const Scene& nearest() const;
  const RationalScene& exact() const { return exact_; }

 private:
  explicit PyScene(RationalScene scene);

  template <class ReadBinary64, class ReadRational>
  static PyScene either(const ReadBinary64& binary64, const ReadRational& rational);

  Scene nearest_;
  RationalScene exact_;
  bool is_binary64_ = true;
};

/// An integer of any size.
py::int_ to_python(const Integer& n);

/// A float, or a fractions.Fraction.
py::object to_python(const Rational& number);

/// A tuple of `dimension` floats.
py::tuple to_python(const Vec& a, int dimension);

/// A tuple of `dimension` integers.
py::tuple to_python(const Cell& cell, int dimension);

/// An integer of any size. Throws InputError, naming `what`.
Integer integer_from(const py::handle& n, const char* what);

}  // namespace lorentz::python
