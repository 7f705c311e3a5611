#include "src/engines/published/published_bravais.hpp"

#include <Eigen/SVD>
#include <cmath>

#include <lorentz/engine_base.hpp>
#include <lorentz/geometry.hpp>
#include "src/engines/published/published_search.hpp"

namespace lorentz {

using namespace published_search;

namespace {

// The paper's sigma_1 of the matrix with these rows.
template <int kDimension>
double first_singular_value(const std::array<Vec, 3>& rows) {
  Eigen::Matrix<double, kDimension, kDimension> matrix;
  for (int i = 0; i < kDimension; ++i)
    for (int k = 0; k < kDimension; ++k) {
      if (!std::isfinite(rows[i][k])) return kNoLimit;
      matrix(i, k) = rows[i][k];
    }
  return Eigen::JacobiSVD<Eigen::Matrix<double, kDimension, kDimension>>(matrix).singularValues()(0);
}

}  // namespace

PublishedBravais::PublishedBravais(const Scene& scene, int l, int a)
    : dimension_(scene.dimension),
      lattice_(l),
      atom_(a),
      radius_(scene.lattices[l].atoms[a].is_ball() ? scene.lattices[l].atoms[a].radius : 1),
      position_(scene.lattices[l].atoms[a].position) {
  for (int i = 0; i < dimension_; ++i) vectors_[i] = scene.lattices[l].vectors[i];
  dual_ = dual_of(vectors_, dimension_);
  std::array<Vec, 3> image = dual_;
  if (const Atom& atom = scene.lattices[l].atoms[a]; !atom.is_ball()) {
    const std::array<Vec, 3> axes = semiaxes_of(atom, dimension_);
    shape_ = dual_of(axes, dimension_);
    for (int i = 0; i < dimension_; ++i)
      for (int k = 0; k < dimension_; ++k) image[i][k] = dot(dual_[i], axes[k]);
  }
  circumscribed_ =
      radius_ * (dimension_ == 2 ? first_singular_value<2>(image) : first_singular_value<3>(image));
}

std::optional<std::string> PublishedBravais::beyond(const Scene& scene, int l, int a) {
  std::vector<Vec> vectors = scene.lattices[l].atoms[a].semiaxes;
  for (int i = 0; i < scene.dimension; ++i) vectors.push_back(scene.lattices[l].vectors[i]);
  for (const Vec& vector : vectors)
    for (const double component : vector)
      if (component != 0 && !(std::fabs(component) > 0x1p-200 && std::fabs(component) < 0x1p200))
        return "does lattice vectors and semiaxes with components between 2^-200 and 2^200 only";
  const PublishedBravais bravais(scene, l, a);
  if (!(bravais.circumscribed_ <= 0.5))
    return "does cells only in which the circumscribed radius, the first singular value of the cell's "
           "inverse times r or the semiaxes, is at most half the spacing, 1/2";
  if (!(bravais.circumscribed_ > 0x1p-200)) return "does radii above 2^-200 of the cell only";
  for (const Vec& row : bravais.shape_)
    if (!(std::fabs(row[0]) + std::fabs(row[1]) + std::fabs(row[2]) < 0x1p200))
      return "does ellipsoids thicker than 2^-200 only";
  return std::nullopt;
}

// x in the coordinates of the square or cubic lattice: M_os (x - p).
Vec PublishedBravais::transformed_place(const Vec& x) const {
  return coordinates(dual_, minus(x, position_));
}

// x relative to the centre of the obstacle in cell n, in coordinates in which this is a ball of radius_: the
// scene's for a ball, A^-1 of these for an ellipsoid.
Vec PublishedBravais::relative(const Vec& x, const Vec& n) const {
  Vec arm = minus(x, position_);
  for (int i = 0; i < dimension_; ++i)
    for (int k = 0; k < dimension_; ++k) arm[k] -= n[i] * vectors_[i][k];
  return coordinates(shape_, arm);
}

bool PublishedBravais::leaves(const Ray& ray, Vec& n) const {
  return ray.from && ray.from->lattice == lattice_ && ray.from->atom == atom_ && cell_of(*ray.from, n);
}

ObstacleId PublishedBravais::obstacle_of(const Vec& n) const {
  ObstacleId id{lattice_, atom_, {}};
  for (int i = 0; i < 3; ++i) id.cell[i] = Integer(std::llround(n[i]));
  return id;
}

// The circumscribed balls do not overlap, so only the nearest obstacle can contain x.
std::optional<Answer> PublishedBravais::start(const Ray& ray) const {
  const Vec place = transformed_place(ray.x);
  for (const double component : place)
    if (!(std::fabs(component) < kMaxStart))
      return Answer::unsupported_because("start too far from the origin for binary64");
  const Vec home{std::round(place[0]), std::round(place[1]), std::round(place[2])};
  const Vec arm = relative(ray.x, home);
  Vec from{};
  if (!(dot(arm, arm) < radius_ * radius_) || (leaves(ray, from) && from == home)) return std::nullopt;
  return Answer::inside(obstacle_of(home));
}

Answer PublishedBravais::flight_of(const Ray& ray, double limit, Proposals& proposals) const {
  return dimension_ == 2 ? flight_2d(ray, limit, proposals) : flight_3d(ray, limit, proposals);
}

Answer PublishedBravais::flight_2d(const Ray& ray, double limit, Proposals& proposals) const {
  const Vec v = coordinates(dual_, ray.v), true_v = coordinates(shape_, ray.v);
  Vec x = transformed_place(ray.x), from{};
  const bool has_from = leaves(ray, from);
  Disc<double> last{from[0], from[1]};
  const Disc<double>* leaving = has_from ? &last : nullptr;
  double elapsed = 0;
  long passes = Published::kMaxTotalPasses;
  for (long round = 0; round < Published::kMaxRounds && elapsed <= limit; ++round) {
    if (!(std::fabs(x[0]) < kMaxStart && std::fabs(x[1]) < kMaxStart)) return Answer::undecided();
    const auto result = first_disc<double>({x[0], x[1]}, {v[0], v[1]}, circumscribed_, leaving, passes);
    if (auto answer = answer_for(result.found)) return *answer;
    ++proposals.made;
    // The classical quadratic in the scene, from the place that is closest to the circumscribed disc.
    const Vec centre{result.disc[0], result.disc[1], 0}, arm = minus(x, centre);
    const double near = elapsed - dot(arm, v) / dot(v, v);
    const Vec there{ray.x[0] + near * ray.v[0], ray.x[1] + near * ray.v[1], 0};
    const Vec true_arm = relative(there, centre);
    const auto entry = entry_time(true_arm, true_v, radius_);
    const bool is_ahead = near > dot(true_arm, true_v) / dot(true_v, true_v);
    if (entry && is_ahead && !(has_from && centre == from))
      return Answer::hit(obstacle_of(centre), std::max(near + *entry, 0.0));
    ++proposals.false_ellipse;
    const double leaves_after = exit_time(arm, v, circumscribed_);
    if (!(leaves_after > 0) && leaving && last == result.disc) return Answer::undecided();  // no way on
    for (int i = 0; i < 2; ++i) x[i] += std::max(leaves_after, 0.0) * v[i];
    elapsed += std::max(leaves_after, 0.0);
    last = result.disc;
    leaving = &last;
  }
  return elapsed > limit ? Answer::never() : Answer::undecided();
}

Answer PublishedBravais::flight_3d(const Ray& ray, double limit, Proposals& proposals) const {
  Vec v = coordinates(dual_, ray.v);
  const double speed = std::sqrt(dot(v, v));
  for (double& component : v) component /= speed;
  Vec from{};
  const bool has_from = leaves(ray, from);
  const auto is_hit = [&](const Vec& n, const Vec& x, double elapsed) -> std::optional<double> {
    ++proposals.made;
    const bool meets_ball = entry_time(minus(x, n), v, circumscribed_).has_value();
    if (!meets_ball) ++proposals.false_tricylinder;
    // The classical quadratic in the scene, from the place reached.
    const double now = elapsed / speed;
    Vec there{};
    for (int k = 0; k < 3; ++k) there[k] = ray.x[k] + now * ray.v[k];
    const auto entry = entry_time(relative(there, n), coordinates(shape_, ray.v), radius_);
    if (!entry && meets_ball) ++proposals.false_ellipse;
    if (!entry || !(*entry >= 0) || (has_from && n == from)) return std::nullopt;
    return *entry * speed;
  };
  const auto result = first_sphere<double>(transformed_place(ray.x), v, circumscribed_,
                                           {Published::kMaxTotalPasses, true}, limit * speed, is_hit);
  if (result.none) return *result.none;
  return Answer::hit(obstacle_of(result.centre), result.distance / speed);
}

}  // namespace lorentz
