// Queries in columns on a graphics card: the engine `gpu`.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <lorentz/batch.hpp>
#include "src/engines/gpu/columns.hpp"
#include "src/engines/gpu/driver.hpp"
#include "src/engines/reduction/bravais.hpp"

namespace lorentz::gpu {

/// Why the kernels do not do a scene, after "gpu"; empty if they do.
std::string beyond(const PreparedScene& scene);

/// A scene that they do. Throws InputError for others.
PreparedScene prepared(const Scene& scene);

/// The kind of such a scene, by its name in kinds.inc.
std::string kind_of(const PreparedScene& scene);

struct CardKernel;  // a kernel, and the memory of its launches

/// Flies with rounded times. The results are those of Batch::fly, to the bit, but for the rows that are left:
/// those that lanes do not decide, and those whose time is not known to be correctly rounded. Any number of
/// threads may share one.
class GpuBatch {
 public:
  /// On card `number`, modulo how many there are. A kernel is compared with `here`, the processor's engine for
  /// this scene, before it flies the first scene of its kind. Throws InputError if there is no card, or the
  /// build has no kernels, or none for the scene, and std::runtime_error if a bit differs.
  GpuBatch(const Scene& scene, const Batch& here, unsigned number);

  /// Flies all rows. Returns, in order, those that are left, which have the outcome `undecided`, and nothing
  /// else.
  std::vector<std::size_t> fly(const QueryColumns& queries, const FlightColumns& flights) const;

  /// The same for columns in the card's memory; the lattice is -1 without an obstacle. Row i of x is at x[k][i * steps[0]], of v at v[k][i *
  /// steps[1]].
  std::vector<std::size_t> fly_there(const QueryColumns& queries, const std::array<std::size_t, 2>& steps,
                                     const FlightColumns& flights) const;
  /// A row there, and its limit.
  std::pair<Query, double> query_there(const QueryColumns& queries, const std::array<std::size_t, 2>& steps,
                                       std::size_t i) const;
  /// Writes an answer there: all columns but `stage` and `time_is_rounded`.
  void set_there(const FlightColumns& flights, std::size_t i, const Flight& flight) const;

 private:
  void compare(const Batch& here) const;
  CardColumns in_scene(CardColumns columns) const;

  PreparedScene prepared_;
  CardKernel& kind_;
  Memory atoms_;
};

}  // namespace lorentz::gpu
