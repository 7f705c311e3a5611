// Finds the obstacles that touch or overlap. The centres of two atoms' obstacles differ by c + a lattice.
// Only those differences matter that are near in a form in which "near" is necessary (for two balls, or two
// ellipsoids of one shape, also sufficient). They are enumerated exactly.
#include <algorithm>
#include <map>
#include <set>

#include <lorentz/scene_check.hpp>
#include "oracle/contacts/ellipsoid_pair.hpp"
#include "oracle/exact/exact_problem.hpp"
#include "oracle/exact/shape.hpp"
#include "oracle/exact/short_basis.hpp"

namespace lorentz::oracle {
namespace {

// An atom's obstacle, with all lengths multiplied by one power of two.
template <std::size_t D>
struct ContactBody {
  int lattice, atom;
  ZVec<D> position;
  bool ball;         // whether given by a radius or by semiaxes
  Z reach;           // the largest distance of a point from the centre, or more; the radius of a ball
  ZMatrix<D> shape;  // A A^T
};

// The largest eigenvalue of A A^T is the squared distance of the farthest point; the trace is at least that.
template <std::size_t D>
Z reach_of(const ZMatrix<D>& shape) {
  Z trace = 0;
  for (std::size_t i = 0; i < D; ++i) trace += shape[i][i];
  return ceil_sqrt(trace);
}

template <std::size_t D>
struct ExactLatticeBodies {
  std::size_t rank = D;
  Basis<D> reduced;
  std::vector<ContactBody<D>> bodies;
  Z far;  // more than the distance of any two obstacles in cells 0 of the scene, reaches included
};

// A lattice of fewer vectors is completed by vectors longer than `far`, more than the distance of any two
// obstacles. So its copies (exact_problem.hpp) are in contact with no obstacle.
template <std::size_t D>
void reduce_and_complete(Basis<D>& basis, std::size_t rank, const Z& far) {
  if (rank == D) return reduce(basis, euclidean_form);
  complete<D>(basis, rank);
  for (std::size_t i = rank; i < D; ++i) {
    const Z times = far / floor_sqrt(dot(basis[i].p, basis[i].p)) + 1;
    for (Z& component : basis[i].p) component *= times;
  }
}

template <std::size_t D>
std::vector<ExactLatticeBodies<D>> exact_bodies(const IntegerScene<D>& scene) {
  std::vector<ExactLatticeBodies<D>> result(scene.lattices.size());
  Z place = 0, reach = 0;
  for (std::size_t l = 0; l < result.size(); ++l) {
    const auto& lattice = scene.lattices[l];
    result[l].rank = lattice.rank;
    result[l].reduced = basis_of(lattice.vectors);
    for (const auto& atom : lattice.atoms) {
      const ZMatrix<D> shape = shape_of<D>(axes_of<D>(atom));
      const std::optional<Z> radius = ball_radius<D>(shape);
      const int index = static_cast<int>(result[l].bodies.size());
      result[l].bodies.push_back({static_cast<int>(l), index, atom.position, radius.has_value(),
                                  radius ? *radius : reach_of<D>(shape), shape});
      for (const Z& component : atom.position) place = std::max(place, Z(abs(component)));
      reach = std::max(reach, result[l].bodies.back().reach);
    }
  }
  const Z far = 4 * place + 2 * reach;  // 2 sqrt(D) < 4
  for (auto& one : result) one.far = far, reduce_and_complete<D>(one.reduced, one.rank, far);
  return result;
}

// The lattice of all differences between points of two lattices. Both sets of vectors generate it, and it is
// a lattice because all of them are integers. Rows are cleared column by column with Euclid's algorithm
// (Hermite normal form).
template <std::size_t D>
Basis<D> sum_of(const ExactLatticeBodies<D>& first, const ExactLatticeBodies<D>& second) {
  std::vector<LatticePoint<D>> rows(first.reduced.begin(), first.reduced.begin() + first.rank);
  rows.insert(rows.end(), second.reduced.begin(), second.reduced.begin() + second.rank);
  std::size_t rank = 0;
  for (std::size_t column = 0; column < D && rank < rows.size(); ++column) {
    for (std::size_t i = rank + 1; i < rows.size(); ++i)
      while (rows[i].p[column] != 0) {
        rows[rank].add_multiple(-floor_div(rows[rank].p[column], rows[i].p[column]), rows[i]);
        std::swap(rows[rank], rows[i]);
      }
    if (rows[rank].p[column] != 0) ++rank;
  }
  Basis<D> basis;
  std::copy_n(rows.begin(), rank, basis.begin());
  reduce_and_complete<D>(basis, rank, first.far);
  return basis;
}

// The number of steps that are left for a search.
class PairBudget {
 public:
  explicit PairBudget(long steps) : steps_(steps) {}
  bool spend(long steps = 1) { return (steps_ -= steps) >= 0; }
  bool spent() const { return steps_ < 0; }

