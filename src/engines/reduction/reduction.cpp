#include <lorentz/reduction.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "src/engines/reduction/flight_kernel.hpp"

namespace lorentz {

/// A velocity as seen from each atom. What that is depends on the scene's model, which knows.
struct AtomDirections {};

namespace {

template <class Item>
struct DirectionsOfModel : AtomDirections {
  std::vector<Item> items;
};

template <class Item>
const Item& direction_of(const AtomDirections& directions, std::size_t atom) {
  return static_cast<const DirectionsOfModel<Item>&>(directions).items[atom];
}

// What a kernel is asked.
struct Task {
  const PreparedScene& scene;
  const Vec& x;  ///< in the scene's scaled lengths
  const Vec& v;  ///< in [1, 2)
  const ObstacleId* from;
  double max_time;
  const AtomDirections* directions;  ///< of each atom, or null: then they are made here
};

using Time = Reduction::Time;

/// The smallest model that serves a scene; each for balls, and for scenes with ellipsoids.
enum class Model {
  unit,      ///< one square or cubic lattice of spacing 1, an obstacle at the origin
  one_atom,  ///< one obstacle in any cell
  several    ///< several atoms, in one lattice or several
};

Model model_of(const PreparedScene& scene) {
  if (scene.atoms.size() > 1) return Model::several;
  return scene.atoms[0].unit ? Model::unit : Model::one_atom;
}

bool has_fma() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma");
#elif defined(__FP_FAST_FMA)
  return true;
#else
  return false;
#endif
}

// Times in other units; a time that leaves the normal numbers is no longer known to be correctly rounded.
void rescale(Flight& flight, int exponent) {
  if (exponent == 0 || flight.outcome != Outcome::hit) return;
  const bool is_zero = flight.time == 0;  // and stays so; a time that becomes zero was not
  flight.time = scaled_time(flight.time, exponent);
  if (!is_zero && !std::isnormal(flight.time)) flight.time_is_rounded = false;
}

void give_up(Flight& flight) {
  flight.outcome = Outcome::undecided;
  flight.stage = Stage::undecided;
}

template <Time kTime, class AtomFlight>
inline void set_time(const AtomFlight& found, const Task& task, Flight& flight) {
  if constexpr (kTime == Time::close) {
    flight.time = found.time(task.v).close();
  } else {
    double error;
    const auto t = found.time(task.v).wide(error);
    flight.time = t.hi + (t.lo + error);
    flight.time_is_rounded = flight.time == t.hi + (t.lo - error);
  }
}

/// One atom in the scene.
template <Time kTime, class Arch, int D, bool kUnit, bool kBall>
inline void fly_one(const Task& task, Flight& flight) {
  const Bravais& lattice = task.scene.atoms[0];
  using Direction = AtomDirection<D, kUnit, kBall>;
  AtomFlight<Arch, D, kUnit, kBall> atom;
  if (!atom.start(lattice, task.x)) return give_up(flight);
  const Decision inside = atom.inside(task.from);
  if (inside == Decision::doubtful) return give_up(flight);
  if (inside == Decision::no) {
    if (task.directions)
      atom.find(direction_of<Direction>(*task.directions, 0), task.from, task.max_time);
    else
      atom.find(Direction(Arch{}, lattice, task.v), task.from, task.max_time);
    flight.outcome = atom.outcome;
  } else {
    flight.outcome = Outcome::inside;
  }
  flight.stage = atom.stage;
  const bool named = flight.outcome == Outcome::hit || flight.outcome == Outcome::inside;
  if (named && !atom.cell(flight.cell)) return give_up(flight);
  if (flight.outcome == Outcome::hit) set_time<kTime>(atom, task, flight);
}

// Is one hit before the other? Binary64, then double-double.
template <class OneFlight>
inline Decision is_sooner(const OneFlight& one, const OneFlight& other, const Vec& v, Stage& stage) {
  double error, other_error;
  const double difference = other.rough_time(other_error) - one.rough_time(error);
  const Decision decision = is_positive(difference, error + other_error);
  if (decision != Decision::doubtful) return decision;
  stage = std::max(stage, Stage::double_double);
  const Wide close = other.time(v).rare(other_error) - one.time(v).rare(error);
  return is_positive(close.hi, error + other_error + kStable * std::fabs(close.hi));
}

/// The flights of several atoms: those of the first few are kept from the inside tests for the searches.
template <class OneFlight>
class AtomFlights {
 public:
  /// The flight of this atom, started; null if the start is too far away.
  OneFlight* started(std::size_t atom, const Task& task) {
    OneFlight& flight = atom < kKept ? kept_[atom] : other_;
    return atom < started_ || flight.start(task.scene.atoms[atom], task.x) ? &flight : nullptr;
  }
  /// From now on those that are kept need not be started again.
  void keep() { started_ = kKept; }

