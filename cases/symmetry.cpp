#include "cases/symmetry.hpp"

#include <utility>

namespace lorentz::cases {

Symmetry::Symmetry(Random& random, int dimension) {
  for (int i = dimension - 1; i > 0; --i)
    std::swap(from_[i], from_[random.below(static_cast<std::uint64_t>(i) + 1)]);
  for (int i = 0; i < dimension; ++i) sign_[i] = random.one_in(2) ? 1 : -1;
}

Vec Symmetry::operator()(const Vec& a) const {
  Vec image{};
  for (int i = 0; i < 3; ++i) image[i] = a[from_[i]] == 0 ? 0.0 : sign_[i] * a[from_[i]];
  return image;
}

Query Symmetry::operator()(const Query& query) const {
  Query image{(*this)(query.x), (*this)(query.v), query.from};
  for (int i = 0; image.from && i < 3; ++i)
    image.from->cell[i] = Integer(sign_[i] * query.from->cell[from_[i]].int64());
  return image;
}

}  // namespace lorentz::cases
