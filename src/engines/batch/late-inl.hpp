// Times that take long are computed at the end of a stretch, when there are enough of them to fill the lanes.
// Private to the batch engine.

/// Hits in a scene with one atom whose time is computed late: grazed balls, and times that `soon_rounded`
/// could not round.
template <int D, bool kUnit, bool kBall>
class LateTimes {
 public:
  HWY_INLINE void push(M m, std::size_t at, const LaneEntry<D, kBall>& entry) {
    for (int k = 0; k < D; ++k) store_some(entry.n[k], m, n_[k] + count_);
    store_some(entry.s, m, s_ + count_);
    store_some(entry.slack, m, slack_ + count_);
    store_some(entry.slack_error, m, slack_error_ + count_);
    for (unsigned rest = bits_of(m); rest != 0; rest &= rest - 1)
      index_[count_++] = static_cast<int>(at) + __builtin_ctz(rest);
  }

  HWY_INLINE void finish(const PreparedScene& scene, Stretch& stretch) {
    for (std::size_t at = 0; at < count_; at += kLanes) finish_at(at, scene, stretch);
  }

 private:
  HWY_INLINE void finish_at(std::size_t at, const PreparedScene& scene, Stretch& stretch) const {
    const std::size_t length = count_ - at < kLanes ? count_ - at : kLanes;
    HWY_ALIGN double place[D][kLanes] = {}, velocity[D][kLanes] = {}, time[kLanes];
    for (std::size_t lane = 0; lane < length; ++lane)
      for (int k = 0; k < D; ++k) {
        place[k][lane] = stretch.x[k][index_[at + lane]];
        velocity[k][lane] = stretch.v[k][index_[at + lane]];
      }
    V x[D], v[D];
    for (int k = 0; k < D; ++k) x[k] = load(place[k]), v[k] = load(velocity[k]);
    Lanes lanes(first_lanes(length));
    const Velocity<D> scaled(v, lanes);
    Start<D, kUnit, kBall> start;
    start.set(scene.inverse_unit, scene.atoms[0], x, lanes);
    LaneEntry<D, kBall> entry;
    for (int k = 0; k < D; ++k) entry.n[k] = load(n_[k] + at);
    entry.s = load(s_ + at), entry.slack = load(slack_ + at), entry.slack_error = load(slack_error_ + at);
    const Times<D, kUnit, kBall> times(start, entry, scaled.scaled);
    M is_rounded = no_lane();
    const V found = stretch.rounded ? times.rounded(is_rounded) : times.rare_time();
    store(scaled.template time_of<kUnit>(found, scene.unit), time);
    const unsigned rounded = bits_of(is_rounded);
    for (std::size_t lane = 0; lane < length; ++lane) {
      stretch.time[index_[at + lane]] = time[lane];
      stretch.time_is_rounded[index_[at + lane]] = rounded >> lane & 1;
    }
  }

  template <class T>
  using Column = T[kStretch + 2 * kMaxLanes];

  std::size_t count_ = 0;
  Column<int> index_;
  Column<double> n_[D], s_, slack_, slack_error_;
};
