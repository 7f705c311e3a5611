#include "oracle/itinerary/passage.hpp"

#include <algorithm>

#include <lorentz/errors.hpp>

namespace lorentz::oracle {
namespace {

// Bits kept beyond those that the state's error makes meaningful: roundings add 2^-kGuardBits of that error.
constexpr long kGuardBits = 64;

// Bits for derivatives, which only estimate changes. If the derivatives lose all of these bits, all bits are
// used.
constexpr long kDerivativeBits = 256;

template <std::size_t D>
Bound largest_size(const BallVec<D>& a) {
  Bound largest;
  for (const Ball& component : a) largest = larger(largest, component.size());
  return largest;
}

}  // namespace

template <std::size_t D>
Passage<D>::Passage(Route<D>& route, long bits) : route_(route), bits_(bits), from_(route.start.from) {
  const Ball::WorkingPrecision precision(bits);
  const BallVec<D> v = velocity_of<D>(route.start, route.problem.unit);
  const Bound size = largest_size<D>(v);
  if (size.is_zero()) throw InputError("v: is zero");
  // Scale the velocity to the size of a cell, so that times have the size of free paths; single obstacles
  // have no cell.
  for (const Z& length : route.problem.scene.lattices[0].vectors[0])
    cell_ = larger(cell_, Ball(length).size());
  if (cell_.is_zero()) cell_ = route.sight.least_radius();
  velocity_exponent_ = cell_.exponent() - size.exponent();
  typename ErrorBox<N>::Bounds widths;
  for (std::size_t i = 0; i < D; ++i) {
    const Ball component = scaled(v[i], velocity_exponent_);
    state_.y[i] = Ball(route.problem.x[i]);
    state_.v[i] = component.middle();
    widths[D + i] = component.radius();
  }
  box_ = ErrorBox<N>(widths);
}

template <std::size_t D>
bool Passage<D>::go() {
  for (;;) {
    const Ball::WorkingPrecision precision(working_bits());
    const bool is_stopped = route_.journey.stop && *route_.journey.stop;
    const PassageStep result = is_stopped ? PassageStep::lost : step();
    if (result == PassageStep::done) continue;
    if (result == PassageStep::arrived) return true;
    arrival_.collisions = route_.told;
    arrival_.bits = bits_;
    return false;
  }
}

template <std::size_t D>
typename Passage<D>::PassageStep Passage<D>::step() {
  const auto& most = route_.journey.collisions;
  if (route_.stopped && collisions_ == route_.told) return arrive(JourneyEnd::collisions);
  if (most && collisions_ == *most) return arrive(JourneyEnd::collisions);
  if (collisions_ < route_.known.size()) return collide_with(ObstacleId(route_.known[collisions_]));
  std::array<Bound, D> y_error, v_error;
  for (std::size_t i = 0; i < D; ++i) {
    y_error[i] = box_.width_of(static_cast<int>(i));
    v_error[i] = box_.width_of(static_cast<int>(D + i));
  }
  const auto next = route_.sight.next({centre_, state_, y_error, v_error, from_});
  if (const auto* obstacle = std::get_if<ObstacleId>(&next)) {
    route_.known.push_back(*obstacle);
    return collide_with(*obstacle);
  }
  switch (std::get<Unseen>(next)) {
    case Unseen::around:
      return arrive(JourneyEnd::inside);
    case Unseen::never:
      return arrive(route_.journey.time ? JourneyEnd::time : JourneyEnd::never);
    default:
      return PassageStep::lost;
  }
}

template <std::size_t D>
typename Passage<D>::PassageStep Passage<D>::collide_with(const ObstacleId& obstacle) {
  const ZVec<D> centre = route_.sight.centre_of(obstacle);
  const Form<D>& form = route_.sight.form_of(obstacle);
  State<D> state = state_;
  for (std::size_t i = 0; i < D; ++i) state.y[i] += Ball(centre_[i] - centre[i]);
  const auto middle = collide(state, form);
  if (!middle) return PassageStep::lost;
  std::optional<typename ErrorBox<N>::Matrix> derivative;
  Ball time = middle->after.t;
  if (!box_.is_point()) {
    const auto anywhere = collision_anywhere(centre, form);
    if (!anywhere) return PassageStep::lost;
    derivative = derivative_of(*anywhere, form);
    time = time.widened(box_.width_of((*derivative)[kTime]));
  }
  const auto beyond = is_beyond_end(time);
  if (!beyond) return PassageStep::lost;
  if (*beyond) return arrive(JourneyEnd::time);
  move_on(*middle, derivative ? &*derivative : nullptr);
  centre_ = centre;
  from_ = obstacle;
  ++collisions_;
  return tell(obstacle) ? PassageStep::done : PassageStep::lost;
}

// The collision from any point of the box.
template <std::size_t D>
std::optional<EnclosedCollision<D>> Passage<D>::collision_anywhere(const ZVec<D>& centre,
                                                                   const Form<D>& form) const {
  const auto with_bits = [&](long bits) {
    const Ball::WorkingPrecision precision(bits);
    State<D> state = state_;
    for (std::size_t i = 0; i < D; ++i) {
      state.y[i] = (state.y[i] + Ball(centre_[i] - centre[i])).widened(box_.width_of(static_cast<int>(i)));
      state.v[i] = state.v[i].widened(box_.width_of(static_cast<int>(D + i)));
    }
    return collide(state, form);
  };
  auto result = with_bits(kDerivativeBits);
  return result ? result : with_bits(std::max(kDerivativeBits, Ball::WorkingPrecision::now()));
}

template <std::size_t D>
typename ErrorBox<Passage<D>::N>::Matrix Passage<D>::derivative_of(const EnclosedCollision<D>& anywhere,
                                                                   const Form<D>& form) const {
  const Ball::WorkingPrecision precision(kDerivativeBits);
  typename ErrorBox<N>::Matrix result;
  for (int k = 0; k < N; ++k) {
    State<D> change;
    (k < static_cast<int>(D) ? change.y[k] : k < kTime ? change.v[k - D] : change.t) = Ball(1);
    const State<D> changed = derivative(anywhere, form, change);
    for (std::size_t i = 0; i < D; ++i) {
      result[i][k] = changed.y[i];
      result[D + i][k] = changed.v[i];
    }
    result[kTime][k] = changed.t;
  }
  return result;
}

template <std::size_t D>
void Passage<D>::move_on(const EnclosedCollision<D>& middle, const typename ErrorBox<N>::Matrix* derivative) {
  typename ErrorBox<N>::Bounds rounding;
  for (std::size_t i = 0; i < D; ++i) {
    rounding[i] = middle.after.y[i].radius();
    rounding[D + i] = middle.after.v[i].radius();
    state_.y[i] = middle.after.y[i].middle();
    state_.v[i] = middle.after.v[i].middle();
  }
  rounding[kTime] = middle.after.t.radius();
  state_.t = middle.after.t.middle();
  const Ball::WorkingPrecision precision(kDerivativeBits);
  if (derivative)
    box_.advance(*derivative, rounding);
  else
    box_ = ErrorBox<N>(rounding);
}

// Nothing if the precision is not sufficient to decide.
template <std::size_t D>
std::optional<bool> Passage<D>::is_beyond_end(const Ball& time) const {
  if (!route_.journey.time) return false;
  const Ball end = end_time();
  if (surely_less(end, time)) return true;
  if (surely_not_after(time, end)) return false;
  return std::nullopt;
}

template <std::size_t D>
Ball Passage<D>::end_time() const {
  return scaled(to_ball(*route_.journey.time), -velocity_exponent_);
}

// Reports this collision, if it has not been reported and all its digits are certain. False if they are not
// certain.
template <std::size_t D>
bool Passage<D>::tell(const ObstacleId& obstacle) {
  if (collisions_ <= route_.told) return true;
  CertifiedCollision told;
  const Ball time = scaled(component(kTime), velocity_exponent_);
  const auto text = decimal(time);
  if (!text || (route_.journey.states && !describe(nullptr, told.x, told.v))) return false;
  told.obstacle = obstacle;
  told.time = *text;
  told.nearest_time = time.nearest();
  const Ball unit(route_.problem.unit);
  for (std::size_t i = 0; i < D; ++i) {
    told.offset[i] = (state_.y[i] / unit).nearest();
    told.velocity[i] = scaled(state_.v[i] / unit, -velocity_exponent_).nearest();
  }
  told.bits = bits_lost();
  ++route_.told;
  if (route_.on_collision && !route_.on_collision(told)) route_.stopped = true;
  return true;
}

template <std::size_t D>
typename Passage<D>::PassageStep Passage<D>::arrive(JourneyEnd end) {
  Arrival arrival;
  arrival.end = end;
  arrival.collisions = collisions_;
  arrival.bits = bits_;
  std::optional<Ball> time;
  if (end == JourneyEnd::time) time = end_time();
  const Ball* at = time ? &*time : nullptr;
  if (!describe(at, arrival.x, arrival.v) || !describe_distance(at, arrival.distance))
    return PassageStep::lost;
  arrival_ = std::move(arrival);
  return PassageStep::arrived;
}

// The particle's position at a time after the last collision or, without a time, at that collision; in the
// problem's unit.
template <std::size_t D>
typename Passage<D>::Function Passage<D>::place(int i, const Ball* time) const {
  Function function{Ball(centre_[i]) + state_.y[i], {}};
  function.gradient[i] = Ball(1);
  if (time) {
    function.value += (*time - state_.t) * state_.v[i];
    function.gradient[D + i] = *time - component(kTime);
    function.gradient[kTime] = -component(static_cast<int>(D) + i);
  }
  return function;
}

template <std::size_t D>
Ball Passage<D>::distance(const std::array<Function, D>& place) const {
  Ball squares, squares_anywhere;
  BallVec<D> anywhere;
  for (std::size_t i = 0; i < D; ++i) {
    anywhere[i] = enclosed(place[i]);
    squares += square(place[i].value);
    squares_anywhere += square(anywhere[i]);
  }
  if (!squares_anywhere.is_positive()) return sqrt(squares_anywhere);
  Function result{sqrt(squares), {}};
  const Ball length = sqrt(squares_anywhere);
  for (int k = 0; k < N; ++k)
    for (std::size_t i = 0; i < D; ++i)
      result.gradient[k].add_product(anywhere[i] / length, place[i].gradient[k]);
  return enclosed(result);
}

template <std::size_t D>
Ball Passage<D>::enclosed(const Function& function) const {
  return function.value.widened(box_.width_of(function.gradient));
}

// A component of the state, enclosed for the whole box.
template <std::size_t D>
Ball Passage<D>::component(int i) const {
  const Ball& middle = i == kTime ? state_.t : i < static_cast<int>(D) ? state_.y[i] : state_.v[i - D];
  return middle.widened(box_.width_of(i));
}

template <std::size_t D>
bool Passage<D>::describe(const Ball* time, std::vector<std::string>& x, std::vector<std::string>& v) const {
  const Ball unit(route_.problem.unit);
  const Bound length = length_scale(), speed = speed_scale();
  for (int i = 0; i < static_cast<int>(D); ++i) {
    const auto x_text = decimal(enclosed(place(i, time)) / unit, &length);
    const auto v_text =
        decimal(scaled(component(static_cast<int>(D) + i) / unit, -velocity_exponent_), &speed);
    if (!x_text || !v_text) return false;
    x.push_back(*x_text);
    v.push_back(*v_text);
  }
  return true;
}

// In the scene's own unit.
template <std::size_t D>
Bound Passage<D>::length_scale() const {
  return cell_ / Ball(route_.problem.unit).least_size();
}

template <std::size_t D>
Bound Passage<D>::speed_scale() const {
  return largest_size<D>(state_.v) * Bound::power_of_two(-velocity_exponent_) /
         Ball(route_.problem.unit).least_size();
}

template <std::size_t D>
bool Passage<D>::describe_distance(const Ball* time, std::string& text) const {
  std::array<Function, D> places;
  for (std::size_t i = 0; i < D; ++i) places[i] = place(static_cast<int>(i), time);
  const Bound length = length_scale();
  const auto decimals = decimal(distance(places) / Ball(route_.problem.unit), &length);
  if (decimals) text = *decimals;
  return decimals.has_value();
}

// Gives the requested digits. A number that is known much better, and still could be rounded to either side,
// is midway between two decimals or nearly so; then one or two digits more are given. A number that cannot be
// told from 0, far below its `scale`, is "0e-k": it is less than 10^-k, and no digit is certain. (Times have
// no `scale`, because they are above 0.)
template <std::size_t D>
std::optional<std::string> Passage<D>::decimal(const Ball& number, const Bound* scale) const {
  constexpr double kBitsADigit = 3.33, kDigitsABit = 0.30102;
  constexpr long kMidway = 96, kNothing = 256;
  const int digits = route_.journey.digits;
  if (auto text = certain_decimal(number, digits)) return text;
  if (!number.is_finite()) return std::nullopt;
  const Bound size = number.size(), radius = number.radius();
  const auto enough = static_cast<long>(kBitsADigit * digits);
  if (!number.is_positive() && !number.is_negative()) {
    if (!scale || scale->exponent() - size.exponent() < enough + kNothing) return std::nullopt;
    return "0e-" + std::to_string(static_cast<long>(-kDigitsABit * static_cast<double>(size.exponent())));
  }
  if (size.exponent() - radius.exponent() < enough + kMidway) return std::nullopt;
  for (int more = digits + 1; more <= digits + 2; ++more)
    if (auto text = certain_decimal(number, more)) return text;
  return std::nullopt;
}

template <std::size_t D>
long Passage<D>::bits_lost() const {
  if (box_.is_point()) return 0;
  Bound y, v;
  for (int i = 0; i < static_cast<int>(D); ++i) {
    y = larger(y, box_.width_of(i));
    v = larger(v, box_.width_of(static_cast<int>(D) + i));
  }
  const Bound relative = larger(y / route_.sight.least_radius(), v / largest_size<D>(state_.v));
  return relative.is_zero() ? 0 : std::max(0L, bits_ + relative.exponent());
}

template <std::size_t D>
long Passage<D>::working_bits() const {
  return std::min(bits_, std::max(bits_ - bits_lost(), 0L) + kGuardBits);
}

template <std::size_t D>
double Passage<D>::part_done() const {
  double part = 0;
  if (route_.journey.collisions)
    part = static_cast<double>(collisions_) /
           static_cast<double>(std::max<std::uint64_t>(1, *route_.journey.collisions));
  if (route_.journey.time) part = std::max(part, (state_.t / end_time()).nearest());
  return part;
}

template class Passage<2>;
template class Passage<3>;

}  // namespace lorentz::oracle
