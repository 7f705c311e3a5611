// The extension module `lorentz._lorentz`. The package's Python modules are thin wrappers of it.
#include "python/module.hpp"

#include <stdexcept>

#include <lorentz/errors.hpp>
#include "report/files/data_folder.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz::python {
namespace {

// Python accepts only UTF-8, but a file name, for example, may be any bytes.
std::string text_of(const std::exception& failure) {
  return printable(failure.what(), Lines::kept);
}

// One class for each kind of error (include/lorentz/errors.hpp); all derive from Error.
void bind_errors(py::module_& module) {
  static py::exception<InputError> error(module, "Error", PyExc_ValueError);
  error.attr("__module__") = "lorentz";
  error.attr("__doc__") = "Input that does not mean what it should. The text says where and why.";
  static py::exception<FileError> file_error(
      module, "FileError", py::make_tuple(error, py::reinterpret_borrow<py::object>(PyExc_OSError)));
  file_error.attr("__module__") = "lorentz";
  file_error.attr("__doc__") = "A file that cannot be opened, read or written.";
  static py::exception<UnsupportedError> unsupported(module, "UnsupportedError", error);
  unsupported.attr("__module__") = "lorentz";
  unsupported.attr("__doc__") =
      "A good question, but not for this engine. The text says what it does not do.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const FileError& failure) {
      file_error(text_of(failure).c_str());
    } catch (const InputError& failure) {
      error(text_of(failure).c_str());
    } catch (const UnsupportedError& failure) {
      unsupported(text_of(failure).c_str());
    } catch (const std::invalid_argument& failure) {
      error(text_of(failure).c_str());
    }
  });
}

}  // namespace
}  // namespace lorentz::python

PYBIND11_MODULE(_lorentz, module) {
  using namespace lorentz::python;
  module.doc() = "What `lorentz` is made of; use the package.";
  bind_errors(module);
  module.attr("VERSION") = LORENTZ_VERSION;
  module.def("add_data_folder", &lorentz::add_data_folder, py::arg("path"),
             "Another folder to look for scenes and golden sets in, after the usual ones.");
  bind_scene(module);
  bind_first_hit(module);
  bind_card(module);
  bind_certificates(module);
  bind_exact(module);
  bind_paths(module);
  bind_flights(module);
  bind_horizon(module);
  bind_golden(module);
  bind_judge(module);
  bind_statistics(module);
}