 private:
  static constexpr std::size_t kKept = 6;
  OneFlight kept_[kKept], other_;
  std::size_t started_ = 0;
};

/// Several atoms, in one lattice or several: the earliest of their hits.
template <Time kTime, class Arch, int D, bool kBall>
inline void fly_several(const Task& task, Flight& flight) {
  using OneFlight = AtomFlight<Arch, D, false, kBall>;
  using Direction = AtomDirection<D, false, kBall>;
  const std::vector<Bravais>& atoms = task.scene.atoms;
  AtomFlights<OneFlight> flights;
  for (std::size_t a = 0; a < atoms.size(); ++a) {  // the smallest obstacle that contains x
    OneFlight* one = flights.started(a, task);
    if (!one) return give_up(flight);
    const Decision inside = one->inside(task.from);
    flight.stage = std::max(flight.stage, one->stage);
    if (inside == Decision::no) continue;
    if (inside == Decision::doubtful) return give_up(flight);
    flight.outcome = Outcome::inside;
    flight.lattice = atoms[a].lattice, flight.atom = atoms[a].atom;
    if (!one->cell(flight.cell)) give_up(flight);
    return;
  }
  flights.keep();
  flight.outcome = Outcome::never;
  OneFlight best;
  const Bravais* best_lattice = nullptr;
  std::optional<Direction> own;
  double limit = task.max_time;
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    if (!task.directions) Direction::set(own, Arch{}, a > 0 ? &atoms[a - 1] : nullptr, atoms[a], task.v);
    const Direction& to = task.directions ? direction_of<Direction>(*task.directions, a) : *own;
    OneFlight* next = flights.started(a, task);
    if (!next) return give_up(flight);
    next->find(to, task.from, limit);
    flight.stage = std::max(flight.stage, next->stage);
    if (next->outcome == Outcome::undecided) return give_up(flight);
    if (next->outcome == Outcome::never) continue;
    const Decision sooner = best_lattice ? is_sooner(*next, best, task.v, flight.stage) : Decision::yes;
    if (sooner == Decision::doubtful) return give_up(flight);
    if (sooner == Decision::no) continue;
    best = *next, best_lattice = &atoms[a];
    double error;
    const double time = next->rough_time(error);
    limit = std::min(limit, time + error);
  }
  if (!best_lattice) return;
  flight.outcome = Outcome::hit;
  flight.lattice = best_lattice->lattice, flight.atom = best_lattice->atom;
  if (!best.cell(flight.cell)) return give_up(flight);
  set_time<kTime>(best, task, flight);
}

using Kernel = void (*)(const Task&, Flight&);
using DirectionsKernel = std::shared_ptr<const AtomDirections> (*)(const PreparedScene&, const Vec&);

/// What runs for a scene, on this processor.
struct Kernels {
  Kernel close = nullptr, rounded = nullptr;
  DirectionsKernel directions = nullptr;
};

template <Time kTime, class Arch, int D, Model kModel, bool kBall>
inline void fly_with(const Task& task, Flight& flight) {
  if constexpr (kModel == Model::several)
    fly_several<kTime, Arch, D, kBall>(task, flight);
  else
    fly_one<kTime, Arch, D, kModel == Model::unit, kBall>(task, flight);
}

template <class Arch, int D, Model kModel, bool kBall>
std::shared_ptr<const AtomDirections> directions_for(const PreparedScene& scene, const Vec& v) {
  using Item = AtomDirection<D, kModel == Model::unit, kBall>;
  auto directions = std::make_shared<DirectionsOfModel<Item>>();
  // As fly_several sets them, one from the one before: so that both decide alike, to the bit.
  std::optional<Item> to;
  const Bravais* before = nullptr;
  for (const Bravais& lattice : scene.atoms) {
    Item::set(to, Arch{}, before, lattice, v);
    directions->items.push_back(*to);
    before = &lattice;
  }
  return directions;
}

template <Time kTime, int D, Model kModel, bool kBall>
[[LORENTZ_WITH_FMA]] void fly_fma(const Task& task, Flight& flight) {
  fly_with<kTime, HardwareFma, D, kModel, kBall>(task, flight);
}

template <Time kTime, int D, Model kModel, bool kBall>
[[LORENTZ_FLATTEN]] void fly_split(const Task& task, Flight& flight) {
  fly_with<kTime, SplitProduct, D, kModel, kBall>(task, flight);
}

template <int D, Model kModel, bool kBall>
Kernels kernels_of(bool fma) {
  if (fma)
    return {fly_fma<Time::close, D, kModel, kBall>, fly_fma<Time::rounded, D, kModel, kBall>,
            directions_for<SplitProduct, D, kModel, kBall>};
  return {fly_split<Time::close, D, kModel, kBall>, fly_split<Time::rounded, D, kModel, kBall>,
          directions_for<SplitProduct, D, kModel, kBall>};
}

