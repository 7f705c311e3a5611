// The bounds of what an ellipsoid's shape is computed with (src/engines/reduction/shape.hpp, docs/bounds.md),
// against 120 digits: never exceeded, and reached to some part, or they would say nothing.
#include "src/engines/reduction/shape.hpp"

#include <boost/multiprecision/mpfr.hpp>
#include <catch2/catch.hpp>

#include "src/engines/reduction/reduce_3d.hpp"
#include "tests/support/support.hpp"

using namespace lorentz;
using namespace lorentz::test;

namespace {

using Real = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<120>>;
using RealVec = std::array<Real, 3>;

Real inner(const RealVec& a, const RealVec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RealVec outer(const RealVec& a, const RealVec& b) {
  return {Real(a[1] * b[2] - a[2] * b[1]), Real(a[2] * b[0] - a[0] * b[2]), Real(a[0] * b[1] - a[1] * b[0])};
}

RealVec real(const Vec& a) {
  return {Real(a[0]), Real(a[1]), Real(a[2])};
}

Real wide(const Wide& a) {
  return Real(a.hi) + Real(a.lo);
}

double number(const Real& a) {
  return static_cast<double>(a);
}

// The shape without rounding: N, G, C from the semiaxes and the radius of the rounded one.
struct ExactShape {
  RealVec N[3], C[3];
  Real G[3][3];

  explicit ExactShape(const Shape& shape) {
    RealVec a[3] = {real(shape.semiaxes[0]), real(shape.semiaxes[1]), real(shape.semiaxes[2])};
    const Real det = inner(a[0], outer(a[1], a[2])), r = shape.radius;
    for (int i = 0; i < 3; ++i) {
      N[i] = outer(a[(i + 1) % 3], a[(i + 2) % 3]);
      for (int k = 0; k < 3; ++k) {
        N[i][k] *= r / det;
        C[i][k] = r * r / det * a[i][k];
      }
    }
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        G[i][k] = 0;
        for (int j = 0; j < 3; ++j) G[i][k] += N[j][i] * N[j][k];
      }
  }

  RealVec to_ball(const RealVec& a) const { return {inner(N[0], a), inner(N[1], a), inner(N[2], a)}; }
};

// Ellipsoids of all proportions that are done.
Shape shape_drawn(Draw& draw, int dimension) {
  for (;;) {
    std::vector<Vec> semiaxes;
    const double size = std::exp2(draw.between(-20, -1));
    for (int i = 0; i < dimension; ++i) {
      Vec axis = draw.vec(dimension, -size, size);
      const double thin = draw.one_in(2) ? 1 : std::exp2(draw.between(-10, 0));
      for (double& component : axis) component *= thin;
      semiaxes.push_back(axis);
    }
    if (const auto shape = shape_of(semiaxes)) return *shape;
  }
}

// The largest share of its bound that an error took.
struct Share {
  double largest = 0;
  void see(const Real& error, double bound) { largest = std::max(largest, std::fabs(number(error)) / bound); }
};

Scene scene_of_shape(const Shape& shape, int dimension) {
  Scene scene = unit_scene(dimension, 1);
  scene.lattices[0].atoms[0] = {{}, 0, {shape.semiaxes, shape.semiaxes + dimension}};
  return scene;
}

}  // namespace

TEST_CASE("Metric, cofactors, volume and condition of a shape", "[engines][shape]") {
  Draw draw(91);
  INFO("seed 91");
  Share metric, cofactor;
  for (int i = 0; i < 20'000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Shape shape = shape_drawn(draw, dimension);
    const ExactShape exact(shape);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        metric.see(wide(shape.metric[j][k]) - exact.G[j][k], shape.metric_error);
        cofactor.see(wide(shape.wide_cofactor[j][k]) - exact.C[j][k], shape.cofactor_error);
      }
    Real size2 = 0, inverse2 = 0;
    for (int j = 0; j < 3; ++j) {
      size2 += inner(exact.N[j], exact.N[j]);
      for (const double component : shape.semiaxes[j]) inverse2 += Real(component) * component;
    }
    REQUIRE(shape.metric_size >= number(size2));
    REQUIRE(shape.condition >= number(sqrt(Real(size2 * inverse2)) / shape.radius));
    REQUIRE(shape.volume == Approx(1).epsilon(1e-9));
  }
  CHECK(metric.largest < 1);
  CHECK(metric.largest > 0.003);
  CHECK(cofactor.largest < 1);
  CHECK(cofactor.largest > 0.003);
}

