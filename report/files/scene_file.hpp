// Scenes on the command line, and the checks that every scene passes before it is used.
#pragma once

#include <map>
#include <optional>
#include <string>

#include <lorentz/claim.hpp>
#include <lorentz/rational.hpp>
#include "report/files/unknown_keys.hpp"

namespace lorentz {

/// The scenes of the catalogue, and their files.
std::map<std::string, std::string> catalogue();

/// The file of a scene of the catalogue, or the file itself. Throws FileError, listing the catalogue.
std::string find_scene(const std::string& name_or_file);

/// Returns the name of a file of queries. Throws FileError if there is no such file and the name is that of a
/// scene of the catalogue, which --scene takes.
const std::string& queries_file(const std::string& file);

/// A scene of the catalogue (data/scenes/NAME.toml) or a file; with `radius`, every ball gets that radius.
/// Unknown keys give warnings or errors. Throws InputError or FileError.
Scene read_scene(const std::string& name_or_file, std::optional<double> radius, bool strict = false);

/// The same, with a warning about overlaps.
Scene load_scene(const std::string& name_or_file, std::optional<double> radius, bool strict = false);

/// The same for tasks that need a crystal; `what` names the task, such as "flights are counted". Throws
/// InputError if a lattice repeats in fewer directions.
Scene load_crystal(const std::string& name_or_file, std::optional<double> radius, const std::string& what);

/// The scene with its numbers rounded to the format. Throws InputError if that makes it invalid: a radius of
/// 0, or vectors that are linearly dependent.
Scene rounded_scene(const Scene& scene, NumberFormat format, const std::string& name_or_file);

/// A scene whose numbers may be rational (texts like "1/3").
RationalScene load_rational_scene(const std::string& name_or_file, const std::optional<Rational>& radius,
                                  bool strict = false);

/// Warns on stderr if obstacles of one lattice overlap or touch, because a radius above half the spacing is
/// usually a typing error. (Obstacles of two lattices nearly always overlap somewhere.)
void warn_of_overlaps(const Scene& scene, const std::string& place);

}  // namespace lorentz