template <int D, bool kBall>
Kernels kernels_of(Model model, bool fma) {
  switch (model) {
    case Model::unit:
      return kernels_of<D, Model::unit, kBall>(fma);
    case Model::one_atom:
      return kernels_of<D, Model::one_atom, kBall>(fma);
    case Model::several:
      return kernels_of<D, Model::several, kBall>(fma);
  }
  return {};
}

Kernels kernels_for(const PreparedScene& scene, Model model, bool fma) {
  if (scene.atoms[0].dimension == 2)
    return scene.ellipsoids ? kernels_of<2, false>(model, fma) : kernels_of<2, true>(model, fma);
  return scene.ellipsoids ? kernels_of<3, false>(model, fma) : kernels_of<3, true>(model, fma);
}

}  // namespace

struct Reduction::Model {
  PreparedScene scene;
  lorentz::Model model = lorentz::Model::unit;
  Kernels kernels;
};

Reduction::Reduction(const Scene& scene, Processor processor) : Engine(scene) {
  auto model = std::make_unique<Model>();
  model->scene = prepare(scene);
  if (!model->scene.beyond.empty()) throw std::invalid_argument("reduction " + model->scene.beyond);
  model->model = model_of(model->scene);
  const bool fma = processor == Processor::this_one && has_fma();
  model->kernels = kernels_for(model->scene, model->model, fma);
  model_ = std::move(model);
}

Reduction::~Reduction() = default;

std::optional<std::string> Reduction::beyond(const Scene& scene) {
  PreparedScene prepared = prepare(scene);
  if (prepared.beyond.empty()) return std::nullopt;
  return std::move(prepared.beyond);
}

const char* Reduction::model() const {
  const bool ellipsoids = model_->scene.ellipsoids;
  switch (model_->model) {
    case lorentz::Model::unit:
      return ellipsoids ? "unit, ellipsoid" : "unit";
    case lorentz::Model::one_atom:
      return ellipsoids ? "one atom, ellipsoid" : "one atom";
    case lorentz::Model::several:
      return ellipsoids ? "several atoms, ellipsoids" : "several atoms";
  }
  return "";
}

void Reduction::fly(const Ray& ray, const AtomDirections* directions, double max_time, Time time,
                    Flight& flight) const {
  const int exponent = model_->scene.exponent;
  const Kernel kernel = time == Time::close ? model_->kernels.close : model_->kernels.rounded;
  if (exponent == 0) {
    kernel({model_->scene, ray.x, ray.v, ray.from, max_time, directions}, flight);
  } else {
    Vec x;
    for (int i = 0; i < 3; ++i) x[i] = scaled_time(ray.x[i], -exponent);
    kernel({model_->scene, x, ray.v, ray.from, scaled_time(max_time, -exponent), directions}, flight);
    rescale(flight, exponent);
  }
  if (flight.outcome == Outcome::never && ray.tiny_component) give_up(flight);
}

Flight Reduction::fly(const Query& query, double max_time, Time time) const {
  Flight flight;
  const ScaledVelocity velocity(query.v);
  fly(Ray{query.x, velocity.scaled, query.from ? &*query.from : nullptr, velocity.tiny_component}, nullptr,
      scaled_time(max_time, velocity.exponent), time, flight);
  rescale(flight, -velocity.exponent);
  return flight;
}

Reduction::Direction Reduction::direction(const Vec& v) const {
  const ScaledVelocity velocity(v);
  Direction direction;
  direction.scaled_v_ = velocity.scaled;
  direction.exponent_ = velocity.exponent;
  direction.tiny_component_ = velocity.tiny_component;
  direction.atoms_ = model_->kernels.directions(model_->scene, velocity.scaled);
  return direction;
}

Flight Reduction::fly(const Direction& direction, const Vec& x, const ObstacleId* from, double max_time,
                      Time time) const {
  Flight flight;
  fly(Ray{x, direction.scaled_v_, from, direction.tiny_component_}, direction.atoms_.get(),
      scaled_time(max_time, direction.exponent_), time, flight);
  rescale(flight, -direction.exponent_);
  return flight;
}

void set_answer(const Flight& flight, Answer& answer) {
  answer.outcome = flight.outcome;
  if (flight.outcome != Outcome::hit && flight.outcome != Outcome::inside) return;
  answer.obstacle.lattice = flight.lattice;
  answer.obstacle.atom = flight.atom;
  for (int k = 0; k < 3; ++k) answer.obstacle.cell[k] = flight.cell[k];
  if (flight.outcome == Outcome::hit) answer.time = flight.time;
}

Answer answer_of(const Flight& flight) {
  Answer answer;
  set_answer(flight, answer);
  return answer;
}

void Reduction::first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const {
  Flight flight;
  fly(ray, nullptr, max_time, Time::close, flight);
  set_answer(flight, answer);
}

}  // namespace lorentz
