// Makes scenes and queries from any bytes. Nearly all bytes give a question without flaws, and a small change
// of the bytes is a small change of the question.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::harness {

/// True if the oracle is fast in the scene. (If very many obstacles contain x, it can take long to find the
/// first of them: docs/limits.md.) Cells have volumes of 2^-6 and more and vectors of length 2^5 and less,
/// and a box around an obstacle has at most 8 times its cell's volume.
bool is_ordinary(const Scene& scene);

/// Scenes are ordinary, with 1 to 3 lattices of 1 to 4 atoms. Starts are within 2^60. Velocities have any
/// size, but few are beyond 2^200 or below 2^-200, where an exact answer can take a second under the
/// sanitizers.
class Decoder {
 public:
  Decoder(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  Scene scene();
  Query query(const Scene& scene);
  Vec velocity(const Scene& scene);
  bool flag() { return byte() & 1; }

 private:
  std::uint8_t byte() { return at_ < end_ ? *at_++ : 0; }  // zeros behind the end
  double raw();

  /// A finite number, 0 or of a size from 2^low to 2^high: on a coarse grid, with any bits, or near an
  /// earlier one.
  double number(int low, int high);
  Vec vec(int dimension, int low, int high);
  Lattice lattice(int dimension);
  Atom atom(int dimension);

  const std::uint8_t *at_, *end_;
  std::vector<double> earlier_;
};

}  // namespace lorentz::harness
