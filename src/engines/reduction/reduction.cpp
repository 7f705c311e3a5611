#include <lorentz/reduction.hpp>

#include <cassert>
#include <cmath>
#include <optional>

#include <lorentz/engine_base.hpp>
#include <lorentz/errors.hpp>
#include "src/engines/reduction/kernels.hpp"
#include "src/engines/reduction/offset.hpp"

namespace lorentz {

namespace {

bool has_fma() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma");
#elif defined(__FP_FAST_FMA)
  return true;
#else
  return false;
#endif
}

// Converts times to other units. A time that leaves the normal numbers is no longer known to be correctly
// rounded.
void rescale(Flight& flight, int exponent) {
  if (exponent == 0 || flight.outcome != Outcome::hit) return;
  const bool is_zero = flight.time == 0;  // and stays zero; a time that becomes zero was not
  flight.time = scaled_time(flight.time, exponent);
  if (!is_zero && !std::isnormal(flight.time)) flight.time_is_rounded = false;
}

}  // namespace

struct Reduction::Model {
  PreparedScene scene;
  FlightKernel fly;
};

Reduction::Reduction(const Scene& scene, Processor processor) : Engine(scene) {
  auto model = std::make_unique<Model>();
  model->scene = prepare(scene);
  if (!model->scene.beyond.empty()) throw UnsupportedError("reduction " + model->scene.beyond);
  const bool fma = processor == Processor::this_one && has_fma();
  model->fly = fma ? kernel_with_fma(model->scene) : kernel_without_fma(model->scene);
  model_ = std::move(model);
}

Reduction::~Reduction() = default;
Reduction::Reduction(Reduction&&) noexcept = default;
Reduction& Reduction::operator=(Reduction&&) noexcept = default;

std::optional<std::string> Reduction::beyond(const Scene& scene) {
  PreparedScene prepared = prepare(scene);
  if (prepared.beyond.empty()) return std::nullopt;
  return std::move(prepared.beyond);
}

const char* Reduction::model() const {
  constexpr const char* kNames[][2] = {{"unit", "unit, ellipsoid"},  // in the order of SceneModel
                                       {"one atom", "one atom, ellipsoid"},
                                       {"rows and layers", "rows and layers, ellipsoids"},
                                       {"several atoms", "several atoms, ellipsoids"}};
  static_assert(std::size(kNames) == static_cast<std::size_t>(SceneModel::several) + 1);
  return kNames[static_cast<int>(model_of(model_->scene))][model_->scene.ellipsoids];
}

// A search that ends at a limit may meet, beyond the first hit, an obstacle that it cannot decide. A search
// without a limit never looks there, so it follows where the first one is undecided.
inline void Reduction::fly_to_limit(Task task, Flight& flight) const {
  model_->fly(task, flight);
  if (flight.outcome != Outcome::undecided || !task.is_limited()) return;
  task.search_time = HUGE_VAL;
  flight = {};
  model_->fly(task, flight);
}

inline void Reduction::fly(const Ray& ray, double max_time, Time time, Flight& flight,
                           std::array<WideInteger, 3>* cell) const {
  const int exponent = model_->scene.exponent;
  if (exponent == 0) {
    fly_to_limit({model_->scene, ray, ray.x, max_time, max_time, time, cell}, flight);
  } else {
    const double limit = scaled_limit(max_time, -exponent);
    Vec x;
    for (int i = 0; i < 3; ++i) x[i] = scaled_time(ray.x[i], -exponent);
    fly_to_limit({model_->scene, ray, x, limit, limit, time, cell}, flight);
    rescale(flight, exponent);
  }
  if (flight.outcome != Outcome::never) return;
  if (max_time < HUGE_VAL) flight.outcome = Outcome::later;
  if (ray.has_tiny_component()) give_up(flight);
}

Flight Reduction::fly(const Query& query, double max_time, Time time,
                      std::array<WideInteger, 3>* cell) const {
  assert(!flaw_of(query, scene(), max_time));
  Flight flight;
  const ScaledVelocity velocity(query.v);
  fly(Ray{query.x, velocity.scaled, query.from ? &*query.from : nullptr, query.v},
      scaled_limit(max_time, velocity.exponent), time, flight, cell);
  rescale(flight, -velocity.exponent);
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

void set_answer(const Flight& flight, const std::array<WideInteger, 3>& cell, Answer& answer) {
  set_answer(flight, answer);
  if (flight.is_far && flight.outcome == Outcome::hit) [[unlikely]]
    for (int k = 0; k < 3; ++k) answer.obstacle.cell[k] = Integer::of(cell[k]);
}

Answer answer_of(const Flight& flight) {
  Answer answer;
  set_answer(flight, answer);
  return answer;
}

void Reduction::first_hit_scaled(const Ray& ray, double max_time, Answer& answer) const {
  Flight flight;
  std::array<WideInteger, 3> cell;  // set only of a flight that is far
  fly(ray, max_time, Time::close, flight, &cell);
  set_answer(flight, cell, answer);
}

}  // namespace lorentz
