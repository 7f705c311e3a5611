// A scene of Python: in binary64, or in rational numbers that binary64 cannot represent. Private to python/.
#pragma once

#include <memory>
#include <string>

#include <lorentz/rational.hpp>
#include "python/module.hpp"

namespace lorentz::python {

class PyScene {
 public:
  /// The scene must have no flaws and independent vectors.
  explicit PyScene(Scene scene) : nearest_(std::move(scene)), exact_(rational(nearest_)) {}

  /// Throws InputError for an invalid scene and names the place in it. Numbers may be texts such as "1/3".
  static PyScene from_json(const std::string& text);

  /// Loads a file, or a scene of the catalogue by its name.
  static PyScene load(const std::string& name_or_file);

  int dimension() const { return nearest_.dimension; }

  /// True if every number is a binary64. First hits in arrays need this.
  bool is_binary64() const { return is_binary64_; }

  /// The binary64 scene. Throws InputError if not every number is a binary64.
  const Scene& scene() const;

  /// The same for a crystal, whose lattices repeat in all directions. Throws InputError for other scenes,
  /// with a message that `what` ("flights are counted") supports crystals only.
  const Scene& crystal(const std::string& what) const;

  /// The scene with every number rounded to binary64 if necessary. Throws InputError if the result is
  /// invalid: a number beyond the range of binary64, a radius that becomes 0, vectors that become dependent.
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
inline double to_python(double number) {
  return number;
}
py::object to_python(const Rational& number);

/// A tuple of the first `count` numbers.
template <class Number>
py::tuple to_python(const std::array<Number, 3>& numbers, int count) {
  py::tuple tuple(count);
  for (int i = 0; i < count; ++i) tuple[i] = to_python(numbers[i]);
  return tuple;
}

/// (lattice, atom, cell)
py::tuple to_python(const ObstacleId& obstacle, const Components& count);

/// An integer of any size. Throws InputError that names `what`.
Integer integer_from(const py::handle& n, const char* what);

}  // namespace lorentz::python
