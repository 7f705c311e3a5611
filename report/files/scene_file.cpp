#include "report/files/scene_file.hpp"

#include <fmt/format.h>

#include <filesystem>

#include <lorentz/exchange.hpp>
#include <lorentz/itinerary.hpp>
#include <lorentz/scene_check.hpp>
#include "report/files/data_folder.hpp"
#include "report/files/messages.hpp"
#include "src/exchange/nearest_name.hpp"
#include "src/problem/safe_text.hpp"

namespace lorentz {

namespace fs = std::filesystem;

std::map<std::string, std::string> catalogue() {
  std::map<std::string, std::string> scenes;
  for (const std::string& file : data_files("scenes", ".toml")) scenes[fs::path(file).stem()] = file;
  return scenes;
}

static std::vector<std::string> names_in_catalogue() {
  std::vector<std::string> names;
  for (const auto& [name, file] : catalogue()) names.push_back(name);
  return names;
}

const std::string& queries_file(const std::string& file) {
  std::error_code error;
  if (file == "-" || fs::exists(file, error) || error) return file;
  if (const std::string scene = nearest_name(file, names_in_catalogue()); !scene.empty())
    throw FileError(fmt::format("{}: no such file (a scene is given by --scene {})", file, scene));
  return file;
}

std::string find_scene(const std::string& name_or_file) {
  std::error_code error;
  const bool is_name = name_or_file.find('/') == std::string::npos;
  const fs::file_status status = fs::status(name_or_file, error);
  if (fs::exists(status) && !(is_name && fs::is_directory(status))) return name_or_file;
  const auto scenes = catalogue();
  if (const auto found = scenes.find(name_or_file); found != scenes.end()) return found->second;
  const std::vector<std::string> names = names_in_catalogue();
  const std::string shown = shortened(name_or_file, 200);
  if (fs::is_directory(status)) throw FileError(shown + ": is a directory; a scene is a file");
  if (names.empty())
    throw FileError(fmt::format("{}: no such file, and no catalogue of scenes (looked for in {})", shown,
                                data_places("scenes")));
  const std::string missing = fmt::format("{}: no such file, and no scene of the catalogue{}; it has {}",
                                          shown, did_you_mean(shown, names), fmt::join(names, ", "));
  if (is_name && fs::path(name_or_file).extension().empty()) throw InputError(missing);  // a mistyped name
  throw FileError(missing);
}

namespace {

// Gives every ball this radius, if there is one.
template <class AScene, class Number>
void set_radius(AScene& scene, const std::optional<Number>& radius, const std::string& name) {
  if (!radius) return;
  for (auto& lattice : scene.lattices)
    for (auto& atom : lattice.atoms) {
      if (!atom.is_ball())
        throw InputError("--radius: " + name + " has semiaxes, which have no radius to override");
      atom.radius = *radius;
    }
}

}  // namespace

RationalScene load_rational_scene(const std::string& name_or_file, const std::optional<Rational>& radius,
                                  bool strict) {
  KeyCheck keys(name_or_file, strict);
  RationalScene scene =
      read_rational_scene_file(find_scene(name_or_file), [&](const std::string& key) { keys(key); });
  set_radius(scene, radius, name_or_file);
  const oracle::Itinerary check(scene);  // throws InputError
  warn_of_overlaps(oracle::nearest(scene), name_or_file);
  return scene;
}

Scene read_scene(const std::string& name_or_file, std::optional<double> radius, bool strict) {
  KeyCheck keys(name_or_file, strict);
  Scene scene = read_scene_file(find_scene(name_or_file), [&](const std::string& key) { keys(key); });
  set_radius(scene, radius, name_or_file);
  if (auto flaw = oracle::dependence_in(scene)) throw InputError(name_or_file + ": " + *flaw);
  return scene;
}

Scene load_scene(const std::string& name_or_file, std::optional<double> radius, bool strict) {
  Scene scene = read_scene(name_or_file, radius, strict);
  warn_of_overlaps(scene, name_or_file);
  return scene;
}

Scene rounded_scene(const Scene& scene, NumberFormat format, const std::string& name_or_file) {
  if (format == NumberFormat::binary64) return scene;
  const Scene all = rounded(scene, format);
  auto flaw = flaw_of(all);
  if (!flaw) flaw = oracle::dependence_in(all);
  if (flaw) throw InputError(name_or_file + ": rounded to " + name_of(format) + ": " + *flaw);
  return all;
}

Scene load_crystal(const std::string& name_or_file, std::optional<double> radius, const std::string& what) {
  Scene scene = load_scene(name_or_file, radius);
  if (!is_crystal(scene))
    throw InputError("--scene: " + what + " in crystals only; " + name_or_file +
                     " has lattices that repeat in fewer directions");
  return scene;
}

void warn_of_overlaps(const Scene& scene, const std::string& place) {
  if (flaw_of(scene) || oracle::dependence_in(scene)) return;  // rational numbers, invalid in binary64
  const oracle::Contacts contacts = oracle::contacts_in(scene, 20, oracle::Pairs::within_lattices);
  const oracle::Contact* worst = nullptr;  // one that touches, unless some overlap
  for (const oracle::Contact& contact : contacts.found)
    if (!worst || (contact.overlap && !worst->overlap)) worst = &contact;
  if (worst)
    say("warning: {}: {}; answers stay exact, but is {} what you meant?", place,
        oracle::description_of(*worst),
        scene.lattices[worst->lattice].atoms[worst->atom].is_ball() ? "the radius" : "that");
  else if (contacts.end == oracle::SearchEnd::budget)
    say("{}: whether obstacles overlap was not checked: there are too many pairs to look at; answers stay "
        "exact",
        place);
}

}  // namespace lorentz
