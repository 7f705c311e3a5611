#include "compare/precisions/precisions.hpp"

#include <lorentz/answer.hpp>
#include <lorentz/scene.hpp>
#include "compare/precisions/big_number.hpp"
#include "compare/precisions/published_in.hpp"
#include "compare/precisions/wide_number.hpp"

namespace lorentz::compare {
namespace {

class Unsupported : public Engine {
 public:
  explicit Unsupported(const Scene& scene) : Engine(scene) {}

 private:
  void first_hit_scaled(const Ray&, double, Answer& answer) const override {
    answer = Answer::unsupported_because(
        "this precision does one ball a cell of the unit square or cubic lattice only, of radius 1/2 or "
        "less");
  }
};

template <class T>
std::unique_ptr<Engine> make(const Scene& scene) {
  return std::make_unique<PublishedIn<T>>(scene);
}

struct Entry {
  const char* name;
  std::unique_ptr<Engine> (*make)(const Scene&);
};

constexpr Entry kPrecisions[] = {
    {"published-float", make<float>},
    {"published-dd", make<Wide>},
    {"published-128", make<BigNumber<128>>},
    {"published-256", make<BigNumber<256>>},
};

}  // namespace

std::vector<std::string> precision_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kPrecisions) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Engine> make_precision(std::string_view name, const Scene& scene) {
  for (const Entry& entry : kPrecisions) {
    if (entry.name != name) continue;
    if (is_unit_scene(scene) && scene.lattices[0].atoms[0].radius <= 0.5) return entry.make(scene);
    return std::make_unique<Unsupported>(scene);
  }
  return nullptr;
}

}  // namespace lorentz::compare
