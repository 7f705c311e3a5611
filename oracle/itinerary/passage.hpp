// A journey at one precision, and the results that the next passage, at a higher precision, takes over from
// it. Private to oracle/itinerary.
#pragma once

#include <algorithm>

#include <lorentz/errors.hpp>
#include <lorentz/itinerary.hpp>
#include "oracle/itinerary/error_box.hpp"
#include "oracle/itinerary/integer_problem.hpp"
#include "oracle/itinerary/sight.hpp"

namespace lorentz::oracle {

/// The data that passages share: the problem, and the obstacles and decimals that are already certain. An
/// obstacle that was certain at some precision is the true one, so it is not searched again.
template <std::size_t D>
struct Route {
  const Start& start;
  const Journey& journey;
  const Itinerary::OnCollision& on_collision;
  IntegerProblem<D> problem;
  Sight<D> sight;
  std::vector<ObstacleId> known;
  std::uint64_t told = 0;  ///< number of collisions reported to on_collision
  bool stopped = false;    ///< by on_collision

  Route(const RationalScene& scene, const Start& its_start, const Journey& its_journey,
        const Itinerary::OnCollision& listener)
      : start(its_start),
        journey(its_journey),
        on_collision(listener),
        problem(scene, its_start),
        sight(problem.scene) {}
};

template <std::size_t D>
class Passage {
 public:
  Passage(Route<D>& route, long bits) : route_(route), bits_(bits), from_(route.start.from) {
    const Ball::WorkingPrecision precision(bits);
    const BallVec<D> v = velocity_of<D>(route.start, route.problem.unit);
    const Bound size = largest_size(v);
    if (size.is_zero()) throw InputError("v: is zero");
    // Scale the velocity to the size of a cell, so that times have the size of free paths; single obstacles
    // have no cell.
    cell_ = largest_size(balls<D>(route.problem.scene.lattices[0].vectors[0]));
    if (cell_.is_zero()) cell_ = route.sight.least_radius();
    velocity_exponent_ = cell_.exponent() - size.exponent();
    state_.y = balls<D>(route.problem.x);
    typename Box::Bounds widths;
    for (std::size_t i = 0; i < D; ++i) {
      const Ball component = scaled(v[i], velocity_exponent_);
      state_.v[i] = component.middle();
      widths[D + i] = component.radius();
    }
    box_ = Box(widths);
  }

