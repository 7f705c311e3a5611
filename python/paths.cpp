// Trajectories of many particles as arrays, and certified itineraries.
#include <algorithm>
#include <limits>

#include <lorentz/itinerary.hpp>
#include <lorentz/trajectory_batch.hpp>
#include "python/engine.hpp"
#include "python/lines.hpp"
#include "python/signals.hpp"
#include "question/engines.hpp"
#include "question/starts/free_starts.hpp"
#include "statistics/rival/rival.hpp"

namespace lorentz::python {
namespace {

// ---- Particles

// Which collisions are kept: every k-th or only the last (k = 0), one row per particle. Collisions that
// did not happen are 0, their numbers NaN.
struct Paths {
  Paths(std::size_t particles, std::size_t collisions, std::size_t every, int dimension)
      : particles(particles),
        collisions(collisions),
        every(every),
        columns(every > 0 ? collisions / every : std::min<std::size_t>(collisions, 1)),
        dimension(dimension) {
    const std::size_t all = particles * columns, components = all * static_cast<std::size_t>(dimension);
    const double none = std::numeric_limits<double>::quiet_NaN();
    time.resize(all, none), place.resize(components, none), velocity.resize(components, none);
    lattice.resize(all), atom.resize(all), cell.resize(components);
    count.resize(particles), stop.resize(particles);
  }

  void set(std::size_t i, const Scene& scene, const Particle& particle) {
    count[i] = static_cast<std::int64_t>(particle.collisions);
    if (every > 0 && particle.collisions % every != 0) return;
    const std::size_t k = i * columns + (every > 0 ? particle.collisions / every - 1 : 0);
    time[k] = particle.time, lattice[k] = particle.lattice, atom[k] = particle.atom;
    const Vec at = place_of(scene, particle);
    for (int c = 0; c < dimension; ++c) {
      const std::size_t n = k * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(c);
      place[n] = at[c], velocity[n] = particle.velocity[c], cell[n] = particle.cell[c];
    }
  }

  std::size_t particles, collisions, every, columns;
  int dimension;
  std::vector<double> time, place, velocity;
  std::vector<std::int32_t> lattice, atom;
  std::vector<std::int64_t> cell, count;
  std::vector<std::uint8_t> stop;  // codes of Stop
};

// The starts of particles as queries.
std::vector<Query> starts_of(const QueryArrays& arrays, const Scene& scene) {
  arrays.check(scene.dimension);
  QueryRows rows;
  arrays.copy(0, arrays.count(), rows);
  std::vector<Query> starts;
  starts.reserve(rows.count);
  for (std::size_t i = 0; i < rows.count; ++i) {
    starts.push_back(rows.query(i, scene.dimension));
    if (auto flaw = flaw_of(starts[i], scene)) throw InputError("row " + std::to_string(i) + ": " + *flaw);
  }
  return starts;
}

void follow_together(const Scene& scene, const std::vector<Query>& starts, double until, Precision precision,
                     Paths& paths) {
  if (const auto why_not = Reduction::beyond(scene)) throw UnsupportedError("the engine batch " + *why_not);
  const Batch engine(scene);
  Particles particles(engine, scene, precision);
  for (const Query& start : starts) particles.add(start);
  const auto visit = [&](std::size_t i, const Particle& particle, const Collision&) {
    paths.set(i, scene, particle);
    return true;
  };
  SignalWatch watch;
  for (std::size_t k = 0; k < paths.collisions && particles.advance(until, visit) > 0; ++k) watch.look();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Stop stop = particles.stop(i);
    paths.stop[i] = static_cast<std::uint8_t>(stop == Stop::none ? Stop::collisions : stop);
  }
}

void follow_one_by_one(const question::EngineInfo& engine, const Scene& scene,
                       const std::vector<Query>& starts, double until, Precision precision, Paths& paths) {
  const AskFirstHit ask = rival::asking(engine, scene);
  SignalWatch watch;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    Trajectory trajectory(ask, scene, starts[i], precision);
    const Stop stop = trajectory.run(paths.collisions, until, [&](const Trajectory& now) {
      paths.set(i, scene, now.state());
      watch.look();
      return true;
    });
    paths.stop[i] = static_cast<std::uint8_t>(stop);
  }
}

std::shared_ptr<Paths> follow(const PyScene& scene, const QueryArrays& arrays, std::size_t collisions,
                              std::size_t every, double until, const std::string& engine,
                              bool double_double) {
  const question::EngineInfo info = own_engine(engine);
  const std::vector<Query> starts = starts_of(arrays, scene.scene());
  auto paths = std::make_shared<Paths>(starts.size(), collisions, every, scene.dimension());
  const Precision precision = double_double ? Precision::double_double : Precision::binary64;
  const py::gil_scoped_release release;
  if (info.traits.together > 0 && !info.traits.is_exact)
    follow_together(scene.scene(), starts, until, precision, *paths);
  else
    follow_one_by_one(info, scene.scene(), starts, until, precision, *paths);
  return paths;
}

// ---- Itineraries

