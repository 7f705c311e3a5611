// Checks of a scene that need exact arithmetic: are its vectors independent, do obstacles touch or overlap?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lorentz/obstacle.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::oracle {

/// What is wrong with a scene that passed lorentz::flaw_of (dependent primitive vectors or semiaxes, decided
/// exactly), or nothing.
std::optional<std::string> dependence_in(const Scene& scene);

/// Two obstacles that have a point in common. Each pair counts once, up to lattice translations.
struct Contact {
  int lattice = 0, atom = 0;  ///< the first obstacle: this atom in the cell 0
  int other_lattice = 0, other_atom = 0;
  std::optional<Cell>
      cell;  ///< the other obstacle's cell; not set for two lattices: somewhere (once per pair of atoms)
  bool overlap = false;  ///< the open obstacles have points in common; otherwise only their boundaries do
};

/// Which pairs to examine: obstacles of one lattice, or also those of any two. (Two lattices with
/// incommensurate vectors overlap somewhere: binary64 makes them commensurate, but finely.)
enum class Pairs { within_lattices, all };

/// How a search for contacts ended.
enum class SearchEnd {
  complete,
  limit,  ///< there may be more contacts than were requested
  budget  ///< gave up: too many pairs to examine, so nothing is known about contacts that were not found
};

struct Contacts {
  std::vector<Contact> found;
  SearchEnd end = SearchEnd::complete;
};

/// Number of pairs of obstacles that a search examines before it gives up (a few seconds; 10^5 atoms of a
/// crystal).
inline constexpr long kContactBudget = 1'000'000;

/// The first `limit` contacts, decided exactly. Throws InputError if the scene is invalid or has dependent
/// vectors.
Contacts contacts_in(const Scene& scene, std::size_t limit, Pairs pairs = Pairs::all,
                     long budget = kContactBudget);

/// The contact in words, without cells.
std::string description_of(const Contact& contact);

}  // namespace lorentz::oracle