TEST_CASE("2D: the width of an ellipse, and where along the line it is", "[engines][shape]") {
  Draw draw(92);
  INFO("seed 92");
  Share rho, along, skew;
  for (int i = 0; i < 20'000; ++i) {
    const Shape shape = shape_drawn(draw, 2);
    const ExactShape exact(shape);
    const Vec v = draw.vec(2, -2, 2), d = draw.vec(2, -100, 100);
    WidthOfShape<SplitProduct> width;
    double v2, rho_of_v, s_rho;
    width.set(shape, {v[0], v[1]}, v2, rho_of_v, s_rho);
    const RealVec w = exact.to_ball(real(v)), there = exact.to_ball(real(d));
    const Real true_rho = sqrt(inner(w, w)) * shape.radius / abs(exact.C[2][2]), s = inner(w, there);
    rho.see((rho_of_v - true_rho) / true_rho, width.rho_error);
    const double length = std::fabs(d[0]) + std::fabs(d[1]);
    along.see(s - (width.along[0] * d[0] + width.along[1] * d[1]), width.along_error * length);
    // s = ((v . d) v2 + h skew) / v.v
    const Real h = Real(v[0]) * d[1] - Real(v[1]) * d[0], v_d = Real(v[0]) * d[0] + Real(v[1]) * d[1],
               euclidean = Real(v[0]) * v[0] + Real(v[1]) * v[1];
    REQUIRE(number(v_d * inner(w, w) / euclidean + h * width.skew / euclidean) ==
            Approx(number(s)).margin(8 * width.along_error * length).epsilon(0));
  }
  CHECK(rho.largest < 1);
  CHECK(rho.largest > 0.1);
  CHECK(along.largest < 1);
  CHECK(along.largest > 0.02);
}

TEST_CASE("3D: across the line in units of an ellipsoid, and along it", "[engines][shape]") {
  Draw draw(93);
  INFO("seed 93");
  Share across, along;
  long done = 0;
  while (done < 5'000) {
    const Shape shape = shape_drawn(draw, 3);
    const PreparedScene scene = prepare(scene_of_shape(shape, 3));
    if (!scene.beyond.empty()) continue;
    ++done;
    const ExactShape exact(shape);
    const Vec v = draw.vec(3, -2, 2);
    Direction3<true, false> direction;
    direction.set<SplitProduct>(scene.atoms[0], {v[0], v[1], v[2]}, true);
    const RealVec d = real(draw.vec(3, -1, 1)), w = exact.to_ball(real(v)), there = exact.to_ball(d);
    const RealVec h = outer(w, there);
    const Real exact_p2 = inner(h, h) / inner(w, w) / shape.radius / shape.radius;
    Real p2 = 0, s = 0;
    for (int i = 0; i < 2; ++i) {
      Real p = 0;
      for (int k = 0; k < 3; ++k) p += wide(direction.cartesian[i][k]) * d[k];
      p *= direction.scale[i];
      p2 += p * p;
    }
    for (int k = 0; k < 3; ++k) s += wide(direction.cartesian[2][k]) * d[k];
    across.see((p2 - exact_p2) / exact_p2, direction.scale_error);
    along.see(s - inner(w, there), 4 * (kAnchorTerms * direction.along_size + shape.metric_error) *
                                       number(abs(d[0]) + abs(d[1]) + abs(d[2])));
    REQUIRE(exact_p2 <= Real(direction.inverse_r) * direction.inverse_r * inner(d, d));
  }
  CHECK(across.largest < 1);
  CHECK(across.largest > 0.02);
  CHECK(along.largest < 1);
}

TEST_CASE("Inside an ellipsoid: kInsideEllipsoid", "[engines][shape]") {
  Draw draw(94);
  INFO("seed 94");
  Share share;
  for (int i = 0; i < 20'000; ++i) {
    const int dimension = draw.one_in(2) ? 2 : 3;
    const Shape shape = shape_drawn(draw, dimension);
    const ExactShape exact(shape);
    Vec y = draw.vec(dimension, -1, 1), d{};
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < dimension; ++j) d[k] += shape.semiaxes[j][k] * y[j];
    double form = 0, square = 0;
    for (int j = 0; j < dimension; ++j) {
      square += d[j] * d[j];
      for (int k = 0; k < dimension; ++k) form += shape.metric[j][k].hi * d[j] * d[k];
    }
    const RealVec there = exact.to_ball(real(d));
    const double r = shape.radius, limit = r * r;
    share.see((inner(there, there) - Real(r) * r) - (form - limit),
              kInsideEllipsoid * kRoundoff * (shape.metric_size * square + limit));
  }
  CHECK(share.largest < 1);
  CHECK(share.largest > 0.05);
}
