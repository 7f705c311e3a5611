// Certificates as dictionaries, in the form of golden sets (docs/certificates.md).
#include "python/certificates.hpp"

#include <cmath>

#include <lorentz/errors.hpp>
#include "python/scene.hpp"

namespace lorentz::python {
namespace {

using oracle::CertificateBasis;
using oracle::WindowEnd;

py::list basis_list(const CertificateBasis& basis, int rank) {
  py::list rows;
  for (int i = 0; i < rank; ++i) rows.append(py::list(to_python(basis[i], rank)));
  return rows;
}

// A float if the value is exactly a binary64, else a text.
py::object limit_of_window(const WindowEnd& end) {
  if (const auto value = oracle::binary64_of(end)) return py::float_(*value);
  return py::str(oracle::text_of(end));
}

py::dict to_dict(const PyCertificate& certificate) {
  py::list windows, rows;
  for (const oracle::Window& w : certificate.proof.windows)
    windows.append(py::dict(py::arg("lattice") = w.lattice, py::arg("atom") = w.atom,
                            py::arg("from") = limit_of_window(w.from), py::arg("to") = limit_of_window(w.to),
                            py::arg("basis") = basis_list(w.basis, certificate.ranks.at(w.lattice))));
  for (const oracle::Rows& r : certificate.proof.rows)
    rows.append(py::dict(py::arg("lattice") = r.lattice, py::arg("atom") = r.atom,
                         py::arg("basis") = basis_list(r.basis, certificate.ranks.at(r.lattice))));
  py::dict dict;
  if (!rows.empty()) dict["rows"] = rows;
  if (!windows.empty() || rows.empty()) dict["windows"] = windows;
  return dict;
}

CertificateBasis basis_from(const py::handle& rows, int dimension) {
  const auto list = rows.cast<std::vector<std::vector<py::object>>>();
  if (list.size() > static_cast<std::size_t>(dimension))
    throw InputError("basis: has more vectors than there are dimensions");
  CertificateBasis basis;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].size() != list.size()) throw InputError("basis: needs as many components as vectors");
    for (std::size_t k = 0; k < list.size(); ++k) basis[i][k] = integer_from(list[i][k], "basis");
  }
  return basis;
}

WindowEnd end_from(const py::handle& end, const char* key) {
  if (!py::isinstance<py::str>(end)) {
    const auto number = end.cast<double>();
    if (number == HUGE_VAL && key == std::string("to")) return number;
    if (!std::isfinite(number)) throw InputError(std::string(key) + ": is not a finite number");
    return WindowEnd(number);
  }
  const auto text = end.cast<std::string>();
  if (text == "inf" && key == std::string("to")) return HUGE_VAL;
  const auto value = oracle::window_end_from(text);
  if (!value) throw InputError(std::string(key) + ": is neither a number nor a text like \"-0x1f4p-3\"");
  return *value;
}

PyCertificate from_dict(const py::dict& dict, int dimension) {
  PyCertificate certificate;
  if (!dict.contains("windows") && !dict.contains("rows"))
    throw InputError("certificate: has neither windows nor rows");
  const auto pieces = [&](const char* key) { return dict.contains(key) ? py::list(dict[key]) : py::list(); };
  try {
    for (const char* key : {"windows", "rows"})
      for (const py::handle piece : pieces(key))
        certificate.ranks[piece["lattice"].cast<int>()] = static_cast<int>(py::len(piece["basis"]));
    for (const py::handle w : pieces("windows"))
      certificate.proof.windows.push_back({w["lattice"].cast<int>(), w["atom"].cast<int>(),
                                           end_from(w["from"], "from"), end_from(w["to"], "to"),
                                           basis_from(w["basis"], dimension)});
    for (const py::handle r : pieces("rows"))
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
      .def("to_dict", to_dict)
      .def(
          "__eq__",
          [](const PyCertificate& a, const PyCertificate& b) { return to_dict(a).equal(to_dict(b)); },
          py::is_operator())
      .def(py::pickle([](const PyCertificate& proof) { return to_dict(proof); },
                      [](const py::dict& dict) { return from_dict(dict, 3); }));
}

}  // namespace lorentz::python
