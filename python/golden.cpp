// Golden sets, record by record.
#include "judge/golden/reader.hpp"
#include "judge/golden/sets.hpp"
#include "python/certificates.hpp"
#include "python/lines.hpp"
#include "python/scene.hpp"

namespace lorentz::python {
namespace {

class PyGoldenSet {
 public:
  explicit PyGoldenSet(const std::string& name_or_file) : reader_(golden::find_set(name_or_file)) {}

  const golden::Header& header() const { return reader_.header(); }
  const std::string& path() const { return reader_.path(); }

  // Throws StopIteration at the end.
  py::dict next() {
    golden::ReadRecord read;
    if (!reader_.next(read)) throw py::stop_iteration();
    if (reader_.scene_number() != scene_number_) {
      scene_ = py::cast(PyScene(reader_.scene()));
      scene_number_ = reader_.scene_number();
    }
    return dict_of(read);
  }

 private:
  py::dict dict_of(const golden::ReadRecord& read) const {
    const int d = reader_.scene().dimension;
    const golden::Record& record = read.record;
    py::dict dict(py::arg("id") = record.id, py::arg("tags") = record.tags, py::arg("scene") = scene_,
                  py::arg("question") = record.question, py::arg("flaw") = py::none(),
                  py::arg("x") = py::none(), py::arg("v") = py::none(), py::arg("start_from") = py::none(),
                  py::arg("answer") = answer_text(record.expect, d), py::arg("time_decimal") = py::none(),
                  py::arg("margin") = record.margin, py::arg("condition") = record.condition,
                  py::arg("time_change") = record.time_change,
                  py::arg("acceptable") = acceptable_list(record), py::arg("comment") = record.comment,
                  py::arg("source_id") = record.source_id, py::arg("certificate") = py::none());
    if (!record.expect.time_decimal.empty()) dict["time_decimal"] = record.expect.time_decimal;
    if (record.certificate) dict["certificate"] = PyCertificate(*record.certificate, reader_.scene());
    if (!read.query) {
      dict["flaw"] = read.flaw;
      return dict;
    }
    dict["x"] = to_python(read.query->x, d), dict["v"] = to_python(read.query->v, d);
    if (const auto& from = read.query->from) dict["start_from"] = to_python(*from, d);
    return dict;
  }

  // Pairs (obstacle, ulps), with None as the obstacle for "never".
  py::list acceptable_list(const golden::Record& record) const {
    py::list list;
    for (const oracle::ExcusedAnswer& other : record.acceptable) {
      const bool is_hit = other.answer.outcome == Outcome::hit;
      list.append(py::make_tuple(
          is_hit ? py::object(to_python(other.answer.obstacle, reader_.scene().dimension)) : py::none(),
          other.ulps));
    }
    return list;
  }

  golden::Reader reader_;
  py::object scene_;  // of the following records
  std::size_t scene_number_ = 0;
};

}  // namespace

void bind_golden(py::module_& module) {
  py::class_<PyGoldenSet>(module, "GoldenReader")
      .def(py::init<const std::string&>(), py::arg("name_or_file"))
      .def_property_readonly("path", &PyGoldenSet::path)
      .def_property_readonly("name", [](const PyGoldenSet& set) { return set.header().name; })
      .def_property_readonly("description", [](const PyGoldenSet& set) { return set.header().description; })
      .def_property_readonly("precision",
                             [](const PyGoldenSet& set) { return name_of(set.header().precision); })
      .def_property_readonly("count", [](const PyGoldenSet& set) { return set.header().count; })
      .def("__next__", &PyGoldenSet::next);
  module.def("golden_sets", golden::committed_sets);
}

}  // namespace lorentz::python
