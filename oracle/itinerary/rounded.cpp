#include <lorentz/itinerary.hpp>
#include "oracle/itinerary/integer_problem.hpp"
#include "oracle/itinerary/sight.hpp"

namespace lorentz::oracle {

struct RoundedItinerary::Impl {
  virtual ~Impl() = default;
  virtual std::optional<ObstacleId> next() = 0;
};

namespace {

template <std::size_t D>
class Rounded final : public RoundedItinerary::Impl {
 public:
  Rounded(const RationalScene& scene, const Start& start, long bits)
      : problem_(scene, start), sight_(problem_.scene), bits_(bits), from_(start.from) {
    const Ball::WorkingPrecision precision(bits);
    const BallVec<D> v = velocity_of<D>(start, problem_.unit);
    for (std::size_t i = 0; i < D; ++i) {
      state_.y[i] = (Ball(problem_.x[i]) + Ball()).middle();  // a sum is rounded
      state_.v[i] = v[i].middle();
    }
    speed2_ = dot(state_.v, state_.v).middle();
  }

  std::optional<ObstacleId> next() override {
    const Ball::WorkingPrecision precision(bits_);
    const auto next = sight_.next({centre_, state_, {}, {}, from_});
    const auto* obstacle = std::get_if<ObstacleId>(&next);
    if (!obstacle) return std::nullopt;
    const ZVec<D> centre = sight_.centre_of(*obstacle);
    State<D> state = state_.seen_from(centre_, centre);
    for (Ball& component : state.y) component = component.middle();
    const auto collision = collide(state, sight_.form_of(*obstacle));
    if (!collision) return std::nullopt;  // to this precision it only touches the obstacle
    settle(*collision, sight_.form_of(*obstacle));
    centre_ = centre;
    from_ = *obstacle;
    return *obstacle;
  }

 private:
  // Puts the particle on the surface, at the speed of the start, as good programs do.
  void settle(const EnclosedCollision<D>& collision, const Form<D>& form) {
    const Ball onto = form.radius / sqrt(dot(collision.w, collision.w));
    const Ball faster = sqrt(speed2_ / dot(collision.after.v, collision.after.v));
    for (std::size_t i = 0; i < D; ++i) {
      state_.y[i] = (collision.after.y[i] * onto).middle();
      state_.v[i] = (collision.after.v[i] * faster).middle();
    }
  }

  IntegerProblem<D> problem_;
  Sight<D> sight_;
  long bits_;
  State<D> state_;
  Ball speed2_;
  ZVec<D> centre_;
  std::optional<ObstacleId> from_;
};

}  // namespace

RoundedItinerary::RoundedItinerary(const RationalScene& scene, const Start& start, long bits) {
  checked(start, checked(scene));
  if (bits < 2 || bits > kMostBits) throw InputError("bits: needs from 2 to " + std::to_string(kMostBits));
  if (scene.dimension == 2)
    impl_ = std::make_unique<Rounded<2>>(scene, start, bits);
  else
    impl_ = std::make_unique<Rounded<3>>(scene, start, bits);
}

RoundedItinerary::RoundedItinerary(RoundedItinerary&&) noexcept = default;
RoundedItinerary& RoundedItinerary::operator=(RoundedItinerary&&) noexcept = default;
RoundedItinerary::~RoundedItinerary() = default;

std::optional<ObstacleId> RoundedItinerary::next() {
  return impl_->next();
}

}  // namespace lorentz::oracle
