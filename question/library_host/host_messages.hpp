// The messages between the program and the process that has a library loaded: orders and reports through two
// pipes, queries and answers in shared memory.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lorentz::question {

/// Descriptor of the memory in the other process: SharedQueries, and behind them SharedAnswers.
inline constexpr int kSharedMemory = 3;

/// The columns of <lorentz/engine.h>. kMost rows are so many that a call of the library costs almost nothing,
/// and so few that they stay in the cache.
struct SharedQueries {
  static constexpr std::size_t kMost = 8192;

  double x[3][kMost], v[3][kMost];
  std::int32_t from_lattice[kMost], from_atom[kMost];
  std::int64_t from_cell[3][kMost];
};

struct SharedAnswers {
  static constexpr std::int32_t kNone = -1;  ///< as outcome: the library has not written one yet

  std::int32_t outcome[SharedQueries::kMost], lattice[SharedQueries::kMost], atom[SharedQueries::kMost];
  std::int64_t cell[3][SharedQueries::kMost];
  double time[SharedQueries::kMost];
};

/// Pages have 4, 16 or 64 KiB, and the two are mapped apart, the queries for reading only.
static_assert(sizeof(SharedQueries) % (std::size_t{1} << 16) == 0);

struct HostOrder {
  enum class Kind : std::int64_t {
    scene,   ///< `size` bytes follow: dimension, lattices, atoms and threads, each as int32; then the arrays
             ///< of lorentz_scene in their order there
    queries  ///< `size` rows are in the memory
  };
  Kind kind;
  std::int64_t size;
};

/// The first says whether the library was loaded; each of the others answers an order. A text follows.
struct HostReport {
  enum class Kind : std::int64_t {
    loaded,       ///< the text is what the library claims, or empty
    not_loaded,   ///< the text says why
    prepared,     ///< the scene is prepared; no text
    unsupported,  ///< the scene; the text is the library's reason, or empty
    answered      ///< all rows; no text
  };
  Kind kind;
  std::int64_t text_size;
  double seconds;  ///< duration of the library's call
};

}  // namespace lorentz::question
