#include "fuzz/examine/subject.hpp"

namespace lorentz::fuzz {

void Subject::set_scene(const Scene& scene) {
  if (scene_ && *scene_ == scene) return;
  change_scene(scene);
  scene_ = scene;
}

}  // namespace lorentz::fuzz
