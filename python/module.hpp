// Declarations that the parts of the extension module share. Private to python/.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace lorentz::python {

namespace py = pybind11;

/// Numbers in an array of any layout. They are not copied if they are already binary64.
using Numbers = py::array_t<double, py::array::forcecast>;

/// A read-only array of numbers in the memory of `owner`, a Python object; without strides, row by row.
template <class Number>
py::array view(const Number* data, std::vector<py::ssize_t> shape, const py::object& owner,
               std::vector<py::ssize_t> strides = {}) {
  py::array array(py::dtype::of<Number>(), std::move(shape), std::move(strides), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// Each part adds its classes and functions to the module.
void bind_scene(py::module_& module);
void bind_first_hit(py::module_& module);
void bind_card(py::module_& module);
void bind_exact(py::module_& module);
void bind_certificates(py::module_& module);
void bind_paths(py::module_& module);
void bind_flights(py::module_& module);
void bind_horizon(py::module_& module);
void bind_golden(py::module_& module);
void bind_judge(py::module_& module);
void bind_statistics(py::module_& module);

}  // namespace lorentz::python
