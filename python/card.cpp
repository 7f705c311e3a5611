// First hits of arrays in a graphics card's memory, which stay there.
#include <optional>
#include <vector>

#include <lorentz/certified_batch.hpp>
#include "python/scene.hpp"
#include "src/engines/gpu/driver.hpp"

namespace lorentz::python {
namespace {

const gpu::Card& card() {
  static const gpu::Card& only = *new gpu::Card(0);  // no destructor waits for a driver that has ended
  only.enter();
  return only;
}

// The columns of `count` answers, one behind the other, those of large numbers first.
class CardAnswers {
 public:
  CardAnswers(std::size_t count, int dimension)
      : count_(count),
        dimension_(dimension),
        memory_(card(), std::max<std::size_t>(count, 1) * (20 + 8 * dimension)) {
    time = take<double>(), cell = take<std::int64_t>(static_cast<std::size_t>(dimension));
    outcome = take<std::int32_t>(), lattice = take<std::int32_t>(), atom = take<std::int32_t>();
  }

  FlightColumns columns() const {
    FlightColumns columns;
    columns.outcome = {reinterpret_cast<Outcome*>(outcome), count_};
    columns.lattice = {lattice, count_}, columns.atom = {atom, count_}, columns.time = {time, count_};
    for (int k = 0; k < dimension_; ++k)
      columns.cell[k] = {cell + static_cast<std::size_t>(k) * count_, count_};
    return columns;
  }
  std::size_t count() const { return count_; }
  int dimension() const { return dimension_; }

  double* time;
  std::int64_t* cell;
  std::int32_t *outcome, *lattice, *atom;
  std::vector<std::pair<std::size_t, std::string>> errors;

 private:
  template <class T>
  T* take(std::size_t columns = 1) {
    T* const begin = reinterpret_cast<T*>(memory_.at<char>() + taken_);
    taken_ += columns * count_ * sizeof(T);
    return begin;
  }

  std::size_t count_, taken_ = 0;
  int dimension_;
  gpu::Memory memory_;
};

// The address of an array (N, d), and the steps from one row and one component to the next, in numbers.
using Place = std::tuple<std::uintptr_t, std::size_t, std::size_t>;

// The lattices of the obstacles that were hit: no others are left.
void put_lattices_hit(const CardAnswers& answers, gpu::Memory& there) {
  std::vector<std::int32_t> outcomes(answers.count()), lattices(answers.count());
  card().get(outcomes.data(), answers.outcome, 4 * answers.count());
  card().get(lattices.data(), answers.lattice, 4 * answers.count());
  for (std::size_t i = 0; i < lattices.size(); ++i)
    if (outcomes[i] != static_cast<std::int32_t>(Outcome::hit)) lattices[i] = -1;
  there.put(lattices.data(), 4 * lattices.size());
}

std::shared_ptr<CardAnswers> first_hits(const oracle::CertifiedBatch& engine, int dimension,
                                        std::size_t count, const Place& x, const Place& v,
                                        std::optional<std::uintptr_t> max_time,
                                        const std::shared_ptr<CardAnswers>& from) {
  const py::gil_scoped_release release;
  QueryColumns queries;
  const auto component = [&](const Place& place, int k) {
    const auto& [address, row, step] = place;
    return std::span(reinterpret_cast<const double*>(address) + static_cast<std::size_t>(k) * step, count);
  };
  for (int k = 0; k < dimension; ++k) queries.x[k] = component(x, k), queries.v[k] = component(v, k);
  if (max_time) queries.max_time = {reinterpret_cast<const double*>(*max_time), count};
  std::optional<gpu::Memory> lattices;
  if (from) {
    const FlightColumns left = from->columns();
    put_lattices_hit(*from, lattices.emplace(card(), 4 * std::max<std::size_t>(from->count(), 1)));
    queries.from_lattice = {lattices->at<std::int32_t>(), from->count()}, queries.from_atom = left.atom;
    for (int k = 0; k < dimension; ++k) queries.from_cell[k] = left.cell[k];
  }
  const auto answers = std::make_shared<CardAnswers>(count, dimension);
  answers->errors = engine.first_hits_there(queries, {std::get<1>(x), std::get<1>(v)}, answers->columns());
  return answers;
}

// A column as its users' libraries take it, and a copy of it here.
template <class T>
py::tuple card_column(const CardAnswers& answers, T* CardAnswers::*which, std::size_t columns = 1) {
  std::vector<py::ssize_t> shape;
  if (columns > 1) shape.push_back(static_cast<py::ssize_t>(columns));
  shape.push_back(static_cast<py::ssize_t>(answers.count()));
  const auto copy = [&answers, which, shape, columns] {
    py::array_t<T> here(shape);
    card().get(here.mutable_data(), answers.*which, columns * answers.count() * sizeof(T));
    return here;
  };
  return py::make_tuple(reinterpret_cast<std::uintptr_t>(answers.*which), py::cpp_function(copy));
}

}  // namespace

void bind_card(py::module_& module) {
  py::class_<CardAnswers, std::shared_ptr<CardAnswers>>(module, "CardAnswers")
      .def_property_readonly("count", &CardAnswers::count)
      .def_property_readonly("dimension", &CardAnswers::dimension)
      .def_readonly("errors", &CardAnswers::errors)
      .def("outcome", [](const CardAnswers& its) { return card_column(its, &CardAnswers::outcome); })
      .def("lattice", [](const CardAnswers& its) { return card_column(its, &CardAnswers::lattice); })
      .def("atom", [](const CardAnswers& its) { return card_column(its, &CardAnswers::atom); })
      .def("time", [](const CardAnswers& its) { return card_column(its, &CardAnswers::time); })
      .def("cell", [](const CardAnswers& its) {
        return card_column(its, &CardAnswers::cell, static_cast<std::size_t>(its.dimension()));
      });
  py::class_<oracle::CertifiedBatch>(module, "CardEngine")
      .def(py::init(
          [](const PyScene& scene) { return std::make_unique<oracle::CertifiedBatch>(scene.scene(), 0); }))
      .def("first_hits", &first_hits);
}

}  // namespace lorentz::python
