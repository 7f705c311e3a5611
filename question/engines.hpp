// Everything that answers queries: the binary64 engines, the oracle, walk, other programs, and functions of a
// caller's.
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
#include "question/answerer.hpp"
#include "question/introduction.hpp"

namespace lorentz::question {

/// Answers the queries of one scene, into an answer that is there already. `digits` are the oracle's only; a
/// detail that binary64 cannot compute is left out.
using FirstHit = std::function<void(const Query&, const oracle::Request&, Answer&)>;

/// What an answerer is like, for those who treat its answers accordingly.
struct Traits {
  bool is_exact = false;          ///< its answers rest on exact arithmetic
  bool knows_digits = false;      ///< of times, beyond those of a binary64
  bool leaves_undecided = false;  ///< on purpose: `undecided` is what it says of hard queries, no failure
  bool uses_reduction = false;    ///< so that `certified`, which rests on `reduction`, cannot judge it
  bool in_bulk = false;           ///< slow one at a time: its answerer gathers queries
};

/// An engine as a value. Its name is looked up once, where a user gives it.
struct EngineInfo {
  enum class Kind {
    own,      ///< of this program
    command,  ///< `cmd:COMMAND`: another program, which reads a query stream and writes an answer stream
    library,  ///< `lib:FILE.so`: a shared library with the interface of <lorentz/engine.h>
    guest     ///< a function of the caller's
  };
  std::string name;
  Traits traits = {};  ///< all false of a command and a library; of a guest only in_bulk is true
  Kind kind = Kind::own;
  /// One at a time, for a scene without flaws; a batch engine is the engine of single flights that it agrees
  /// with. Empty but for `own`: others would be slow that way.
  std::function<FirstHit(const Scene&)> first_hit = {};
  /// Many at a time. Any number of threads may call it, each for itself.
  std::function<std::unique_ptr<Answerer>(const AnswererOptions&)> answerer = {};

  /// What it says of itself. Empty where it has nothing to say: of an engine of this program, or a guest.
  std::function<std::optional<Introduction>()> introduce = {};

  bool is_own() const { return kind == Kind::own; }
  bool is_command() const { return kind == Kind::command; }
  /// In a process of its own, which takes time to start, and may die or hang.
  bool runs_apart() const { return kind == Kind::command || kind == Kind::library; }
};

/// The table of this program's engines.
const std::vector<EngineInfo>& own_engines();

/// Their names; and the same for help texts, with `cmd:COMMAND` and `lib:FILE.so`.
std::vector<std::string> own_names();
std::string names_for_help();

/// The one with this name, or null.
const EngineInfo* own_engine(std::string_view name);

/// An engine of this program, a command, or a library. Throws InputError for an unknown name, or a command that is
/// empty; FileError for a library that cannot be loaded.
EngineInfo engine_named(const std::string& name);

/// The engines in arguments like `reduction,published`. A command and a file may contain commas: from `cmd:` or `lib:`
/// on an argument is taken whole. Throws as engine_named.
std::vector<EngineInfo> engines_named(const std::vector<std::string>& arguments);

/// Their names.
std::vector<std::string> names_of(const std::vector<EngineInfo>& engines);

/// The same arguments as names.
std::vector<std::string> names_in(const std::vector<std::string>& arguments);

/// A function of the caller's by a name of its own. Throws InputError if another engine has it.
EngineInfo guest_engine(std::string name,
                        std::function<std::unique_ptr<Answerer>(const AnswererOptions&)> make);

/// Adds the detail to a hit of an obstacle of the scene, with a time, where binary64 can compute it.
void add_detail(const Query& query, const Scene& scene, Answer& answer);

}  // namespace lorentz::question
