// Arrays in, arrays out. NumPy's arrays are views of the columns that the engine wrote, without a copy.
#include "python/engine.hpp"

namespace lorentz::python {
namespace {

using Answers = std::shared_ptr<AnswerRows>;

template <class Number>
py::array column(const Number* data, const py::object& owner) {
  return view(data, {static_cast<py::ssize_t>(owner.cast<const AnswerRows&>().count)}, owner);
}

py::array outcome(const py::object& self) {
  static_assert(sizeof(Outcome) == sizeof(std::int32_t));
  return column(reinterpret_cast<const std::int32_t*>(self.cast<const AnswerRows&>().outcome.data()), self);
}

py::array cell_columns(const py::object& self) {
  const auto& answers = self.cast<const AnswerRows&>();
  constexpr auto kBytes = static_cast<py::ssize_t>(sizeof(std::int64_t));
  return view(answers.cell(0), {static_cast<py::ssize_t>(answers.count), answers.dimension}, self,
              {kBytes, kBytes * static_cast<py::ssize_t>(answers.outcome.size())});
}

py::dict large_cells(const AnswerRows& answers) {
  py::dict cells;
  for (const auto& [row, large] : answers.large_cells)
    cells[py::int_(row)] = to_python(large, answers.dimension);
  return cells;
}

py::dict reasons(const AnswerRows& answers) {
  py::dict all;
  for (const RowFlaw& reason : answers.reasons)
    all[py::int_(reason.row)] = py::make_tuple(reason.message, reason.unsupported);
  return all;
}

// The addresses of the columns that the engine wrote.
py::dict addresses(const AnswerRows& answers) {
  const auto number = [](const void* address) { return reinterpret_cast<std::uintptr_t>(address); };
  py::dict all;
  all["outcome"] = number(answers.outcome.data());
  all["stage"] = number(answers.stage.data());
  all["time_is_rounded"] = number(answers.time_is_rounded.get());
  all["lattice"] = number(answers.lattice.data());
  all["atom"] = number(answers.atom.data());
  all["cell"] = number(answers.cell(0));
  all["time"] = number(answers.time.data());
  return all;
}

}  // namespace

void bind_first_hit(py::module_& module) {
  const auto column_of = [](auto member) {
    return [member](const py::object& self) {
      return column((self.cast<const AnswerRows&>().*member).data(), self);
    };
  };
  py::class_<AnswerRows, Answers>(module, "Answers", "Memory of lorentz.Answers.")
      .def_property_readonly("outcome", outcome)
      .def_property_readonly("stage", column_of(&AnswerRows::stage))
      .def_property_readonly("time_is_rounded",
                             [](const py::object& self) {
                               return column(self.cast<const AnswerRows&>().time_is_rounded.get(), self);
                             })
      .def_property_readonly("lattice", column_of(&AnswerRows::lattice))
      .def_property_readonly("atom", column_of(&AnswerRows::atom))
      .def_property_readonly("cell", cell_columns)
      .def_property_readonly("time", column_of(&AnswerRows::time))
      .def_property_readonly("large_cells", large_cells)
      .def_property_readonly("reasons", reasons)
      .def_property_readonly("_addresses", addresses);

  py::class_<PyEngine>(module, "Engine")
      .def(py::init<const PyScene&, const std::string&, std::optional<double>, int>(), py::arg("scene"),
           py::arg("name"), py::arg("max_time"), py::arg("jobs"))
      .def_property_readonly("name", &PyEngine::name)
      .def(
          "first_hit",
          [](PyEngine& engine, Numbers x, Numbers v, std::optional<Numbers> max_time, const py::object& from,
             bool refuse, Answers out) {
            return engine.first_hit(QueryArrays::of(std::move(x), std::move(v), std::move(max_time), from),
                                    refuse, std::move(out));
          },
          py::arg("x"), py::arg("v"), py::arg("max_time"), py::arg("start_from"), py::arg("refuse"),
          py::arg("out"));
  module.def("engines", question::own_names);
}

}  // namespace lorentz::python
