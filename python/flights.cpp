// Counts of large numbers of free flights, and the laws of theory for them.
#include "python/engine.hpp"
#include "python/signals.hpp"
#include "question/starts/free_starts.hpp"
#include "statistics/flights/report.hpp"
#include "statistics/flights/run.hpp"

namespace lorentz::python {
namespace {

template <class Number>
py::array_t<Number> numpy_array(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

// The report of `lorentz flights --json`, and its counts: bins, and paths beyond each edge.
py::tuple flights_of(const PyScene& scene, std::uint64_t count, const std::string& start, std::uint64_t seed,
                     const std::string& engine, unsigned jobs) {
  const question::EngineInfo info = own_engine(engine);
  if (count < 1 || count > std::uint64_t{1} << 52) throw InputError("count: needs a number from 1 to 2^52");
  if (jobs < 1 || jobs > 1024) throw InputError("jobs: needs a number from 1 to 1024");
  flights::FlightsReport report;
  report.plan.scene = scene.crystal("flights are counted"),
  report.plan.engine = info.traits.needs_card ? flights::kAsOnCard : engine,
  report.plan.from = starts::ensemble_named(start, "start");
  report.plan.seed = seed, report.plan.count = count;
  report.account = flights::Account::begun(report.plan);
  found_by([&](std::atomic<bool>& stop) {
    flights::FlightBounds bounds;
    bounds.jobs = jobs, bounds.stop = &stop;
    if (info.traits.needs_card) bounds.card = 0;
    flights::run(report.plan, bounds, report.account);
  });
  const flights::FlightsFindings found(report);
  return py::make_tuple(report.json(), numpy_array(found.edges), numpy_array(found.counts),
                        numpy_array(found.beyond));
}

// The name of the known law, if there is one, and its survival at these times.
py::list laws_of(const PyScene& scene, const std::string& start, const py::array_t<double>& times) {
  py::list list;
  if (const auto law = flights::law_of(scene.scene(), starts::ensemble_named(start, "start")))
    list.append(py::make_tuple(law->name, py::vectorize(law->survival)(times)));
  return list;
}

std::optional<double> mean_free_path(const PyScene& scene) {
  return flights::mean_free_path_of(scene.scene()).value;
}

}  // namespace

void bind_flights(py::module_& module) {
  module.def("flights", flights_of, py::arg("scene"), py::arg("count"), py::arg("start"), py::arg("seed"),
             py::arg("engine"), py::arg("jobs"));
  module.def("laws", laws_of, py::arg("scene"), py::arg("start"), py::arg("times"));
  module.def("mean_free_path", mean_free_path, py::arg("scene"));
}

}  // namespace lorentz::python
