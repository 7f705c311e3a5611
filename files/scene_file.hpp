// Scenes on the command line, and the checks that every scene passes before it is used.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/claim.hpp>
#include <lorentz/rational.hpp>
#include "files/unknown_keys.hpp"

namespace lorentz {

/// A scene that has a name.
struct CatalogueEntry {
  std::string name, file;
};

/// The catalogue, by name.
std::vector<CatalogueEntry> catalogue();

/// The file of a scene of the catalogue, or the file itself. Throws FileError, listing the catalogue.
std::string find_scene(const std::string& name_or_file);

/// The same text, which names queries. Throws FileError if there is no such file and a scene of the catalogue
/// seems to be meant: that is what --scene is for.
const std::string& queries_file(const std::string& file);

/// A scene of the catalogue (data/scenes/NAME.toml) or a file; with `radius`, every ball gets that radius.
/// Unknown keys are warned of, or errors. Throws InputError or FileError.
Scene read_scene(const std::string& name_or_file, std::optional<double> radius,
                 UnknownKeys unknown = UnknownKeys::warned);

/// The same, with a warning of overlaps.
Scene load_scene(const std::string& name_or_file, std::optional<double> radius,
                 UnknownKeys unknown = UnknownKeys::warned);

/// The same for what is done in crystals only, such as "flights are counted". Throws InputError if a lattice
/// repeats in fewer directions.
Scene load_crystal(const std::string& name_or_file, std::optional<double> radius, const std::string& what);

/// Its numbers rounded to the format. Throws InputError if that leaves a flaw: a radius of 0, vectors that depend on
/// each other.
Scene rounded_scene(const Scene& scene, NumberFormat format, const std::string& name_or_file);

/// A scene whose numbers may be rational (texts like "1/3").
RationalScene load_rational_scene(const std::string& name_or_file, const std::optional<Rational>& radius,
                                  UnknownKeys unknown = UnknownKeys::warned);

/// Warns on stderr if obstacles of one lattice overlap or touch: a radius above half the spacing is mostly a
/// typing error. (Those of two lattices nearly always do, somewhere.)
void warn_of_overlaps(const Scene& scene, const std::string& place);

}  // namespace lorentz
