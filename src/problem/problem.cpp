#include <lorentz/problem.hpp>

#include <charconv>
#include <cmath>

#include "src/problem/from_flaw.hpp"

namespace lorentz {

std::optional<Integer> Integer::from_decimal(std::string_view text) {
  const bool negative = !text.empty() && text.front() == '-';
  std::string_view digits = text.substr(negative ? 1 : 0);
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  const auto first = digits.find_first_not_of('0');
  if (first == std::string_view::npos) return Integer(0);
  digits.remove_prefix(first);
  std::string canonical = (negative ? "-" : "") + std::string(digits);
  Integer result;
  const auto [end, status] =
      std::from_chars(canonical.data(), canonical.data() + canonical.size(), result.value_);
  if (status != std::errc{}) {
    result.value_ = 0;
    result.digits_ = std::make_unique<const std::string>(std::move(canonical));
  }
  return result;
}

std::optional<WideInteger> Integer::int128_of_digits() const {
  constexpr std::size_t kDigits = 38;  // 10^38 < 2^127
  const bool negative = digits_->front() == '-';
  const std::string_view digits = std::string_view(*digits_).substr(negative ? 1 : 0);
  if (digits.size() > kDigits) return std::nullopt;
  WideInteger n = 0;
  for (const char c : digits) n = 10 * n + (c - '0');
  return negative ? -n : n;
}

std::string Integer::decimal() const {
  return fits_int64() ? std::to_string(value_) : *digits_;
}

void Answer::clear() {
  outcome = Outcome::undecided;
  obstacle.lattice = obstacle.atom = 0;
  for (Integer& n : obstacle.cell) n = 0;
  time.reset();
  time_decimal.clear();
  detail.reset();
  message.clear();
  unsupported = false;
}

Answer Answer::hit(ObstacleId obstacle, double time) {
  Answer answer;
  answer.outcome = Outcome::hit;
  answer.obstacle = std::move(obstacle);
  answer.time = time;
  return answer;
}

Answer Answer::inside(ObstacleId obstacle) {
  Answer answer;
  answer.outcome = Outcome::inside;
  answer.obstacle = std::move(obstacle);
  return answer;
}

Answer Answer::never() {
  Answer answer;
  answer.outcome = Outcome::never;
  return answer;
}

Answer Answer::later() {
  Answer answer;
  answer.outcome = Outcome::later;
  return answer;
}

Answer Answer::undecided() {
  return Answer{};
}

Answer Answer::error(std::string message) {
  Answer answer;
  answer.outcome = Outcome::error;
  answer.message = std::move(message);
  return answer;
}

Answer Answer::unsupported_because(std::string message) {
  Answer answer = error(std::move(message));
  answer.unsupported = true;
  return answer;
}

Answer limited(Answer answer, double max_time) {
  const bool nothing_before = answer.outcome == Outcome::never || (answer.time && !(*answer.time < max_time));
  return std::isfinite(max_time) && nothing_before ? Answer::later() : answer;
}

namespace {

bool all_finite(const Vec& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

std::optional<std::string> flaw_of_atom(const Atom& atom, int dimension) {
  if (!all_finite(atom.position)) return "position is not finite";
  if (atom.is_ball()) {
    if (!std::isfinite(atom.radius)) return "radius is not finite";
    if (!(atom.radius > 0)) return "radius must be above zero";
    return std::nullopt;
  }
  if (atom.semiaxes.size() != static_cast<std::size_t>(dimension))
    return "needs as many semiaxes as dimensions (" + std::to_string(dimension) + ")";
  for (const Vec& axis : atom.semiaxes)
    if (!all_finite(axis)) return "a semiaxis is not finite";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> flaw_of(const Scene& scene) {
  if (scene.dimension != 2 && scene.dimension != 3) return "dimension must be 2 or 3";
  if (scene.lattices.empty()) return "a scene needs at least one lattice";
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) {
    const Lattice& lattice = scene.lattices[l];
    const std::string where = "lattice " + std::to_string(l);
    for (int i = 0; i < scene.dimension; ++i)
      if (!all_finite(lattice.vectors[i])) return where + ": a primitive vector is not finite";
    if (lattice.atoms.empty()) return where + ": needs at least one atom";
    for (std::size_t a = 0; a < lattice.atoms.size(); ++a)
      if (auto flaw = flaw_of_atom(lattice.atoms[a], scene.dimension))
        return where + ", atom " + std::to_string(a) + ": " + *flaw;
  }
  return std::nullopt;
}

std::optional<std::string> flaw_of(const Query& query, const Scene& scene) {
  if (!all_finite(query.x)) return "x is not finite";
  if (!all_finite(query.v)) return "v is not finite";
  if (query.v == Vec{}) return "v is zero: the particle needs a direction";
  return query.from ? from_flaw(*query.from, scene) : std::nullopt;
}

Scene unit_scene(int dimension, double radius) {
  Scene scene;
  scene.dimension = dimension;
  Lattice lattice;
  for (int i = 0; i < dimension; ++i) lattice.vectors[i][i] = 1;
  lattice.atoms.push_back(Atom{{}, radius, {}});
  scene.lattices.push_back(lattice);
  return scene;
}

bool is_unit_scene(const Scene& scene) {
  if (scene.lattices.size() != 1 || scene.lattices[0].atoms.size() != 1) return false;
  const Atom& atom = scene.lattices[0].atoms[0];
  return atom.is_ball() && atom.position == Vec{} &&
         scene.lattices[0].vectors == unit_scene(scene.dimension, 1).lattices[0].vectors;
}

}  // namespace lorentz
