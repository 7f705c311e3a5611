#include "tests/digests/scenes.hpp"

namespace lorentz::digests {
namespace {

Atom ball(const Vec& position, double radius) {
  return {position, radius, {}};
}

Atom ellipsoid(std::vector<Vec> semiaxes) {
  return {{}, 0, std::move(semiaxes)};
}

}  // namespace

Scene oblique_motif() {
  return {2, {{{{{1, 0, 0}, {0.25, 1.25, 0}}}, {ball({}, 0.2), ball({0.5, 0.7, 0}, 0.07)}}}};
}

Scene superposition() {
  constexpr double kCosine = 0.8090169943749475, kSine = 0.5877852522924731;
  return {2,
          {{{{{1, 0, 0}, {0, 1, 0}}}, {ball({}, 0.01)}},
           {{{{kCosine, kSine, 0}, {-kSine, kCosine, 0}}}, {ball({0.3, 0.1, 0}, 0.03)}}}};
}

Scene leaning_ellipses() {
  return {2, {{{{{1, 0, 0}, {0.25, 1.25, 0}}}, {ellipsoid({{0.16, 0.12, 0}, {-0.05, 0.07, 0}})}}}};
}

Scene leaning_ellipsoids() {
  return {3,
          {{{{{1, 0, 0}, {0.25, 1, 0}, {-0.125, 0.25, 1.125}}},
            {ellipsoid({{0.2, 0.2, -0.1}, {-0.07, 0.14, 0.14}, {0.1, -0.05, 0.1}})}}}};
}

Scene close_packing() {
  return {3,
          {{{{{1, 0, 0}, {-0.5, 0.8660254037844386, 0}, {0, 0, 1.632993161855452}}},
            {ball({0, 0.5773502691896257, 0.408248290463863}, 0.1),
             ball({0.5, 0.28867513459481287, 1.224744871391589}, 0.1)}}}};
}

}  // namespace lorentz::digests
