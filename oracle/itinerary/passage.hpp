// A journey at one precision, and the results that the next passage, at a higher precision, takes over from
// it. Private to oracle/itinerary.
#pragma once

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
  Passage(Route<D>& route, long bits);

  /// Goes on as far as this precision allows; returns true if that is the journey's end.
  bool go();

  /// The end, or how far everything is certain.
  const Arrival& arrival() const { return arrival_; }
  long bits() const { return bits_; }
  long bits_lost() const;
  /// The part of the journey that is done, by collisions or time.
  double part_done() const;

 private:
  static constexpr int N = 2 * static_cast<int>(D) + 1;  // y, v, t
  static constexpr int kTime = N - 1;
  using Gradient = BallVec<N>;
  enum class PassageStep { done, arrived, lost };

  /// A function of the state: its value in the middle, rounded, and its gradient enclosed for the whole box.
  struct Function {
    Ball value;
    Gradient gradient;
  };

  PassageStep step();
  PassageStep collide_with(const ObstacleId& obstacle);
  std::optional<EnclosedCollision<D>> collision_anywhere(const ZVec<D>& centre, const Form<D>& form) const;
  typename ErrorBox<N>::Matrix derivative_of(const EnclosedCollision<D>& anywhere, const Form<D>& form) const;
  void move_on(const EnclosedCollision<D>& middle, const typename ErrorBox<N>::Matrix* derivative);
  std::optional<bool> is_beyond_end(const Ball& time) const;
  bool tell(const ObstacleId& obstacle);
  PassageStep arrive(JourneyEnd end);

  Function place(int component, const Ball* time) const;
  Ball distance(const std::array<Function, D>& place) const;
  Ball enclosed(const Function& function) const;
  Ball component(int i) const;
  bool describe(const Ball* time, std::vector<std::string>& x, std::vector<std::string>& v) const;
  bool describe_distance(const Ball* time, std::string& text) const;
  std::optional<std::string> decimal(const Ball& number, const Bound* scale = nullptr) const;
  Bound length_scale() const;
  Bound speed_scale() const;
  Ball end_time() const;
  long working_bits() const;

  Route<D>& route_;
  const long bits_;
  Bound cell_;                  // the size of a cell
  long velocity_exponent_ = 0;  // the velocity here is the true one (in the problem's unit) times 2^this
  State<D> state_;              // the middle of the box: balls without radius
  ZVec<D> centre_;              // of the obstacle at which the particle is, or 0
  std::optional<ObstacleId> from_;
  ErrorBox<N> box_;
  std::uint64_t collisions_ = 0;
  Arrival arrival_;
};

extern template class Passage<2>;
extern template class Passage<3>;

}  // namespace lorentz::oracle