 private:
  long steps_;
};

// A lattice with a quadratic form, and the search for its points near a given one.
template <std::size_t D>
class FormLattice {
 public:
  FormLattice(Basis<D> basis, const ZMatrix<D>& q) : q_(q), basis_(std::move(basis)) {
    reduce(basis_, [this](const LatticePoint<D>& a, const LatticePoint<D>& b) { return form(a, b); });
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) gram_[i][k] = form(basis_[i], basis_[k]);
    minors_[0] = 1;
    for (std::size_t i = 0; i < D; ++i) minors_[i + 1] = bordered(i, gram_[i], gram_[i], gram_[i][i]);
  }

  // Visits the points p of offset + the lattice with p.Q p <= bound, together with that value; stops when the
  // visitor returns true, or when the budget is spent. Starts with the outermost vector: its multiples are
  // those for which the part of the point perpendicular to the vectors before it is short enough.
  template <class Visit>
  bool visit_near(const LatticePoint<D>& offset, const Z& bound, PairBudget& budget, Visit visit) const {
    return visit_level(D, offset, bound, budget, visit);
  }

 private:
  // a.Q b
  Z form(const LatticePoint<D>& a, const LatticePoint<D>& b) const { return dot(a.p, q_ * b.p); }

  // The inner product of the parts of u and v perpendicular to the first `level` basis vectors, times the
  // Gram determinant of these vectors. It is the determinant of their Gram matrix bordered by their products
  // with u and v, with u.v in the corner.
  Z bordered(std::size_t level, const ZVec<D>& u, const ZVec<D>& v, const Z& uv) const {
    if (level == 0) return uv;
    if (level == 1) return gram_[0][0] * uv - u[0] * v[0];
    const Z &a = gram_[0][0], &b = gram_[0][1], &d = gram_[1][1];
    return (a * d - b * b) * uv - u[0] * (d * v[0] - b * v[1]) - u[1] * (a * v[1] - b * v[0]);
  }

  template <class Visit>
  bool visit_level(std::size_t level, const LatticePoint<D>& point, const Z& bound, PairBudget& budget,
                   Visit& visit) const {
    const Z length2 = form(point, point);
    if (level == 0) return visit(point, length2);
    const std::size_t i = level - 1;
    ZVec<D> products;
    for (std::size_t k = 0; k < level; ++k) products[k] = form(basis_[k], point);
    // a k^2 + 2 h k + c <= bound * minor
    const Z& a = minors_[level];
    const Z h = bordered(i, gram_[i], products, products[i]);
    const Z c = bordered(i, products, products, length2);
    const Z disc = h * h - a * (c - bound * minors_[i]);
    if (disc < 0) return false;
    const Z last = floor_surd(-h, +1, disc, a);
    for (Z k = -floor_surd(h, +1, disc, a); k <= last; ++k) {
      if (!budget.spend()) return true;
      LatticePoint<D> next = point;
      next.add_multiple(k, basis_[i]);
      if (visit_level(i, next, bound, budget, visit)) return true;
    }
    return false;
  }

