// The compiled forms of a flight, and the choice of the one that serves a scene. Private to the reduction
// engine.
#pragma once

#include <limits>

#include <lorentz/engine_base.hpp>
#include <lorentz/reduction.hpp>
#include "src/engines/reduction/bravais.hpp"

namespace lorentz {

/// The input of a kernel.
struct Task {
  const PreparedScene& scene;
  const Ray& ray;
  const Vec& x;  ///< in the scene's scaled lengths
  double max_time;
  double search_time;  ///< obstacles entered later need not be searched for; at least max_time
  Reduction::Time time;
  std::array<WideInteger, 3>* cell = nullptr;  ///< where the cell of a flight is put that is_far

  bool is_limited() const { return max_time < std::numeric_limits<double>::infinity(); }

  /// Did no component become zero when it was scaled?
  bool is_whole() const {
    bool whole = true;
    for (int k = 0; k < 3; ++k)
      whole &= (x[k] == 0) == (ray.x[k] == 0) && (ray.v[k] == 0) == (ray.given_v[k] == 0);
    return whole;
  }
};

using FlightKernel = void (*)(const Task&, Flight&);

/// The kernel for a scene, for processors with a fused multiply-add, and for all processors. Both give the same
/// bits. (Each set is a source file of its own, because it contains a dozen kernels.)
FlightKernel kernel_with_fma(const PreparedScene& scene);
FlightKernel kernel_without_fma(const PreparedScene& scene);

inline void give_up(Flight& flight) {
  flight.outcome = Outcome::undecided;
  flight.stage = Stage::undecided;
}

/// The smallest model that covers a scene. Each model exists for balls, and for scenes with ellipsoids.
enum class SceneModel {
  unit,      ///< one square or cubic lattice of spacing 1, an obstacle at the origin
  one_atom,  ///< one obstacle in any cell
  sparse,    ///< lattices of fewer vectors than dimensions: single obstacles, rows, layers
  several    ///< several atoms, in one lattice or several; some may be rows and layers
};

inline SceneModel model_of(const PreparedScene& scene) {
  const int dimension = scene.atoms[0].dimension;
  if (scene.most_rank < dimension) return SceneModel::sparse;
  if (scene.atoms.size() > 1) return SceneModel::several;
  return scene.atoms[0].unit ? SceneModel::unit : SceneModel::one_atom;
}

/// Calls make.operator()<dimension, model, are all obstacles balls>() for a scene.
template <int D, bool kBall, class Make>
auto for_model(const PreparedScene& scene, const Make& make) {
  switch (model_of(scene)) {
    case SceneModel::unit:
      return make.template operator()<D, SceneModel::unit, kBall>();
    case SceneModel::one_atom:
      return make.template operator()<D, SceneModel::one_atom, kBall>();
    case SceneModel::sparse:
      return make.template operator()<D, SceneModel::sparse, kBall>();
    default:
      return make.template operator()<D, SceneModel::several, kBall>();
  }
}
template <class Make>
auto for_scene(const PreparedScene& scene, const Make& make) {
  if (scene.atoms[0].dimension == 2)
    return scene.ellipsoids ? for_model<2, false>(scene, make) : for_model<2, true>(scene, make);
  return scene.ellipsoids ? for_model<3, false>(scene, make) : for_model<3, true>(scene, make);
}

}  // namespace lorentz
