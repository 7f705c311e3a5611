#include "python/scene.hpp"

#include <lorentz/errors.hpp>
#include <lorentz/itinerary.hpp>
#include <lorentz/scene_check.hpp>
#include "python/lines.hpp"
#include "report/files/scene_file.hpp"

namespace lorentz::python {
namespace {

Scene independent(Scene scene) {
  if (auto flaw = oracle::dependence_in(scene)) throw InputError(*flaw);
  return scene;
}

py::object fraction_class() {
  return py::module_::import("fractions").attr("Fraction");
}

py::dict atom_dict(const RationalAtom& atom, int dimension) {
  py::dict dict;
  dict["position"] = to_python(atom.position, dimension);
  if (atom.is_ball()) {
    dict["radius"] = to_python(atom.radius);
  } else {
    py::list semiaxes;
    for (const RationalVec& axis : atom.semiaxes) semiaxes.append(to_python(axis, dimension));
    dict["semiaxes"] = semiaxes;
  }
  return dict;
}

py::dict scene_dict(const PyScene& scene) {
  py::list lattices;
  for (const RationalLattice& lattice : scene.exact().lattices) {
    py::list vectors, atoms;
    for (int i = 0; i < lattice.rank_in(scene.dimension()); ++i)
      vectors.append(to_python(lattice.vectors[i], scene.dimension()));
    for (const RationalAtom& atom : lattice.atoms) atoms.append(atom_dict(atom, scene.dimension()));
    lattices.append(py::dict(py::arg("vectors") = vectors, py::arg("atoms") = atoms));
  }
  return py::dict(py::arg("dimension") = scene.dimension(), py::arg("lattices") = lattices);
}

py::list catalogue_names() {
  py::list names;
  for (const auto& [name, file] : catalogue()) names.append(name);
  return names;
}

}  // namespace

PyScene::PyScene(RationalScene scene)
    : nearest_(oracle::nearest(scene)), exact_(std::move(scene)), is_binary64_(false) {
  const oracle::Itinerary check(exact_);  // throws InputError
}

// Reads in binary64. If that fails, reads in rational numbers, which may be texts; errors are those of this
// reader.
template <class ReadBinary64, class ReadRational>
PyScene PyScene::either(const ReadBinary64& binary64, const ReadRational& rational) {
  try {
    return PyScene(binary64());
  } catch (const InputError&) {
    return PyScene(rational());
  }
}

PyScene PyScene::from_json(const std::string& text) {
  return either([&] { return independent(read_scene(text)); }, [&] { return read_rational_scene(text); });
}

PyScene PyScene::load(const std::string& name_or_file) {
  const std::string file = find_scene(name_or_file);
  try {
    return either([&] { return independent(read_scene_file(file, refuse_key)); },
                  [&] { return read_rational_scene_file(file, refuse_key); });
  } catch (const InputError& error) {
    throw InputError((std::string(error.what()).starts_with(file) ? "" : name_or_file + ": ") + error.what());
  }
}

const Scene& PyScene::crystal(const std::string& what) const {
  if (!is_crystal(scene()))
    throw InputError("scene: " + what +
                     " in crystals only; this one has lattices that repeat in fewer directions");
  return scene();
}

const Scene& PyScene::nearest() const {
  if (is_binary64_) return nearest_;
  if (const auto flaw = flaw_of(nearest_)) throw InputError("rounded to binary64: " + *flaw);
  if (const auto flaw = oracle::dependence_in(nearest_)) throw InputError("rounded to binary64: " + *flaw);
  return nearest_;
}

const Scene& PyScene::scene() const {
  if (!is_binary64_)
    throw InputError(
        "the scene has numbers that no binary64 is; scene.nearest() has them rounded, and certified "
        "itineraries take them as they are");
  return nearest_;
}

py::int_ to_python(const Integer& n) {
  if (n.fits_int64()) return py::int_(n.int64());
  return py::reinterpret_steal<py::int_>(PyLong_FromString(n.decimal().c_str(), nullptr, 10));
}

py::object to_python(const Rational& number) {
  if (const double* value = std::get_if<double>(&number)) return py::float_(*value);
  const Fraction& fraction = std::get<Fraction>(number);
  return fraction_class()(to_python(fraction.numerator), to_python(fraction.denominator));
}

py::tuple to_python(const ObstacleId& obstacle, const Components& count) {
  return py::make_tuple(obstacle.lattice, obstacle.atom,
                        to_python(obstacle.cell, count.of_cells(obstacle.lattice)));
}

Integer integer_from(const py::handle& n, const char* what) {
  const auto value = Integer::from_decimal(std::string(py::str(n)));
  if (!value) throw InputError(std::string(what) + ": needs an integer");
  return *value;
}

void bind_scene(py::module_& module) {
  py::class_<PyScene, std::shared_ptr<PyScene>>(module, "Scene")
      .def_static("from_json", &PyScene::from_json)
      .def_static("load", &PyScene::load)
      .def_property_readonly("dimension", &PyScene::dimension)
      .def_property_readonly("is_binary64", &PyScene::is_binary64)
      .def(
          "rank",  // of a lattice; the dimension if the scene has no lattice of this number (an error elsewhere)
          [](const PyScene& scene, std::int64_t lattice) {
            const auto& lattices = scene.exact().lattices;
            const auto l = static_cast<std::size_t>(lattice);
            return l < lattices.size() ? lattices[l].rank_in(scene.dimension()) : scene.dimension();
          })
      .def("nearest", [](const PyScene& scene) { return PyScene(scene.nearest()); })
      .def("to_dict", scene_dict);
  module.def("catalogue", catalogue_names);
}

}  // namespace lorentz::python
