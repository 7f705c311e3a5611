// The walk from cell to cell that most adapters in C++ share. Along the ray, the walk asks the library about
// every ball that reaches into the cell: whether and when the segment in the cell enters it. The library
// decides about a ball; the walk (in binary64) decides which balls there are. A library is a class with
//   void place(const Vec& c, double r);                             the ball
//   bool inside(const Vec& p);                                      whether p lies in it; absent if the ray
//                                                                   cast's own rule for such starts counts
//   std::optional<double> enters(const Vec& p, const Vec& d);       at which fraction of d does p + f d enter it?
// In world coordinates p is the start of the flight, and d ends where the flight leaves the cell. With the
// argument `cells`, p is the point where the flight enters the cell, and all coordinates are relative to the
// cell, as with periodic boundaries. Numbers then stay small, as a library in binary32 needs.
#pragma once
#include <chrono>
#include <cstring>

#include "stream.hpp"

inline bool has_argument(int argc, char** argv, const char* word) {
  return std::any_of(argv + 1, argv + argc, [&](const char* a) { return !std::strcmp(a, word); });
}

// The time of the library's own ray casts. A cast takes about 10 ns, like reading the clock. Therefore casts
// are recorded and repeated, a thousand or more in a row, between two readings of the clock, whose cost is
// then negligible. The time for placing the balls is measured in the same way and subtracted, because the
// balls of a real program are already placed. The tests whether the start is in a ball are not included.
template <class Library>
class Stopwatch {
 public:
  void note(const Vec& p, const Vec& d, const Vec& c, double r) { casts_.push_back({p, d, c, r}); }

  void measure(Library& library, std::size_t at_least = kBlock) {
    if (casts_.empty() || casts_.size() < at_least) return;
    const double all = again(library, true);
    seconds_ += std::max(0., all - again(library, false));
    casts_.clear();
  }

  double seconds() const { return seconds_; }

 private:
  struct Cast {
    Vec p, d, c;
    double r;
  };
  static constexpr std::size_t kBlock = 1024;

  double again(Library& library, bool cast) {
    const auto start = std::chrono::steady_clock::now();
    double sum = 0;
    for (const Cast& each : casts_) {
      library.place(each.c, each.r);
      if (cast) sum += library.enters(each.p, each.d).value_or(0);
    }
    sink_ = sum;  // so that no compiler removes the casts
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  std::vector<Cast> casts_;
  double seconds_ = 0;
  volatile double sink_ = 0;
};

// The cells of a crystal along a ray, each with the times at which the ray enters and leaves it.
class Cells {
 public:
  Vec cell{};
  double enter = 0, leave = 0;
  int number = 0;  // the number of cells before this one

  Cells(const Lattice& lattice, const Query& query) : rank_(lattice.rank) {
    for (std::size_t k = 0; k < rank_; ++k) {
      y_[k] = dot(lattice.dual[k], query.x);
      s_[k] = dot(lattice.dual[k], query.v);
      cell[k] = std::floor(y_[k]);
    }
    find_exit();
  }

  void next() {
    cell[axis_] += s_[axis_] > 0 ? 1 : -1;
    enter = leave;
    ++number;
    find_exit();
  }

 private:
  void find_exit() {
    leave = INFINITY;
    for (std::size_t k = 0; k < rank_; ++k)
      if (const double t = (cell[k] + (s_[k] > 0) - y_[k]) / s_[k]; s_[k] != 0 && t < leave)
        leave = t, axis_ = k;
  }

  std::size_t rank_, axis_ = 0;
  Vec y_{}, s_{};
};

template <class Library>
class Walk {
 public:
  Walk(Library& library, bool in_cells) : library_(library), in_cells_(in_cells) {}

  void use(const Scene&) {}

  Found first(const Scene& scene, const Query& query) {
    Found found;
    for (std::size_t number = 0; number < scene.lattices.size(); ++number) {
      const Lattice& lattice = scene.lattices[number];
      if (lattice.rank == 0)
        single(lattice, static_cast<int>(number), query, found);
      else
        crystal(lattice, static_cast<int>(number), query, found);
    }
    return found;
  }

  double seconds() {
    stopwatch_.measure(library_, 0);
    return stopwatch_.seconds();
  }

 private:
  static constexpr int kMostCells = 20000;

  void crystal(const Lattice& lattice, int number, const Query& query, Found& found) {
    for (Cells at(lattice, query); at.number < kMostCells; at.next()) {
      const Vec corner = lattice.at(at.cell);
      const double begin = in_cells_ ? at.enter : 0;
      const Vec p = in_cells_ ? add(add(query.x, query.v, begin), corner, -1) : query.x;
      for (const auto& [atom, r, n, centre] : lattice.near) {
        const Name name{number, atom, add(at.cell, n)};
        const Vec c = in_cells_ ? centre : add(corner, centre);
        if (name != query.from) ball(p, query.v, begin, at.leave, c, r, at.number == 0, name, found);
      }
      if (found.inside || (found.hit && found.hit->first <= at.leave) || at.leave >= query.max_time) return;
    }
    found.undecided = true;
  }

  // The library alone, without a walk. The segment ends behind the ball, at a power of 2, so nothing is
  // rounded.
  void single(const Lattice& lattice, int number, const Query& query, Found& found) {
    for (const auto& [atom, r, n, centre] : lattice.near) {
      const Name name{number, atom, n};
      const Vec w = add(centre, query.x, -1);
      const double enough = 2 * (std::sqrt(dot(w, w)) + r) / std::sqrt(dot(query.v, query.v));
      const double end = std::exp2(std::ceil(std::log2(enough)));
      if (name != query.from) ball(query.x, query.v, 0, end, centre, r, true, name, found);
    }
  }

  void ball(const Vec& p, const Vec& v, double begin, double end, const Vec& c, double r, bool at_start,
            const Name& name, Found& found) {
    library_.place(c, r);
    if constexpr (requires { library_.inside(p); })
      if (at_start && library_.inside(p)) found.add_inside(name);
    if (end <= begin) return;  // no segment in this cell: the ray only touches its corner
    const Vec d = add({}, v, end - begin);
    if (const auto f = library_.enters(p, d)) found.add_hit(begin + *f * (end - begin), name);
    stopwatch_.note(p, d, c, r);
    stopwatch_.measure(library_);
  }

  Library& library_;
  bool in_cells_;
  Stopwatch<Library> stopwatch_;
};

template <class Library>
int walk(Library& library, const Claim& claim, int argc, char** argv) {
  Walk<Library> engine(library, has_argument(argc, argv, "cells"));
  return Server(engine, claim).run();
}
