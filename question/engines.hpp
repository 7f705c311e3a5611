// All engines by name: the binary64 engines, the oracle, walk, other programs, and functions of the caller.
#pragma once

#include <functional>
#include <memory>
#include <optional>
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

/// Answers the queries of one scene, into an existing answer. Only the oracle gives `digits`. A detail that
/// binary64 cannot compute is left out.
using FirstHit = std::function<void(const Query&, const oracle::Request&, Answer&)>;

/// Properties of an engine that decide how its answers are treated.
struct Traits {
  bool is_exact = false;          ///< its answers rest on exact arithmetic
  bool knows_digits = false;      ///< gives digits of times beyond those of a binary64
  bool leaves_undecided = false;  ///< on purpose: `undecided` for a hard query is not a failure
  bool uses_reduction = false;    ///< so `certified`, which rests on `reduction`, cannot judge it
  bool in_bulk = false;           ///< slow with one query at a time, so its answerer gathers queries
};

/// An engine as a value. Its name is looked up once, where a user gives it.
struct EngineInfo {
  enum class Kind {
    own,      ///< an engine of this program
    command,  ///< `cmd:COMMAND`: an external program, which reads a query stream and writes an answer stream
    library,  ///< `lib:FILE.so`: a shared library with the interface of <lorentz/engine.h>
    guest     ///< a function of the caller
  };
  std::string name;
  Traits traits = {};  ///< all false for a command or a library; for a guest only in_bulk is true
  Kind kind = Kind::own;
  /// Answers one query at a time in a valid scene. A batch engine uses the engine of single flights that it
  /// agrees with. Empty unless the kind is `own`, because the others would be slow this way.
  std::function<FirstHit(const Scene&)> first_hit = {};
  /// Makes an answerer, for many queries at a time. Any number of threads may call it; each uses its own
  /// answerer.
  std::function<std::unique_ptr<Answerer>(const AnswererOptions&)> answerer = {};

  /// Returns its introduction. Empty for an engine of this program and for a guest.
  std::function<std::optional<Introduction>()> introduce = {};

  bool is_own() const { return kind == Kind::own; }
  bool is_command() const { return kind == Kind::command; }
  /// True if it runs in a process of its own, which takes time to start, and may die or hang.
  bool runs_apart() const { return kind == Kind::command || kind == Kind::library; }
};

/// The table of this program's engines.
const std::vector<EngineInfo>& own_engines();

/// Their names; and the same for help texts, with `cmd:COMMAND` and `lib:FILE.so`.
std::vector<std::string> own_names();
std::string names_for_help();

/// The engine of this program with this name, or null.
const EngineInfo* own_engine(std::string_view name);

/// An engine of this program, a command, or a library, which is loaded. `timeout`: the seconds that this may
/// take, and the introduction of either (default: AnswererOptions::kDefaultTimeout; ten seconds for that of a
/// command). Throws InputError for an unknown name or an empty command, FileError for a library that cannot be
/// loaded.
EngineInfo engine_named(const std::string& name, std::optional<double> timeout = {});

/// The engines in arguments like `reduction,published`. Commands and files may contain commas: from `cmd:` or
/// `lib:` on an argument is taken whole. Throws as engine_named.
std::vector<EngineInfo> engines_named(const std::vector<std::string>& arguments,
                                      std::optional<double> timeout = {});

/// Their names.
std::vector<std::string> names_of(const std::vector<EngineInfo>& engines);

/// A function of the caller, as an engine with a name of its own. Throws InputError if the name is taken.
EngineInfo guest_engine(std::string name,
                        std::function<std::unique_ptr<Answerer>(const AnswererOptions&)> make);

/// The engine whose answers are the truth by which other engines are judged.
enum class Truth {
  oracle,    ///< the exact oracle: shares no arithmetic with any engine
  certified  ///< the same answers, many times faster, if the fast engine's filters are right
};

inline constexpr const char* kJudgeHelp =
    "whose answers are the truth: oracle, or certified, which is faster and rests on reduction";

/// The truth that `--judge NAME` selects. Throws InputError for an unknown name, and if a judged engine rests
/// on the engine that would judge it.
Truth truth_named(const std::string& name, const std::vector<EngineInfo>& judged);

/// Adds the detail to a hit that has a time and an obstacle of the scene, if binary64 can compute it.
void add_detail(const Query& query, const Scene& scene, Answer& answer);

}  // namespace lorentz::question
