#include "src/engines/reduction/shape.hpp"

#include <algorithm>
#include <cmath>

#include <lorentz/geometry.hpp>
#include "src/engines/reduction/bounds.hpp"

namespace lorentz {
namespace {

using WideMatrix = Wide[3][3];

double frobenius(const WideMatrix& a) {
  double sum = 0;
  for (const auto& row : a)
    for (const Wide& entry : row) sum += entry.hi * entry.hi;
  return std::sqrt(sum) * (1 + 0x1p-40);
}

void set_rounded(const WideMatrix& wide, Vec (&rounded)[3]) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) rounded[i][k] = wide[i][k].hi;
}

// a x b; each component errs by at most 4 u^2 |a| |b|.
void set_cross(const Vec& a, const Vec& b, Wide (&row)[3]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    row[i] = Wide::product(a[j], b[k]) - Wide::product(a[k], b[j]);
  }
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
  // adj(A) and det(A), with the sizes of the terms they were summed from.
  WideMatrix adjugate;
  for (int i = 0; i < 3; ++i) set_cross(a[(i + 1) % 3], a[(i + 2) % 3], adjugate[i]);
  Wide det(0.0);
  for (int k = 0; k < 3; ++k) det = det + adjugate[0][k] * a[0][k];
  if (d == 3) shape.radius = std::cbrt(std::fabs(det.hi));
  const double r = shape.radius;
  if (!(r > 0x1p-100 && r < 0x1p100)) return std::nullopt;
  const double longest = std::max({length(a[0]), length(a[1]), length(a[2])});
  const double adjugate_error = 16 * 0x1p-106 * longest * longest,
               det_error = 64 * 0x1p-106 * longest * longest * longest / std::fabs(det.hi);  // relative
  // N = (r / det) adj(A), G = N^T N, C = (r^2 / det) A^T.
  const Wide factor = Wide(r) / det;
  WideMatrix N;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      N[i][k] = adjugate[i][k] * factor;
      shape.wide_cofactor[i][k] = factor * r * a[i][k];
    }
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      shape.metric[i][k] = Wide(0.0);
      for (int j = 0; j < 3; ++j) shape.metric[i][k] = shape.metric[i][k] + N[j][i] * N[j][k];
    }
  set_rounded(N, shape.to_ball);
  set_rounded(shape.wide_cofactor, shape.cofactor);
  shape.volume = std::fabs((factor * factor * factor * det * det).hi);
  const double size = frobenius(N),
               N_error = size * det_error + std::fabs(factor.hi) * adjugate_error + 32 * 0x1p-106 * size;
  shape.metric_size = size * size;
  shape.metric_error = 2 * size * N_error + 64 * 0x1p-106 * size * size;
  shape.cofactor_size = frobenius(shape.wide_cofactor);
  shape.cofactor_error = shape.cofactor_size * (det_error + 64 * 0x1p-106);
  shape.condition = size * shape.cofactor_size / shape.volume * (1 + 0x1p-40);
  shape.inverse_height_scale = 1 / std::fabs(shape.cofactor[2][2]);
  shape.along_error = 16 * shape.condition * kRoundoff * size / r;
  // So that in binary64 the metric's own error never counts.
  const double worst = shape.metric_error / shape.metric_size * shape.condition * shape.condition;
  if (!(shape.condition < kMaxCondition && worst < 0x1p-62)) return std::nullopt;
  return shape;
}

}  // namespace lorentz
