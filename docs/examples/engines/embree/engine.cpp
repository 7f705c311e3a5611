// Embree: rtcIntersect1 through sphere points (RTC_GEOMETRY_TYPE_SPHERE_POINT), with Embree's own tree.
// Binary32; 2D as the plane z = 0. It has its own walk: a scene of Embree is a block with 9 cells per side
// around the current cell of the ray. A ray that leaves the block continues in a new block, in coordinates of
// the cell that it has reached. So coordinates are always those of cells. Single balls are one block, without
// a walk.
//
// Formula: nearest point on the line (stable), then half the chord. The spheres are two-sided, so a start
// that rounding puts inside gets the exit. A filter function leaves out the ball of `from`.
#include <embree3/rtcore.h>

#include <set>

#include "../walk.hpp"

constexpr int kHalf = 4;

struct Ball {
  int atom;
  Vec n, centre;
  float r;
};

struct Context {
  RTCIntersectContext base;
  unsigned skip;  // the ball of `from`
};

struct Block {
  RTCScene scene;
  std::vector<Ball> balls;
};

class Embree {
 public:
  ~Embree() { clear(), rtcReleaseDevice(device_); }

  void use(const Scene& scene) {
    measure(0);
    clear();
    for (const Lattice& lattice : scene.lattices) blocks_.push_back(block_of(lattice));
  }

  Found first(const Scene& scene, const Query& query) {
    for (const double c : query.v)  // Debian's build would end the program (`ray.valid()`)
      if (std::abs(c) > kLargest) throw Unsupported("Embree takes no direction beyond 1.844e18");
    Found found;
    for (std::size_t number = 0; number < blocks_.size(); ++number)
      fly(scene.lattices[number], static_cast<int>(number), query, found);
    measure(kCasts);
    return found;
  }

  double seconds() { return measure(0), seconds_; }

  static std::string version() {
    RTCDevice device = rtcNewDevice(nullptr);
    std::string text = std::to_string(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MAJOR)) + '.' +
                       std::to_string(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MINOR)) + '.' +
                       std::to_string(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_PATCH));
    rtcReleaseDevice(device);
    return text;
  }

 private:
  static constexpr double kLargest = 1.844e18;  // FLT_LARGE in Embree's sources
  static constexpr int kMostBlocks = 5000;
  static constexpr std::size_t kCasts = 256;

  void clear() {
    for (Block& block : blocks_) rtcReleaseScene(block.scene);
    blocks_.clear();
  }

  Block block_of(const Lattice& lattice) {
    Block block{rtcNewScene(device_), balls_of(lattice)};
    RTCGeometry points = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(
        points, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), block.balls.size()));
    for (const Ball& ball : block.balls) {
      for (const double c : ball.centre) *to++ = static_cast<float>(c);
      *to++ = ball.r;
    }
    rtcSetGeometryIntersectFilterFunction(points, [](const RTCFilterFunctionNArguments* a) {
      if (RTCHitN_primID(a->hit, a->N, 0) == reinterpret_cast<Context*>(a->context)->skip) a->valid[0] = 0;
    });
    rtcCommitGeometry(points);
    rtcAttachGeometry(block.scene, points);
    rtcReleaseGeometry(points);
    rtcCommitScene(block.scene);
    return block;
  }

  static std::vector<Ball> balls_of(const Lattice& lattice) {
    std::vector<Ball> balls;
    std::set<std::pair<int, Vec>> seen;
    std::array<int, 3> half{};
    for (std::size_t k = 0; k < lattice.rank; ++k) half[k] = kHalf;
    if (lattice.rank == 3 && lattice.near.size() > 200) throw Unsupported("too many balls in a block");
    for (int i = -half[0]; i <= half[0]; ++i)
      for (int j = -half[1]; j <= half[1]; ++j)
        for (int k = -half[2]; k <= half[2]; ++k)
          for (const auto& near : lattice.near) {
            const Vec cell{double(i), double(j), double(k)}, n = add(cell, near.n);
            if (seen.insert({near.atom, n}).second)
              balls.push_back({near.atom, n, add(lattice.at(cell), near.centre), static_cast<float>(near.r)});
          }
    return balls;
  }

  void fly(const Lattice& lattice, int number, const Query& query, Found& found) {
    double start = 0;
    for (int step = 0; step < kMostBlocks; ++step) {
      const Vec p = add(query.x, query.v, start);
      Vec cell{};
      double leave = INFINITY;
      for (std::size_t k = 0; k < lattice.rank; ++k) {
        const double y = dot(lattice.dual[k], p), s = dot(lattice.dual[k], query.v);
        cell[k] = std::floor(y);
        if (s != 0)
          leave = std::min(leave, (s > 0 ? cell[k] + 1 + kHalf - y : y - cell[k] + kHalf) / std::abs(s));
      }
      const Vec q = add(p, lattice.at(cell), -1);
      const unsigned skip = look_around(number, cell, q, query, step == 0, found);
      RTCRayHit ray = ray_of(q, query.v);
      casts_.push_back({blocks_[number].scene, ray, skip});
      cast(casts_.back(), ray);
      if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        const Ball& ball = blocks_[number].balls[ray.hit.primID];
        found.add_hit(start + ray.ray.tfar, {number, ball.atom, add(cell, ball.n)});
        return;
      }
      if (found.inside || std::isinf(leave)) return;
      start += leave;
    }
    found.undecided = true;
  }

  // Returns the ball of the block to leave out. At the start it also finds the balls that contain the start,
  // because Embree does not report them.
  unsigned look_around(int number, const Vec& cell, const Vec& q, const Query& query, bool at_start,
                       Found& found) const {
    unsigned skip = RTC_INVALID_GEOMETRY_ID;
    if (!at_start && !query.from) return skip;
    const std::vector<Ball>& balls = blocks_[number].balls;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const Name name{number, balls[i].atom, add(cell, balls[i].n)};
      const Vec w = add(balls[i].centre, q, -1);
      if (name == query.from)
        skip = static_cast<unsigned>(i);
      else if (at_start && static_cast<float>(dot(w, w)) < balls[i].r * balls[i].r)
        found.add_inside(name);
    }
    return skip;
  }

  static RTCRayHit ray_of(const Vec& q, const Vec& v) {
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(q[0]), ray.ray.dir_x = static_cast<float>(v[0]);
    ray.ray.org_y = static_cast<float>(q[1]), ray.ray.dir_y = static_cast<float>(v[1]);
    ray.ray.org_z = static_cast<float>(q[2]), ray.ray.dir_z = static_cast<float>(v[2]);
    ray.ray.tfar = INFINITY, ray.ray.mask = ~0u, ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return ray;
  }

  struct Cast {
    RTCScene scene;
    RTCRayHit ray;
    unsigned skip;
  };

  static void cast(const Cast& what, RTCRayHit& ray) {
    Context context;
    rtcInitIntersectContext(&context.base);
    context.skip = what.skip;
    rtcIntersect1(what.scene, &context.base, &ray);
  }

  void measure(std::size_t at_least) {  // as Stopwatch in walk.hpp, but for rays through blocks
    if (casts_.empty() || casts_.size() < at_least) return;
    const auto start = std::chrono::steady_clock::now();
    for (const Cast& each : casts_) {
      RTCRayHit ray = each.ray;
      cast(each, ray);
    }
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    casts_.clear();
  }

  RTCDevice device_ = rtcNewDevice("threads=1");
  std::vector<Block> blocks_;
  std::vector<Cast> casts_;
  double seconds_ = 0;
};

int main() {
  Embree engine;
  return Server(engine, Claim{"Embree", Embree::version(), "binary32", {2, 3}}).run();
}
