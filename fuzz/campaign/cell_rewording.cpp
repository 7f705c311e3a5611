// Other cells of one lattice.
//
// With an integer matrix M the vectors u'_j = sum_i M_ij u_i span a lattice in which the old one has
// q = |det M| classes: n and m are of one class if M^-1 (n - m) is an integer. Each atom p becomes q atoms
// p + c_k in the new scene, one for the representative c_k of each class, so that
//   n = M n' + c_k.
// At q = 1 this is another basis, at q > 1 a superlattice. M is a product of elementary matrices. Each of
// them is tried as large as it was drawn and then made smaller until the vectors are binary64 values. A power
// of two always works where the components do not meet; any number works where they have few bits.
#include <algorithm>

#include "fuzz/campaign/exact_sums.hpp"
#include "fuzz/campaign/rewording_steps.hpp"

namespace lorentz::fuzz {

using namespace cases;

namespace {

constexpr int kMostCellBits = 40, kLargestIndex = 8;
constexpr std::size_t kMostAtoms = 24;

bool is_multiple(const IntegerVec& a, const Z& of) {
  return std::all_of(a.begin(), a.end(), [&](const Z& component) { return component % of == 0; });
}

class NewCells {
 public:
  NewCells(int lattice, IntegerMatrix m, std::vector<IntegerVec> classes)
      : lattice_(lattice),
        m_(std::move(m)),
        adjugate_(adjugate(m_)),
        determinant_(determinant(m_)),
        classes_(std::move(classes)) {}

  std::string words() const {
    long bits = 0;
    for (const IntegerVec& column : m_)
      for (const Z& entry : column) bits = std::max(bits, oracle::bit_length(entry) - 1);
    return (classes_.size() > 1 ? "superlattice of " + std::to_string(classes_.size()) + " cells 2^"
                                : std::string("basis 2^")) +
           std::to_string(bits);
  }

  void there(ObstacleId& id) const {
    if (id.lattice != lattice_) return;
    const IntegerVec n = to_integers(id.cell);
    for (std::size_t k = 0; k < classes_.size(); ++k) {
      IntegerVec a;
      for (std::size_t i = 0; i < 3; ++i) a[i] = n[i] - classes_[k][i];
      a = adjugate_ * a;
      if (!is_multiple(a, determinant_)) continue;
      for (Z& component : a) component /= determinant_;
      id.cell = to_cell(a);
      id.atom = id.atom * static_cast<int>(classes_.size()) + static_cast<int>(k);
      return;
    }
  }

  void back(ObstacleId& id) const {
    if (id.lattice != lattice_) return;
    const int count = static_cast<int>(classes_.size());
    IntegerVec n = m_ * to_integers(id.cell);
    for (std::size_t i = 0; i < 3; ++i) n[i] += classes_[id.atom % count][i];
    id.cell = to_cell(n);
    id.atom /= count;
  }

 private:
  int lattice_;
  IntegerMatrix m_, adjugate_;
  Z determinant_;
  std::vector<IntegerVec> classes_;
};

// Vectors that change by elementary steps, as long as they are binary64 values and M is not too large.
class Changing {
 public:
  Changing(const std::array<Vec, 3>& vectors, int rank)
      : rank_(static_cast<std::uint64_t>(rank)), vectors_(vectors) {}

  // u_j += c u_i, with c as large as possible.
  void shear(Random& random) {
    if (rank_ < 2) return;
    const std::uint64_t j = random.below(rank_), i = (j + 1 + random.below(rank_ - 1)) % rank_;
    const bool power = random.one_in(2);
    int bits = static_cast<int>(random.one_in(2) ? random.below(4) : random.below(kMostCellBits + 1));
    const std::int64_t drawn =
        (std::int64_t{1} << bits) + (power ? 0 : random.integer(0, (std::int64_t{1} << bits) - 1));
    for (std::int64_t c = random.sign() > 0 ? drawn : -drawn; c != 0; c /= 2)
      if (add(i, j, c)) return;
  }

  void exchange(Random& random) {
    const std::uint64_t i = random.below(rank_), j = random.below(rank_);
    std::swap(vectors_[i], vectors_[j]);
    std::swap(m_[i], m_[j]);
    if (!random.one_in(2)) return;
    for (std::size_t k = 0; k < 3; ++k) {
      if (vectors_[i][k] != 0) vectors_[i][k] = -vectors_[i][k];
      m_[i][k] = -m_[i][k];
    }
  }

