// Statistics of trajectories: Lyapunov exponents, diffusion.
#include "python/engine.hpp"
#include "python/signals.hpp"
#include "question/starts/free_starts.hpp"
#include "statistics/chaos/diffusion.hpp"
#include "statistics/chaos/lyapunov.hpp"

namespace lorentz::python {
namespace {

// The report of `lorentz lyapunov --json`.
std::string lyapunov(const PyScene& scene, std::uint64_t collisions, bool spectrum, std::uint64_t seed,
                     unsigned jobs) {
  const chaos::LyapunovPlan plan{scene.crystal("means of trajectories are taken"), seed, collisions,
                                 spectrum};
  return found_by([&](std::atomic<bool>& stop) { return chaos::lyapunov_of(plan, {jobs, &stop}).json(); });
}

// The report of `lorentz diffusion --json`.
std::string diffusion(const PyScene& scene, std::uint64_t count, double time, const std::string& start,
                      std::uint64_t seed, unsigned jobs) {
  const chaos::DiffusionPlan plan{scene.crystal("means of trajectories are taken"),
                                  starts::ensemble_named(start, "start"), seed, count, time};
  return found_by([&](std::atomic<bool>& stop) {
    const chaos::Diffusion found = chaos::diffusion_of(plan, {jobs, &stop});
    if (!found.has_content()) throw InputError("scene: no particle got beyond its first obstacle");
    return found.json();
  });
}

}  // namespace

void bind_statistics(py::module_& module) {
  module.def("lyapunov", lyapunov, py::arg("scene"), py::arg("collisions"), py::arg("spectrum"),
             py::arg("seed"), py::arg("jobs"));
  module.def("diffusion", diffusion, py::arg("scene"), py::arg("count"), py::arg("time"), py::arg("start"),
             py::arg("seed"), py::arg("jobs"));
}

}  // namespace lorentz::python
