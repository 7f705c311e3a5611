// The engine alone: lorentz::engine needs only the standard library.
#include <cstdio>
#include <lorentz/engine.hpp>

int main() {
  const auto engine = lorentz::make_engine("reduction", lorentz::unit_scene(2, 0.1));
  const lorentz::Answer answer =
      engine->first_hit({{0, 0.445, 0}, {0.9998476951563913, 0.01745240643728351, 0}, {}});
  std::printf("cell (%s, %s) at %.17g\n", answer.obstacle.cell[0].decimal().c_str(),
              answer.obstacle.cell[1].decimal().c_str(), *answer.time);
}
