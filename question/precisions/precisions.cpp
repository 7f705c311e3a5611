#include "question/precisions/precisions.hpp"

#include <lorentz/answer.hpp>
#include <lorentz/scene.hpp>
#include "question/precisions/big_number.hpp"
#include "question/precisions/published_in.hpp"
#include "src/engines/base/unsupported.hpp"

namespace lorentz::question {
namespace {

constexpr const char* kBeyond =
    "this precision does one ball a cell of the unit square or cubic lattice only, of radius 1/2 or less";

template <class T>
std::unique_ptr<Engine> make(const Scene& scene) {
  return std::make_unique<PublishedIn<T>>(scene);
}

constexpr struct {
  const char* name;
  std::unique_ptr<Engine> (*make)(const Scene&);
} kPrecisions[] = {
    {"published-float", make<float>},
    {"published-256", make<BigNumber<256>>},
};

}  // namespace

std::vector<std::string> precision_names() {
  std::vector<std::string> names;
  for (const auto& entry : kPrecisions) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Engine> make_precision(std::string_view name, const Scene& scene) {
  for (const auto& entry : kPrecisions) {
    if (entry.name != name) continue;
    if (is_unit_scene(scene) && scene.lattices[0].atoms[0].radius <= 0.5) return entry.make(scene);
    return std::make_unique<Unsupported>(scene, kBeyond);
  }
  return nullptr;
}

}  // namespace lorentz::question
