// The table of all engines: their names, the scenes that they do not support, and how they are made.
#include <lorentz/engine.hpp>
#include <lorentz/reduction.hpp>
#include "src/engines/base/unsupported.hpp"
#include "src/engines/classical/cell_walk.hpp"
#include "src/engines/classical/classical.hpp"
#include "src/engines/golse.hpp"
#include "src/engines/published/published.hpp"

namespace lorentz {
namespace {

// One ball in the middle of each unit cell, and no other obstacle that reaches into the cell.
bool is_one_ball_a_cell(const Scene& scene) {
  return is_unit_scene(scene) && scene.lattices[0].atoms[0].radius <= 0.5;
}

std::optional<std::string> beyond_classical(const Scene& scene) {
  return is_one_ball_a_cell(scene) ? std::nullopt : CellWalk::beyond(scene);
}

std::unique_ptr<Engine> make_classical(const Scene& scene) {
  if (is_one_ball_a_cell(scene)) return std::make_unique<Classical>(scene);
  return std::make_unique<CellWalk>(scene);
}

template <class E>
std::unique_ptr<Engine> make(const Scene& scene) {
  return std::make_unique<E>(scene);
}

constexpr const char* kCrystals = "does crystals only: lattices that repeat in all directions";

// An engine: its name, whether it supports crystals only, why it does not support a scene (or nothing), and
// how it is made.
struct EngineEntry {
  const char* name;
  bool crystals_only;
  std::optional<std::string> (*beyond)(const Scene&);
  std::unique_ptr<Engine> (*make)(const Scene&);
};

constexpr EngineEntry kEngines[] = {
    {"classical", true, beyond_classical, make_classical},
    {"published", true, Published::beyond, make<Published>},
    {"golse", true, Golse::beyond, make<Golse>},
    {"reduction", false, Reduction::beyond, make<Reduction>},
};

}  // namespace

std::unique_ptr<Engine> make_engine(std::string_view name, const Scene& scene) {
  for (const EngineEntry& entry : kEngines) {
    if (entry.name != name) continue;
    checked(scene);
    const bool is_beyond = entry.crystals_only && !is_crystal(scene);
    const auto why = is_beyond ? std::optional<std::string>(kCrystals) : entry.beyond(scene);
    if (why) return std::make_unique<Unsupported>(scene, std::string(name) + ' ' + *why);
    return entry.make(scene);
  }
  return nullptr;
}

}  // namespace lorentz