  ZMatrix<D> q_;
  Basis<D> basis_;
  std::array<ZVec<D>, D> gram_;
  std::array<Z, D + 1> minors_;  // Gram determinants of the first 0, 1, .. basis vectors
};

// The test for two bodies: which differences c of their centres are near, and whether near is sufficient.
template <std::size_t D>
struct Nearness {
  ZMatrix<D> q;
  Z bound;          // the obstacles can meet only if c.Q c <= bound ..
  bool sufficient;  // .. and whether they then do; they touch iff both are equal
};

// Balls: |c| <= r1 + r2. Otherwise F(1/2) <= 1 (ellipsoid_pair.cpp): c.(S1 + S2)^-1 c <= 2, which is
// sufficient for S1 = S2.
template <std::size_t D>
Nearness<D> nearness_of(const ContactBody<D>& a, const ContactBody<D>& b) {
  if (a.ball && b.ball) return {multiple_of_identity<D>(1), (a.reach + b.reach) * (a.reach + b.reach), true};
  ZMatrix<D> sum = a.shape;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) sum[i][k] += b.shape[i][k];
  const ZMatrix<D> near = adjugate(sum);
  return {near, 2 * dot(near[0], sum[0]), a.shape == b.shape};
}

// Bodies sorted into equal boxes of a lattice's cell. A box is at least as wide as the distance at which two
// bodies can be in contact, so bodies in contact are in the same box or in neighbouring ones.
template <std::size_t D>
class Boxes {
 public:
  Boxes(const Basis<D>& basis, const std::vector<ContactBody<D>>& bodies) {
    Z reach = 0;
    for (const ContactBody<D>& body : bodies) reach = std::max(reach, body.reach);
    const Z det = determinant<D>(basis), size = abs(det);
    const auto most = static_cast<long>(std::ceil(std::pow(static_cast<double>(bodies.size()), 1.0 / D)));
    const ZMatrix<D> across = dual_of(basis);
    for (std::size_t i = 0; i < D; ++i) {
      // Along b_i the cell is |det| / |dual_i| wide.
      const Z boxes = floor_div(size, 2 * reach * ceil_sqrt(dot(across[i], across[i])));
      count_[i] = boxes > most ? most : std::max(1L, boxes.get_si());
    }
    for (std::size_t index = 0; index < bodies.size(); ++index) {
      std::array<long, D> box;
      for (std::size_t i = 0; i < D; ++i) {
        const Z place = floor_div(count_[i] * dot(across[i], bodies[index].position), size);
        box[i] = Z(place - count_[i] * floor_div(place, count_[i])).get_si();
      }
      box_of_.push_back(box);
      inside_[box].push_back(index);
    }
  }

  // The bodies with a number of at least `index` in its box and the boxes around it.
  std::vector<std::size_t> near(std::size_t index) const {
    std::set<std::array<long, D>> boxes{box_of_[index]};
    for (std::size_t i = 0; i < D; ++i)
      for (auto box : std::set(boxes))
        for (const long step : {1L, count_[i] - 1}) {
          auto next = box;
          next[i] = (next[i] + step) % count_[i];
          boxes.insert(next);
        }
    std::vector<std::size_t> found;
    for (const auto& box : boxes)
      if (const auto list = inside_.find(box); list != inside_.end())
        for (const std::size_t other : list->second)
          if (other >= index) found.push_back(other);
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  std::array<long, D> count_;
  std::vector<std::array<long, D>> box_of_;
  std::map<std::array<long, D>, std::vector<std::size_t>> inside_;
};

template <std::size_t D>
class ContactSearch {
 public:
  ContactSearch(const Scene& scene, std::size_t limit, long budget)
      : lattices_(exact_bodies(integer_scene<D>(scene))), limit_(limit), budget_(budget) {}

  Contacts run(Pairs pairs) {
    const std::size_t count = lattices_.size();
    for (std::size_t l = 0; l < count && !done(); ++l) within(l);
    if (pairs == Pairs::all)
      for (std::size_t l = 0; l < count && !done(); ++l)
        for (std::size_t m = l + 1; m < count && !done(); ++m) between(l, m);
    if (budget_.spent())
      contacts_.end = SearchEnd::budget;
    else if (contacts_.found.size() >= limit_)
      contacts_.end = SearchEnd::limit;
    return std::move(contacts_);
  }

 private:
  bool done() const { return contacts_.found.size() >= limit_ || budget_.spent(); }

