#include "fuzz/examine/subject.hpp"

#include "cases/parts.hpp"

namespace lorentz::fuzz {

void Subject::set_scene(const Scene& scene) {
  if (scene_ && cases::same(*scene_, scene)) return;
  change_scene(scene);
  scene_ = scene;
}

}  // namespace lorentz::fuzz
