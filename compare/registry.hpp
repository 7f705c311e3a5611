// Everything that answers queries, by name: the binary64 engines, the oracle, walk, and other programs.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "compare/answerer.hpp"

namespace lorentz::compare {

/// Answers the queries of one scene, into an answer that is there already. `digits` are the oracle's only; a
/// detail that binary64 cannot compute is left out.
using FirstHit = std::function<void(const Query&, const oracle::Request&, Answer&)>;

/// Makes an answerer.
using MakeAnswerer = std::function<std::unique_ptr<Answerer>(const AnswererOptions&)>;

/// An engine of the caller's own, by a name of its own while this lives: wherever engines are named that are
/// asked many at a time (make_answerer) it is one, too; who calls this program as a library judges a function
/// so. Any number of threads may make answerers of it, each for one thread.
class GuestEngine {
 public:
  /// Throws InputError if an engine of this name is there already.
  GuestEngine(std::string name, MakeAnswerer make);
  ~GuestEngine();
  GuestEngine(const GuestEngine&) = delete;
  GuestEngine& operator=(const GuestEngine&) = delete;

 private:
  std::string name_;
};

/// What an answerer is like, for those who treat its answers accordingly.
struct Traits {
  bool is_exact = false;          ///< its answers rest on exact arithmetic
  bool knows_digits = false;      ///< of times, beyond those of a binary64
  bool leaves_undecided = false;  ///< on purpose: `undecided` is what it says of hard queries, no failure
  bool uses_reduction = false;    ///< so that `certified`, which rests on `reduction`, cannot judge it
  bool in_bulk = false;           ///< slow one at a time: its answerer gathers queries
};

/// Of any other name, as of another program, nothing is known.
Traits traits_of(std::string_view name);

/// The names of all that this program answers with itself.
std::vector<std::string> answerer_names();

/// All names and `cmd:COMMAND`, for help texts.
std::string names_for_help();

/// True of the name of a GuestEngine.
bool is_guest(const std::string& name);

/// True for `cmd:COMMAND`: another program, which reads a query stream and writes an answer stream.
bool is_command(const std::string& name);

/// Throws InputError for an unknown name, or a command that is empty.
void check_name(const std::string& name);

/// The names in arguments like `reduction,published`. A command may contain commas: from `cmd:` on an
/// argument is taken whole.
std::vector<std::string> names_in(const std::vector<std::string>& arguments);

/// One at a time, for a scene without flaws. Not for commands, which would be slow that way; a batch engine
/// is the engine of single flights that it agrees with.
FirstHit make_first_hit(const std::string& name, const Scene& scene);

/// Many at a time, whoever it is.
std::unique_ptr<Answerer> make_answerer(const std::string& name, const AnswererOptions& options);

/// Adds the detail to a hit of an obstacle of the scene, with a time, where binary64 can compute it.
void add_detail(const Query& query, const Scene& scene, Answer& answer);

}  // namespace lorentz::compare
