// All engines by name: the binary64 engines, the oracle, walk, other programs, and functions of the caller.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/answer.hpp>
#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>
#include "question/answerer.hpp"
#include "question/introduction.hpp"
#include "question/scene_engine.hpp"

namespace lorentz::question {

/// An engine as a value. Its name is looked up once, where a user gives it.
struct EngineInfo {
  enum class Kind {
    own,      ///< an engine of this program
    command,  ///< `cmd:COMMAND`: an external program, which reads a query stream and writes an answer stream
    library,  ///< `lib:FILE.so`: a shared library with the interface of <lorentz/engine.h>
    guest     ///< a function of the caller
  };
  std::string name;
  Traits traits = {};  ///< all false for a command or a library; for a guest only `together` is not 0
  Kind kind = Kind::own;
  /// Makes it for a valid scene. Empty unless the kind is `own`.
  std::function<SceneEngine(const Scene&)> in = {};
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

/// Their names.
std::vector<std::string> own_names();

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

/// Adds the detail to a hit that has a time and an obstacle of the scene, if binary64 can compute it.
void add_detail(const Query& query, const Scene& scene, Answer& answer);

}  // namespace lorentz::question
