// Certificates as dictionaries: the form that golden sets have them in (docs/certificates.md).
#include "python/certificates.hpp"

#include <cmath>

#include <lorentz/errors.hpp>
#include "python/scene.hpp"

namespace lorentz::python {
namespace {

using oracle::CertificateBasis;
using oracle::WindowEnd;

py::list basis_list(const CertificateBasis& basis, int dimension) {
  py::list rows;
  for (int i = 0; i < dimension; ++i) rows.append(py::list(to_python(basis[i], dimension)));
  return rows;
}

// A float if a binary64 is exactly that, else a text.
py::object to_python(const WindowEnd& end) {
  if (const auto value = oracle::binary64_of(end)) return py::float_(*value);
  return py::str(oracle::text_of(end));
}

py::dict to_dict(const PyCertificate& certificate) {
  const int d = certificate.dimension;
  py::list windows, rows;
  for (const oracle::Window& w : certificate.proof.windows)
    windows.append(py::dict(py::arg("lattice") = w.lattice, py::arg("atom") = w.atom,
                            py::arg("from") = to_python(w.from), py::arg("to") = to_python(w.to),
                            py::arg("basis") = basis_list(w.basis, d)));
  for (const oracle::Rows& r : certificate.proof.rows)
    rows.append(py::dict(py::arg("lattice") = r.lattice, py::arg("atom") = r.atom,
                         py::arg("basis") = basis_list(r.basis, d)));
  py::dict dict;
  if (rows.empty())
    dict["windows"] = windows;
  else
    dict["rows"] = rows;
  return dict;
}

CertificateBasis basis_from(const py::handle& rows, int dimension) {
  const auto list = rows.cast<std::vector<std::vector<py::object>>>();
  if (list.size() != static_cast<std::size_t>(dimension))
    throw InputError("basis: needs a vector a dimension");
  CertificateBasis basis;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].size() != list.size()) throw InputError("basis: needs a component a dimension");
    for (std::size_t k = 0; k < list.size(); ++k) basis[i][k] = integer_from(list[i][k], "basis");
  }
  return basis;
}

WindowEnd end_from(const py::handle& end, const char* key) {
  if (!py::isinstance<py::str>(end)) {
    const auto number = end.cast<double>();
    if (!std::isfinite(number)) throw InputError(std::string(key) + ": is no finite number");
    return WindowEnd(number);
  }
  const auto value = oracle::window_end_from(end.cast<std::string>());
  if (!value) throw InputError(std::string(key) + ": is no number and no text like \"-0x1f4p-3\"");
  return *value;
}

PyCertificate from_dict(const py::dict& dict, int dimension) {
  PyCertificate certificate{{}, dimension};
  if (dict.contains("windows") == dict.contains("rows"))
    throw InputError("certificate: has either windows or rows");
  try {
    if (dict.contains("windows"))
      for (const py::handle w : dict["windows"])
        certificate.proof.windows.push_back({w["lattice"].cast<int>(), w["atom"].cast<int>(),
                                             end_from(w["from"], "from"), end_from(w["to"], "to"),
                                             basis_from(w["basis"], dimension)});
    else
      for (const py::handle r : dict["rows"])
        certificate.proof.rows.push_back(
            {r["lattice"].cast<int>(), r["atom"].cast<int>(), basis_from(r["basis"], dimension)});
  } catch (const py::cast_error&) {
    throw InputError("certificate: has something else where a number belongs");
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_LookupError) && !error.matches(PyExc_TypeError)) throw;
    throw InputError(std::string("certificate: has not the form of docs/certificates.md: ") + error.what());
  }
  return certificate;
}

}  // namespace

void bind_certificates(py::module_& module) {
  py::class_<PyCertificate>(
      module, "Certificate",
      "A proof of an exact answer; its dict has the form that golden sets have it in (docs/certificates.md).")
      .def_static("from_dict", from_dict, py::arg("certificate"), py::arg("dimension"))
      .def("to_dict", to_dict);
}

}  // namespace lorentz::python
