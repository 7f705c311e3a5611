#include "engine.hpp"

#include <algorithm>
#include <cmath>

#include "classical.hpp"
#include "published.hpp"

namespace lorentz {
namespace {

class Unsupported : public Engine {
 public:
  Unsupported(const Scene& scene, std::string why) : Engine(scene), why_(std::move(why)) {}

 private:
  Answer first_hit_scaled(const Query&, double) const override { return Answer::unsupported_because(why_); }
  std::string why_;
};

}  // namespace

Answer Engine::first_hit(const Query& query, double max_time) const {
  if (auto flaw = flaw_of(query, scene_)) return Answer::error(*flaw);
  Query scaled = query;
  const int exponent =
      std::ilogb(std::max({std::fabs(query.v[0]), std::fabs(query.v[1]), std::fabs(query.v[2])}));
  for (double& component : scaled.v) component = std::scalbn(component, -exponent);
  Answer answer = first_hit_scaled(scaled, std::scalbn(max_time, exponent));
  if (answer.time) answer.time = std::scalbn(*answer.time, -exponent);
  return limited(std::move(answer), max_time);
}

namespace {

// Why the two known algorithms do not do a scene, or nothing.
std::optional<std::string> beyond_unit_lattices(const Scene& scene) {
  if (!is_unit_scene(scene)) return "does the unit square and cubic lattice with one ball at the origin only";
  if (scene.lattices[0].atoms[0].radius > 0.5) return "does radii up to half the spacing only";
  return std::nullopt;
}

template <class E>
std::unique_ptr<Engine> make(const Scene& scene) {
  return std::make_unique<E>(scene);
}

// All engines: name, why a scene is beyond it (or nothing), and how it is made.
struct Entry {
  const char* name;
  std::optional<std::string> (*beyond)(const Scene&);
  std::unique_ptr<Engine> (*make)(const Scene&);
};

constexpr Entry kEngines[] = {
    {"classical", beyond_unit_lattices, make<Classical>},
    {"published", beyond_unit_lattices, make<Published>},
};

}  // namespace

std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kEngines) names.push_back(entry.name);
  return names;
}

std::unique_ptr<Engine> make_engine(std::string_view name, const Scene& scene) {
  for (const Entry& entry : kEngines) {
    if (entry.name != name) continue;
    if (auto why = entry.beyond(scene))
      return std::make_unique<Unsupported>(scene, std::string(name) + ' ' + *why);
    return entry.make(scene);
  }
  return nullptr;
}

}  // namespace lorentz