py::dict itinerary(const PyScene& scene, const std::string& start, std::optional<std::uint64_t> collisions,
                   const std::optional<std::string>& time, int digits, bool states, long most_bits) {
  oracle::Journey journey;
  journey.collisions = collisions, journey.digits = digits, journey.states = states;
  journey.most_bits = most_bits;
  if (time) journey.time = rational_from(*time);
  if (time && !journey.time) throw InputError("time: " + json_quoted(*time) + " is not a rational number");
  const Start from = read_start(start, scene.exact());
  std::vector<oracle::CertifiedCollision> met;
  oracle::Arrival arrival;
  {
    const py::gil_scoped_release release;
    SignalWatch watch;
    arrival = oracle::Itinerary(scene.exact())
                  .follow(from, journey, [&](const oracle::CertifiedCollision& collision) {
                    met.push_back(collision);
                    watch.look();
                    return true;
                  });
  }
  const auto rank_of = [&](int lattice) {
    return scene.exact().lattices[static_cast<std::size_t>(lattice)].rank_in(scene.dimension());
  };
  py::list list;
  for (const oracle::CertifiedCollision& c : met)
    list.append(py::dict(py::arg("lattice") = c.obstacle.lattice, py::arg("atom") = c.obstacle.atom,
                         py::arg("cell") = to_python(c.obstacle.cell, rank_of(c.obstacle.lattice)),
                         py::arg("time") = c.time, py::arg("x") = c.x, py::arg("v") = c.v,
                         py::arg("bits") = c.bits));
  return py::dict(py::arg("collisions") = list, py::arg("end") = std::string(name_of(arrival.end)),
                  py::arg("bits") = arrival.bits, py::arg("x") = arrival.x, py::arg("v") = arrival.v,
                  py::arg("distance") = arrival.distance);
}

// ---- Starts

py::dict draw(const PyScene& scene, std::size_t count, const std::string& kind, std::uint64_t seed,
              std::uint64_t first) {
  const starts::FreeStarts starts(scene.scene(), starts::kind_named(kind, "kind"), seed);
  const auto n = static_cast<py::ssize_t>(count), d = static_cast<py::ssize_t>(scene.dimension());
  py::array_t<double> xs({n, d}), vs({n, d});
  py::array_t<std::int64_t> cells({n, d});
  py::array_t<std::int32_t> lattices(n), atoms(n);
  auto x = xs.mutable_unchecked<2>(), v = vs.mutable_unchecked<2>();
  auto cell = cells.mutable_unchecked<2>();
  auto lattice = lattices.mutable_unchecked<1>(), atom = atoms.mutable_unchecked<1>();
  {
    const py::gil_scoped_release release;
    SignalWatch watch;
    Query start;
    for (py::ssize_t i = 0; i < n; ++i) {
      starts.draw(first + static_cast<std::uint64_t>(i), start);
      lattice(i) = start.from ? start.from->lattice : -1;
      atom(i) = start.from ? start.from->atom : 0;
      for (py::ssize_t k = 0; k < d; ++k) {
        const auto c = static_cast<std::size_t>(k);
        x(i, k) = start.x[c], v(i, k) = start.v[c];
        cell(i, k) = start.from ? start.from->cell[c].int64() : 0;
      }
      watch.look();
    }
  }
  py::dict columns(py::arg("x") = xs, py::arg("v") = vs, py::arg("start_from") = py::none());
  if (kind == "surface") columns["start_from"] = py::make_tuple(lattices, atoms, cells);
  return columns;
}

// ---- Arrays

// An array with 1 axis: a number per particle; 2: one per collision; 3: a vector per collision.
template <class Number>
auto view_of(std::vector<Number> Paths::*member, int axes) {
  return [=](const py::object& self) {
    const auto& paths = self.cast<const Paths&>();
    std::vector<py::ssize_t> lengths{static_cast<py::ssize_t>(paths.particles),
                                     static_cast<py::ssize_t>(paths.columns), paths.dimension};
    lengths.resize(static_cast<std::size_t>(axes));
    return view((paths.*member).data(), std::move(lengths), self);
  };
}

}  // namespace

void bind_paths(py::module_& module) {
  py::class_<Paths, std::shared_ptr<Paths>>(module, "Paths", "Memory of lorentz.Paths.")
      .def_property_readonly("count", view_of(&Paths::count, 1))
      .def_property_readonly("stop_code", view_of(&Paths::stop, 1))
      .def_property_readonly("time", view_of(&Paths::time, 2))
      .def_property_readonly("lattice", view_of(&Paths::lattice, 2))
      .def_property_readonly("atom", view_of(&Paths::atom, 2))
      .def_property_readonly("cell", view_of(&Paths::cell, 3))
      .def_property_readonly("place", view_of(&Paths::place, 3))
      .def_property_readonly("velocity", view_of(&Paths::velocity, 3));
  module.def(
      "follow",
      [](const PyScene& scene, Numbers x, Numbers v, const py::object& from, std::size_t collisions,
         std::size_t every, double until, const std::string& engine, bool double_double) {
        return follow(scene, QueryArrays::of(std::move(x), std::move(v), std::nullopt, from), collisions,
                      every, until, engine, double_double);
      },
      py::arg("scene"), py::arg("x"), py::arg("v"), py::arg("start_from"), py::arg("collisions"),
      py::arg("every"), py::arg("until"), py::arg("engine"), py::arg("double_double"));
  module.attr("BYTES_OF_START") = sizeof(Query) + sizeof(Particle) + sizeof(Stop) + sizeof(std::size_t);
  module.def("itinerary", itinerary, py::arg("scene"), py::arg("start"), py::arg("collisions"),
             py::arg("time"), py::arg("digits"), py::arg("states"), py::arg("most_bits"));
  module.def("draw", draw, py::arg("scene"), py::arg("count"), py::arg("kind"), py::arg("seed"),
             py::arg("first"));
  py::list stops;
  for (int code = 0; code <= static_cast<int>(Stop::error); ++code)
    stops.append(name_of(static_cast<Stop>(code)));
  module.attr("STOPS") = py::tuple(stops);
}

}  // namespace lorentz::python
