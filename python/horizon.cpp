// The infinite channels that a scene leaves open.
#include <lorentz/errors.hpp>
#include <lorentz/horizon.hpp>
#include "python/scene.hpp"
#include "report/horizon_report.hpp"

namespace lorentz::python {
namespace {

// The report of `lorentz horizon --json`, and its verdict.
std::pair<std::string, std::string> horizon(const PyScene& scene, double min_width, bool cylinders) {
  const py::gil_scoped_release release;
  try {
    const oracle::Horizon found = oracle::horizon_of(scene.scene(), min_width, cylinders);
    return {report::json_of(found, ""), report::verdict_of(found)};
  } catch (const oracle::TooManyChannels& error) {
    throw InputError(std::string(error.what()) + "; min_width restricts the search to wide channels");
  }
}

}  // namespace

void bind_horizon(py::module_& module) {
  module.def("horizon", horizon, py::arg("scene"), py::arg("min_width"), py::arg("cylinders"));
}

}  // namespace lorentz::python
