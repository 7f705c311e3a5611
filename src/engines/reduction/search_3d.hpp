// The search for the first ball along a prepared direction, in 3D (direction_3d-inl.hpp says how): window by
// window, and in each window plane by plane. Private to the reduction engine.
#pragma once

#include "src/engines/reduction/thin_section_3d.hpp"

namespace lorentz {

/// The search for one start.
template <class Arch, bool kUnit, bool kBall, class Integer = double>
class Search3 {
  using Window = Window3<Arch, kUnit, kBall, Integer>;
  template <class, bool, bool, class>
  friend class Search3;

  Window window_;
  Candidates3<Arch, kUnit, kBall, Integer> candidates_;
  Lines3<Arch, kUnit, kBall, Integer> lines_;

 public:
  Search3(const Bravais& lattice, const typename Window::Direction& direction,
          const Offset<SplitProduct, 3>& offset, const UnroundedLook<3, kUnit, kBall>& unrounded)
      : window_(lattice, direction, offset),
        candidates_(window_, unrounded),
        lines_(window_, candidates_),
        found(candidates_.found) {}
  Search3(const Search3&) = delete;
  Search3& operator=(const Search3&) = delete;

  Found<3>& found;

  /// `from`: coefficients of the ball that is being left, or null. Balls that are entered after s_limit may
  /// be ignored.
  Outcome run(const Wide* from, double s_limit) {
    candidates_.from = from;
    candidates_.s_limit = s_limit;
    if constexpr (!(kUnit && kBall)) return search(s_limit);
    const bool early = window_.is_nearly_parallel();
    if (early && stays_between_planes(window_.to.v, window_.home(), window_.lattice.radius)) return never();
    const Outcome outcome = search(s_limit);
    if (outcome != Outcome::undecided) return outcome;
    return is_between_planes() ? never() : search_with_wide_integers(s_limit);
  }

 private:
  // Goes on with the window that was too hard for binary64.
  [[gnu::noinline]] Outcome search_with_wide_integers(double s_limit) {
    if constexpr (kUnit && kBall && std::is_same_v<Integer, double>) {
      DirectionOf3<SplitProduct, kUnit, kBall, Wide> direction;
      direction.template set<Arch>(window_.lattice, window_.to.v, true);
      Search3<Arch, kUnit, kBall, Wide> wide(window_.lattice, direction, window_.offset,
                                             candidates_.unrounded);
      wide.candidates_.from = candidates_.from, wide.candidates_.s_limit = s_limit;
      wide.window_.begin = window_.begin;
      if (window_.begin > 0) wide.window_.lengthen(true);
      Outcome outcome = wide.search(s_limit);
      if (outcome == Outcome::undecided && wide.is_between_planes()) outcome = wide.never();
      found = wide.found;
      found.needs(Stage::double_double);
      return outcome;
    }
    return Outcome::undecided;
  }

  Outcome search(double s_limit) {
    for (int window = 0; window < kMaxWindows; ++window) {
      if (!window_.basis->usable || !window_.set_anchor()) return found.give_up();
      none_met_ = true;
      if (!scan_window()) return found.give_up();
      if (found.any()) return Outcome::hit;
      window_.advance(none_met_, kappa_);
      if (window_.begin > s_limit || window_.begin > 2 * period()) return Outcome::never;
      if (!(window_.begin < kFarthest<Integer>)) return found.give_up();
      if (window >= 1) window_.lengthen(true);
    }
    return found.give_up();
  }

  // Does the line stay between two of the planes by which the window is searched?
  bool is_between_planes() {
    Vec b[2];
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 3; ++i) b[k][i] = high_of(window_.basis->b[k].n[i]);
    return stays_between_planes(window_.to.v, window_.home(), window_.lattice.radius, b[0], b[1]);
  }

  Outcome never() {
    found.stage = Stage::double_double;
    return Outcome::never;
  }

  // Scans the planes k b_2 + (b_0, b_1) that meet the window. False, here and below: undecided.
  bool scan_window() {
    double low, high;
    kappa_ = window_.plane_of(window_.anchor_point);
    window_.set_planes(kappa_, low, high);
    if (!are_countable(low, high)) return false;
    for (double k = std::ceil(low); k <= high; ++k) {
      const typename Window::Point point = window_.anchor_point.step(k, window_.basis->b[2]);
      if (!scan_plane(point, kappa_ + k)) return false;
    }
    return true;
  }

  // Scans the lines of the plane of this point that meet the flight's cylinder.
  bool scan_plane(const typename Window::Point& point, double kappa) {
    typename Window::Section section;
    if (!window_.set_section(point, kappa, candidates_.end(), section)) return true;
    none_met_ = false;
    const double low = section.low, high = section.high, z_first = section.z_first, z_last = section.z_last;
    if (!are_countable(low, high)) return false;
    if (high - low > kManyLines)
      return ThinSection3<Arch, kUnit, kBall, Integer>(window_, candidates_, lines_)
          .scan(point, z_first, z_last, kappa, section.xi_error);
    const typename Window::Basis& basis = *window_.basis;
    for (double k = low; k <= high; ++k)
      if (!lines_.scan(point.step(k, basis.b[1]), basis.b[0], z_first, z_last)) return false;
    return true;
  }

  // The obstacles on the line repeat after this s: v . b of a lattice vector b that is exactly parallel to
  // the line.
  double period() const {
    for (const typename Window::Arm& arm : window_.basis->b)
      if (window_.is_parallel(arm)) return arm.z * window_.basis->length;
    return Found<3>::kNothing;
  }

  double kappa_ = 0;      // of the anchor's plane
  bool none_met_ = true;  // of the window's planes
};

}  // namespace lorentz