  void within(std::size_t l) {
    const auto& bodies = lattices_[l].bodies;
    differences_ = lattices_[l].reduced;
    forms_.clear();
    const Boxes<D> boxes(differences_, bodies);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (const std::size_t k : boxes.near(i)) {
        if (done()) return;
        check_pair(bodies[i], bodies[k]);
      }
  }

  void between(std::size_t l, std::size_t m) {
    differences_ = sum_of<D>(lattices_[l], lattices_[m]);
    forms_.clear();
    for (const ContactBody<D>& a : lattices_[l].bodies)
      for (const ContactBody<D>& b : lattices_[m].bodies) {
        if (done()) return;
        check_pair(a, b);
      }
  }

  void check_pair(const ContactBody<D>& a, const ContactBody<D>& b) {
    if (!budget_.spend()) return;
    const bool itself = &a == &b, one_lattice = a.lattice == b.lattice;
    LatticePoint<D> offset;
    for (std::size_t k = 0; k < D; ++k) offset.p[k] = b.position[k] - a.position[k];
    const Nearness<D> near = nearness_of<D>(a, b);
    std::optional<Contact> somewhere;  // for two different lattices
    lattice_in(near.q).visit_near(
        offset, near.bound, budget_, [&](const LatticePoint<D>& c, const Z& length2) {
          // For an atom and itself, each pair is seen from both sides, before and after c = 0.
          if (itself && c.p == ZVec<D>{}) return true;
          const Relation relation = this->relation(near, a, b, c, length2);
          if (relation == Relation::apart) return false;
          Contact contact{a.lattice, a.atom, b.lattice, b.atom, std::nullopt, relation == Relation::overlap};
          if (!one_lattice) {
            somewhere = contact;
            return contact.overlap;
          }
          contact.cell.emplace();
          const int side = itself && c.n < ZVec<D>{} ? -1 : 1;
          for (std::size_t k = 0; k < D; ++k) (*contact.cell)[k] = to_integer(side * c.n[k]);
          contacts_.found.push_back(std::move(contact));
          return contacts_.found.size() >= limit_;
        });
    if (somewhere) contacts_.found.push_back(*somewhere);
  }

  const FormLattice<D>& lattice_in(const ZMatrix<D>& q) {
    constexpr std::size_t kMostKept = 1000;
    const auto known = forms_.find(q);
    if (known != forms_.end()) return known->second;
    if (forms_.size() >= kMostKept) forms_.clear();
    return forms_.emplace(q, FormLattice<D>(differences_, q)).first->second;
  }

  Relation relation(const Nearness<D>& near, const ContactBody<D>& a, const ContactBody<D>& b,
                    const LatticePoint<D>& c, const Z& length2) {
    constexpr long kPolynomialCost = 5;  // about this many pairs of balls
    if (near.sufficient) return length2 < near.bound ? Relation::overlap : Relation::touch;
    budget_.spend(kPolynomialCost);
    return relation_of<D>(a.shape, b.shape, c.p);
  }

  std::vector<ExactLatticeBodies<D>> lattices_;
  std::size_t limit_;
  PairBudget budget_;
  Contacts contacts_;
  Basis<D> differences_;                        // of the lattices in the current search
  std::map<ZMatrix<D>, FormLattice<D>> forms_;  // the same lattice in the forms that have occurred
};

}  // namespace

Contacts contacts_in(const Scene& scene, std::size_t limit, Pairs pairs, long budget) {
  checked_exactly(scene);
  return scene.dimension == 2 ? ContactSearch<2>(scene, limit, budget).run(pairs)
                              : ContactSearch<3>(scene, limit, budget).run(pairs);
}

std::string description_of(const Contact& contact) {
  const auto name = [](int lattice, int atom) {
    return "lattice " + std::to_string(lattice) + ", atom " + std::to_string(atom);
  };
  const std::string first = name(contact.lattice, contact.atom),
                    second = name(contact.other_lattice, contact.other_atom),
                    verb = contact.overlap ? " overlap" : " touch";
  if (first == second) return "the obstacles of " + first + verb + " their own translates";
  return "obstacles of " + first + " and of " + second + verb;
}

}  // namespace lorentz::oracle
