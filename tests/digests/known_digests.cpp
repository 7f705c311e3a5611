// The digests that `print_digests` prints, which are the same on every computer. After a new engine, a new
// family or an intended change of bits, take them from there.
#include "tests/digests/digests.hpp"

namespace lorentz::digests {
namespace {

// `fast`: reduction, with and without FMA, and batch, which give the same bits. `published`: 0 in a scene
// that is not for it.
constexpr struct {
  const char* family;
  std::uint64_t fast, classical, published = 0;
} kFamilies[] = {
    {"discs", 0x83568d254609cfc8, 0x6b22a9877f2728a2, 0x7135a3dfa3306011},
    {"small-discs", 0xc8bfc7fa32c382e2, 0x712ec471540d298a, 0xb5401a6cfbea77e5},
    {"discs-near-rational", 0xbd772724b2fc1c91, 0x7013a852c4fd9fe0},
    {"discs-grazing", 0x57183269f230e041, 0x6385e335c8adc7ee, 0x9eddbd976ccc997e},
    {"discs-far", 0x4b0f6a2edff8b4c0, 0x0547ba3b7a563b2f, 0xff444828319bb32c},
    {"oblique-motif", 0x678114857903c2af, 0x56815d12eb161639, 0x247caff4544d6a21},
    {"superposition", 0xc618a537bfaf0463, 0x3b1b4a821e4439a7, 0xb1402c75aac5c320},
    {"ellipses", 0xe826a983d4990f0a, 0x1d8b5de5471526c1},
    {"ellipses-near-rational", 0x661fa15b7f35a23e, 0xc0761d18aecad880},
    {"spheres", 0x9e5e1875fa1fad1f, 0xdf731455b458b0a2, 0x3dd9af1e03ef1e9f},
    {"small-spheres", 0x37e49916a4b09b3c, 0x0f1003dad8b54a6e},
    {"spheres-near-rational", 0xaca52ac1ee51f418, 0x10ac10204a6e62ff},
    {"spheres-grazing", 0xec88d96b1b4f07b9, 0x32a504c46f6e1aea, 0xaf1b6fe8c533cea0},
    {"spheres-far", 0x584c556b600aea8a, 0x88871dc5079777ab, 0xaaec6cef29b2d4c4},
    {"close-packing", 0x43d5f23ac3bd7b19, 0x3c75ba19eabd197d, 0x3008947aaadfbbdb},
    {"close-packing-grazing", 0xd737a291cb167144, 0x570a4d2dc5c3ab91, 0xa8c2b75b152a114d},
    {"ellipsoids", 0xdcf35314ffdc7ff1, 0x32cd3e640baa4982},
    {"ellipsoids-near-rational", 0xe1f148177c663353, 0x6c13b7dddbcb8e42},
};

constexpr struct {
  const char* scene;
  std::uint64_t starts, binary64, double_double;
} kScenes[] = {
    {"discs", 0x2722969aa28ea6ab, 0x56fda8d6690b09cb, 0x949ef8f224c68316},
    {"ellipses", 0x04c6589245a070ac, 0x02d1261ae7a2e954, 0xd70fed871caa230a},
    {"superposition", 0x6ebb5094e5c3ccd1, 0xcd9bb6b7c9b90cf8, 0xe0277a97b0d4c8df},
    {"spheres", 0x49075153a9ca99b6, 0x247c93ded2f6c2c2, 0x4e44305fecaf7dbe},
    {"ellipsoids", 0xb1e71160b8a12a2a, 0xf3b9821abd73c0ba, 0xc53ecf6538bb4c39},
};

std::vector<Digest> all_known() {
  std::vector<Digest> all;
  for (const auto& [family, fast, classical, published] : kFamilies) {
    const std::string name = std::string(family) + ' ';
    for (const char* engine : {"reduction", "reduction-without-fma", "batch"})
      all.push_back({name + engine, fast});
    all.push_back({name + "classical", classical});
    if (published != 0) all.push_back({name + "published", published});
  }
  for (const auto& [scene, starts, binary64, double_double] : kScenes) {
    all.push_back({std::string("starts ") + scene, starts});
    all.push_back({std::string("paths ") + scene + " binary64", binary64});
    all.push_back({std::string("paths ") + scene + " double-double", double_double});
  }
  return all;
}

}  // namespace

const std::vector<Digest>& known_digests() {
  static const std::vector<Digest> known = all_known();
  return known;
}

}  // namespace lorentz::digests