  // u_j *= factor.
  bool multiply(Random& random, std::int64_t factor) {
    const std::uint64_t j = random.below(rank_);
    const auto product = exact_sum({}, Z(static_cast<long>(factor)), vectors_[j]);
    if (!product) return false;
    vectors_[j] = *product;
    for (Z& entry : m_[j]) entry *= static_cast<long>(factor);
    return true;
  }

  const std::array<Vec, 3>& vectors() const { return vectors_; }
  const IntegerMatrix& matrix() const { return m_; }

 private:
  bool add(std::uint64_t i, std::uint64_t j, std::int64_t c) {
    IntegerVec column = m_[j];
    for (std::size_t k = 0; k < 3; ++k) {
      column[k] += Z(static_cast<long>(c)) * m_[i][k];
      if (oracle::bit_length(column[k]) > kMostCellBits + 1) return false;
    }
    const auto sum = exact_sum(vectors_[j], Z(static_cast<long>(c)), vectors_[i]);
    if (!sum) return false;
    vectors_[j] = *sum;
    m_[j] = std::move(column);
    return true;
  }

  std::uint64_t rank_;
  std::array<Vec, 3> vectors_;
  IntegerMatrix m_ = identity();
};

// A representative of each class, the first in a box that contains all classes.
std::vector<IntegerVec> classes_of(const IntegerMatrix& m, int rank) {
  const IntegerMatrix to_cells = adjugate(m);
  const Z index = abs(determinant(m));
  const long q = index.get_si();
  std::vector<IntegerVec> classes;
  for (long a = 0; a < q; ++a)
    for (long b = 0; b < (rank >= 2 ? q : 1); ++b)
      for (long c = 0; c < (rank == 3 ? q : 1); ++c) {
        const bool known = std::any_of(classes.begin(), classes.end(), [&](const IntegerVec& other) {
          return is_multiple(to_cells * IntegerVec{Z(a - other[0]), Z(b - other[1]), Z(c - other[2])}, index);
        });
        if (!known) classes.push_back({a, b, c});
        if (static_cast<long>(classes.size()) == q) return classes;
      }
  return classes;
}

// A copy of each atom for each class, or nothing if a position is not a binary64 value.
std::optional<std::vector<Atom>> copies_of(const Lattice& lattice, const std::vector<IntegerVec>& classes) {
  std::vector<Atom> atoms;
  for (const Atom& atom : lattice.atoms)
    for (const IntegerVec& c : classes) {
      const auto position = exact_sum(atom.position, c, lattice.vectors);
      if (!position) return std::nullopt;
      atoms.push_back(atom);
      atoms.back().position = *position;
    }
  return atoms;
}

std::optional<RewordingStep> draw_cells(Random& random, Scene& scene, std::int64_t factor) {
  const int l = static_cast<int>(random.below(scene.lattices.size()));
  Lattice& lattice = scene.lattices[l];
  const int rank = lattice.rank_in(scene.dimension);
  if (rank == 0 || lattice.atoms.size() * static_cast<std::size_t>(factor) > kMostAtoms) return std::nullopt;
  Changing changing(lattice.vectors, rank);
  for (std::uint64_t steps = random.below(4) + (factor == 1); steps > 0; --steps) changing.shear(random);
  if (factor > 1 && !changing.multiply(random, factor)) return std::nullopt;
  for (std::uint64_t steps = random.below(3); steps > 0; --steps) changing.shear(random);
  if (random.one_in(2)) changing.exchange(random);
  if (changing.matrix() == identity()) return std::nullopt;
  std::vector<IntegerVec> classes = classes_of(changing.matrix(), rank);
  auto atoms = copies_of(lattice, classes);
  if (!atoms) return std::nullopt;
  lattice.vectors = changing.vectors();
  lattice.atoms = std::move(*atoms);
  const NewCells cells(l, changing.matrix(), std::move(classes));
  return RewordingStep{.words = cells.words(),
                       .there = [cells](ObstacleId& id) { cells.there(id); },
                       .back = [cells](ObstacleId& id) { cells.back(id); }};
}

}  // namespace

std::optional<RewordingStep> draw_basis(Random& random, Scene& scene) {
  return draw_cells(random, scene, 1);
}

std::optional<RewordingStep> draw_superlattice(Random& random, Scene& scene) {
  return draw_cells(random, scene, random.integer(2, kLargestIndex));
}

}  // namespace lorentz::fuzz
