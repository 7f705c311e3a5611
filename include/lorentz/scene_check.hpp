// What only exact arithmetic can say of a scene: are its vectors independent, do obstacles touch or overlap?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/obstacle.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// For a scene that lorentz::flaw_of passed: what is wrong with it nevertheless (dependent primitive vectors
/// or semiaxes, decided exactly), or nothing.
std::optional<std::string> dependence_in(const Scene& scene);

/// Two obstacles that have a point in common. Each pair counts once, up to lattice translations.
struct Contact {
  int lattice = 0, atom = 0;  ///< the obstacle of this atom in the cell 0 ..
  int other_lattice = 0, other_atom = 0;
  std::optional<Cell>
      cell;  ///< .. and of the other in this cell; of two lattices: somewhere (once a pair of atoms)
  bool overlap = false;  ///< the open obstacles have points in common; else only their boundaries
};

/// Obstacles of one lattice, or of any two as well. (Two lattices with incommensurate vectors overlap
/// somewhere: binary64 makes them commensurate, but finely.)
enum class Pairs { within_lattices, all };

/// How far a search for contacts came.
enum class SearchEnd {
  complete,
  limit,  ///< there may be more than the contacts asked for
  budget  ///< given up: too many pairs to look at, so nothing is known of those not found
};

struct Contacts {
  std::vector<Contact> found;
  SearchEnd end = SearchEnd::complete;
};

/// Pairs of obstacles looked at before a search is given up: some seconds, 10^5 atoms of a crystal.
inline constexpr long kContactBudget = 1'000'000;

/// The first `limit` contacts, decided exactly. Throws InputError for a scene with a flaw or dependent vectors.
Contacts contacts_in(const Scene& scene, std::size_t limit, Pairs pairs = Pairs::all,
                     long budget = kContactBudget);

/// The contact in words, cells left out.
std::string description_of(const Contact& contact);

}  // namespace lorentz::oracle