  /// Goes on as far as this precision allows; returns true if that is the journey's end.
  bool go() {
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

  /// The end, or how far everything is certain.
  const Arrival& arrival() const { return arrival_; }
  long bits() const { return bits_; }

  long bits_lost() const {
    if (box_.is_point()) return 0;
    const Seen<D> here = seen();
    const auto largest = [](const std::array<Bound, D>& errors) {
      return *std::max_element(errors.begin(), errors.end());
    };
    const Bound relative = std::max(largest(here.y_error) / route_.sight.least_radius(),
                                    largest(here.v_error) / largest_size(state_.v));
    return relative.is_zero() ? 0 : std::max(0L, bits_ + relative.exponent());
  }

  /// The part of the journey that is done, by collisions or time.
  double part_done() const {
    double part = 0;
    if (route_.journey.collisions)
      part = static_cast<double>(collisions_) /
             static_cast<double>(std::max<std::uint64_t>(1, *route_.journey.collisions));
    if (route_.journey.time) part = std::max(part, (state_.t / end_time()).nearest());
    return part;
  }

 private:
  // Bits kept beyond those that the state's error makes meaningful: roundings add 2^-kGuardBits of that
  // error.
  static constexpr long kGuardBits = 64;
  // Bits for derivatives, which only estimate changes. If the derivatives lose all of these bits, all bits
  // are used.
  static constexpr long kDerivativeBits = 256;
  static constexpr int N = 2 * static_cast<int>(D) + 1;  // y, v, t
  static constexpr int kTime = N - 1;
  using Box = ErrorBox<N>;
  enum class PassageStep { done, arrived, lost };

  /// A function of the state: its value in the middle, rounded, and its gradient enclosed for the whole box.
  struct Function {
    Ball value;
    BallVec<N> gradient;
  };

  static Bound largest_size(const BallVec<D>& a) {
    Bound largest;
    for (const Ball& component : a) largest = std::max(largest, component.size());
    return largest;
  }

  long working_bits() const { return std::min(bits_, std::max(bits_ - bits_lost(), 0L) + kGuardBits); }

  Seen<D> seen() const {
    Seen<D> seen{centre_, state_, {}, {}, from_};
    for (std::size_t i = 0; i < D; ++i) {
      seen.y_error[i] = box_.width_of(static_cast<int>(i));
      seen.v_error[i] = box_.width_of(static_cast<int>(D + i));
    }
    return seen;
  }

  PassageStep step() {
    const auto& most = route_.journey.collisions;
    if (route_.stopped && collisions_ == route_.told) return arrive(JourneyEnd::collisions);
    if (most && collisions_ == *most) return arrive(JourneyEnd::collisions);
    if (collisions_ < route_.known.size()) return collide_with(ObstacleId(route_.known[collisions_]));
    const auto next = route_.sight.next(seen());
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

  PassageStep collide_with(const ObstacleId& obstacle) {
    const ZVec<D> centre = route_.sight.centre_of(obstacle);
    const Form<D>& form = route_.sight.form_of(obstacle);
    const auto middle = collide(state_.seen_from(centre_, centre), form);
    if (!middle) return PassageStep::lost;
    std::optional<typename Box::Matrix> derivative;
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
    move_on(*middle, derivative);
    centre_ = centre;
    from_ = obstacle;
    ++collisions_;
    return tell(obstacle) ? PassageStep::done : PassageStep::lost;
  }

  // The collision from any point of the box.
  std::optional<EnclosedCollision<D>> collision_anywhere(const ZVec<D>& centre, const Form<D>& form) const {
    const auto with_bits = [&](long bits) {
      const Ball::WorkingPrecision precision(bits);
      return collide(seen().anywhere(centre), form);
    };
    auto result = with_bits(kDerivativeBits);
    return result ? result : with_bits(std::max(kDerivativeBits, Ball::WorkingPrecision::now()));
  }

  typename Box::Matrix derivative_of(const EnclosedCollision<D>& anywhere, const Form<D>& form) const {
    const Ball::WorkingPrecision precision(kDerivativeBits);
    typename Box::Matrix result;
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

  void move_on(const EnclosedCollision<D>& middle, const std::optional<typename Box::Matrix>& derivative) {
    typename Box::Bounds rounding;
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
      box_ = Box(rounding);
  }

  // Nothing if the precision is not sufficient to decide.
  std::optional<bool> is_beyond_end(const Ball& time) const {
    if (!route_.journey.time) return false;
    const Ball end = end_time();
    if (surely_less(end, time)) return true;
    if (surely_not_after(time, end)) return false;
    return std::nullopt;
  }

  Ball end_time() const { return scaled(to_ball(*route_.journey.time), -velocity_exponent_); }

  // Reports this collision, if it has not been reported and all its digits are certain. False if they are not
  // certain.
  bool tell(const ObstacleId& obstacle) {
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

  PassageStep arrive(JourneyEnd end) {
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
  Function place(int i, const Ball* time) const {
    Function function{Ball(centre_[i]) + state_.y[i], {}};
    function.gradient[i] = Ball(1);
    if (time) {
      function.value += (*time - state_.t) * state_.v[i];
      function.gradient[D + i] = *time - component(kTime);
      function.gradient[kTime] = -component(static_cast<int>(D) + i);
    }
    return function;
  }

  Ball distance(const std::array<Function, D>& place) const {
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

  Ball enclosed(const Function& function) const {
    return function.value.widened(box_.width_of(function.gradient));
  }

  // A component of the state, enclosed for the whole box.
  Ball component(int i) const {
    const Ball& middle = i == kTime ? state_.t : i < static_cast<int>(D) ? state_.y[i] : state_.v[i - D];
    return middle.widened(box_.width_of(i));
  }

  bool describe(const Ball* time, std::vector<std::string>& x, std::vector<std::string>& v) const {
    const Ball unit(route_.problem.unit);
    const Bound length = length_scale(),
                speed = largest_size(state_.v) * Bound::power_of_two(-velocity_exponent_) / unit.least_size();
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

  bool describe_distance(const Ball* time, std::string& text) const {
    std::array<Function, D> places;
    for (std::size_t i = 0; i < D; ++i) places[i] = place(static_cast<int>(i), time);
    const Bound length = length_scale();
    const auto decimals = decimal(distance(places) / Ball(route_.problem.unit), &length);
    if (decimals) text = *decimals;
    return decimals.has_value();
  }

  // In the scene's own unit.
  Bound length_scale() const { return cell_ / Ball(route_.problem.unit).least_size(); }

  // Gives the requested digits. A number that is known much better, and still could be rounded to either
  // side, is midway between two decimals or nearly so; then one or two digits more are given. A number that
  // cannot be told from 0, far below its `scale`, is "0e-k", or "0e+k": it is less than 10^-k, or 10^k, and no
  // digit is certain. (Times have no `scale`, because they are above 0.)
  std::optional<std::string> decimal(const Ball& number, const Bound* scale = nullptr) const {
    constexpr double kDigitsABit = 0.30102, kMoreThanDigitsABit = 0.30103;  // log10(2) is between
    constexpr long kMidway = 96, kNothing = 256;
    const int digits = route_.journey.digits;
    if (auto text = certain_decimal(number, digits)) return text;
    if (!number.is_finite()) return std::nullopt;
    const Bound size = number.size(), radius = number.radius();
    const auto enough = static_cast<long>(kBitsADigit * digits);
    if (!number.is_positive() && !number.is_negative()) {
      if (!scale || scale->exponent() - size.exponent() < enough + kNothing) return std::nullopt;
      const double octaves = static_cast<double>(size.exponent());
      const auto most =
          static_cast<long>(std::ceil(octaves * (octaves > 0 ? kMoreThanDigitsABit : kDigitsABit)));
      return (most > 0 ? "0e+" : "0e-") + std::to_string(std::labs(most));
    }
    if (size.exponent() - radius.exponent() < enough + kMidway) return std::nullopt;
    for (int more = digits + 1; more <= digits + 2; ++more)
      if (auto text = certain_decimal(number, more)) return text;
    return std::nullopt;
  }

  Route<D>& route_;
  const long bits_;
  Bound cell_;                  // the size of a cell
  long velocity_exponent_ = 0;  // the velocity here is the true one (in the problem's unit) times 2^this
  State<D> state_;              // the middle of the box: balls without radius
  ZVec<D> centre_;              // of the obstacle at which the particle is, or 0
  std::optional<ObstacleId> from_;
  Box box_;
  std::uint64_t collisions_ = 0;
  Arrival arrival_;
};

}  // namespace lorentz::oracle
