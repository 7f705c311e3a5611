#include "src/engines/reduction/shape.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "src/engines/reduction/bounds.hpp"
#include "src/engines/reduction/formulas.hpp"

namespace lorentz {
namespace {

using WideMatrix = Wide[3][3];

double frobenius(const WideMatrix& a) {
  double sum = 0;
  for (const auto& row : a)
    for (const Wide& entry : row) sum += entry.hi * entry.hi;
  return std::sqrt(sum) * (1 + kAmple);
}

void set_rounded(const WideMatrix& wide, Vec (&rounded)[3]) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) rounded[i][k] = wide[i][k].hi;
}

// The cube roots of standard libraries differ in the last bit, and every answer among ellipsoids would differ
// with them. A Newton step in double-double makes them the same.
double cube_root(double x) {
  const double guess = std::cbrt(x);
  const Wide square = Wide::product(guess, guess);
  return guess + ((x - square * guess) / (3.0 * square)).value();
}

}  // namespace

std::optional<Shape> shape_of(const std::vector<Vec>& semiaxes) {
  Shape shape;
  const int d = static_cast<int>(semiaxes.size());
  std::copy(semiaxes.begin(), semiaxes.end(), shape.semiaxes);
  auto& a = shape.semiaxes;
  if (d == 2) {
    shape.radius = std::sqrt(std::fabs(a[0][0] * a[1][1] - a[0][1] * a[1][0]));
    a[2] = {0, 0, shape.radius};
  }
  ShapeForms<Wide> forms;
  forms.set_adjugate(a);
  if (d == 3) shape.radius = cube_root(std::fabs(forms.det.hi));
  const double r = shape.radius;
  if (!(r > 1 / kMaxShapeRadius && r < kMaxShapeRadius)) return std::nullopt;
  forms.set_forms(a, r);
  forms.set_metric();
  const Wide &det = forms.det, &factor = forms.factor;
  const double longest = std::max({length(a[0]), length(a[1]), length(a[2])});
  const double adjugate_error = kAdjugate * kWideRoundoff * longest * longest,
               det_error = kDeterminant * kWideRoundoff * longest * longest * longest /
                           std::fabs(det.hi);  // relative
  std::copy(&forms.cofactor[0][0], &forms.cofactor[0][0] + 9, &shape.wide_cofactor[0][0]);
  std::copy(&forms.metric[0][0], &forms.metric[0][0] + 9, &shape.metric[0][0]);
  set_rounded(forms.to_ball, shape.to_ball);
  set_rounded(shape.wide_cofactor, shape.cofactor);
  shape.volume = std::fabs((factor * factor * factor * det * det).hi);
  const double size = frobenius(forms.to_ball),
               N_error =
                   size * det_error + std::fabs(factor.hi) * adjugate_error + kToBall * kWideRoundoff * size;
  shape.metric_size = size * size;
  shape.metric_error = 2 * size * N_error + kMetric * kWideRoundoff * size * size;
  shape.cofactor_size = frobenius(shape.wide_cofactor);
  shape.cofactor_error = shape.cofactor_size * (det_error + kCofactor * kWideRoundoff);
  shape.condition = size * shape.cofactor_size / shape.volume * (1 + kAmple);
  shape.inverse_height_scale = 1 / std::fabs(shape.cofactor[2][2]);
  shape.along_error = kAlongOfShape * shape.condition * kRoundoff * size / r;
  // Ensures that in binary64 the metric's own error never counts.
  const double worst = shape.metric_error / shape.metric_size * shape.condition * shape.condition;
  if (!(shape.condition < kMaxCondition && worst < kMaxMetricError)) return std::nullopt;
  return shape;
}

}  // namespace lorentz
