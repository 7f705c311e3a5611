// CGAL: CGAL::intersection of a line with a sphere in the Exact_spherical_kernel_3, in exact algebraic
// numbers; 2D as the plane z = 0. A control, which should be right. It has its own walk through the cells, in
// exact rationals.
//
// Formula: internal to CGAL, and exact. The time is rounded at the end by CGAL::to_double of the exact
// number. This part of CGAL is under the GPL, so this is a separate program; no part of lorentz is linked
// with it.
#include <CGAL/Exact_spherical_kernel_3.h>
#include <CGAL/version.h>

#include "../walk.hpp"

using Kernel = CGAL::Exact_spherical_kernel_3;
using Rational = Kernel::FT;
using Root = Kernel::Root_of_2;
using Point = std::array<Rational, 3>;

static Point exact(const Vec& a) {
  return {Rational(a[0]), Rational(a[1]), Rational(a[2])};
}
static Rational product(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The cells along the ray, exactly.
class ExactCells {
 public:
  Vec cell{};
  Rational leave;
  int number = 0;

  ExactCells(const Lattice& lattice, const Point& x, const Point& v) : rank_(lattice.rank) {
    const std::array<Point, 3> u{exact(lattice.u[0]), exact(lattice.u[1]), exact(lattice.u[2])};
    for (std::size_t i = 0; i < rank_; ++i) {
      const Point &a = u[(i + 1) % 3], &b = u[(i + 2) % 3];
      const Point w{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
      const Rational volume = product(u[i], w);
      y_[i] = product(w, x) / volume;
      s_[i] = product(w, v) / volume;
      cell[i] = std::floor(CGAL::to_double(y_[i]));
      while (Rational(cell[i]) > y_[i]) --cell[i];
      while (Rational(cell[i] + 1) <= y_[i]) ++cell[i];
    }
    find_exit();
  }

  void next() {
    cell[axis_] += s_[axis_] > 0 ? 1 : -1;
    ++number;
    find_exit();
  }

 private:
  void find_exit() {
    bool found = false;
    for (std::size_t k = 0; k < rank_; ++k)
      if (s_[k] != 0)
        if (const Rational t = (Rational(cell[k] + (s_[k] > 0)) - y_[k]) / s_[k]; !found || t < leave)
          leave = t, axis_ = k, found = true;
  }

  std::size_t rank_, axis_ = 0;
  Point y_, s_;
};

class Cgal {
 public:
  void use(const Scene&) {}

  Found first(const Scene& scene, const Query& query) {
    Flight flight(query);
    for (std::size_t number = 0; number < scene.lattices.size(); ++number)
      along(scene.lattices[number], static_cast<int>(number), flight);
    if (flight.best) flight.found.hit = {flight.time(), flight.best->second};
    return flight.found;
  }

  double seconds() const { return seconds_; }

 private:
  static constexpr int kMostCells = 2000;

  struct Flight {
    const Query& query;
    Point x, v;
    Kernel::Point_3 start;
    Kernel::Line_3 line;
    std::size_t axis = 0;  // along which points of the line are compared
    bool up;
    std::optional<std::pair<Root, Name>> best;  // the coordinate of the entry along that axis
    Found found;

    explicit Flight(const Query& q)
        : query(q),
          x(exact(q.x)),
          v(exact(q.v)),
          start(x[0], x[1], x[2]),
          line(start, Kernel::Vector_3(v[0], v[1], v[2])) {
      for (std::size_t k = 1; k < 3; ++k)
        if (std::abs(q.v[k]) > std::abs(q.v[axis])) axis = k;
      up = q.v[axis] > 0;
    }
    template <class A, class B>
    bool before(const A& a, const B& b) const {
      return up ? a < b : a > b;
    }
    double time() const { return std::max(0., CGAL::to_double((best->first - x[axis]) / v[axis])); }
  };

  void along(const Lattice& lattice, int number, Flight& flight) {
    for (ExactCells at(lattice, flight.x, flight.v); at.number < kMostCells; at.next()) {
      for (const auto& near : lattice.near)
        if (const Name name{number, near.atom, add(at.cell, near.n)}; name != flight.query.from)
          ball(lattice, name, near.r, at.number == 0, flight);
      if (lattice.rank == 0 || flight.found.inside) return;
      const Rational edge = flight.x[flight.axis] + at.leave * flight.v[flight.axis];
      if (flight.best && !(flight.up ? flight.best->first > edge : flight.best->first < edge)) return;
    }
    flight.found.undecided = true;
  }

  void ball(const Lattice& lattice, const Name& name, double r, bool at_start, Flight& flight) {
    const auto& [number, atom, n] = name;
    Point c = exact(lattice.position[atom]);
    for (std::size_t i = 0; i < lattice.rank; ++i)
      for (int k = 0; k < 3; ++k) c[k] += Rational(n[i]) * Rational(lattice.u[i][k]);
    const Kernel::Sphere_3 sphere(Kernel::Point_3(c[0], c[1], c[2]), Rational(r) * Rational(r));
    if (at_start && sphere.has_on_bounded_side(flight.start)) flight.found.add_inside(name);
    const std::optional<Root> place = entry(sphere, flight);
    if (!place || flight.before(*place, flight.x[flight.axis])) return;
    if (!flight.best || flight.before(*place, flight.best->first) ||
        (*place == flight.best->first && name < flight.best->second))
      flight.best = {*place, name};
  }

  // The coordinate along the flight's axis at which the line enters the sphere. A tangent line does not enter
  // it.
  std::optional<Root> entry(const Kernel::Sphere_3& sphere, const Flight& flight) {
    using Hit = std::pair<Kernel::Circular_arc_point_3, unsigned>;
    std::vector<CGAL::SK3_Intersection_traits<Kernel, Kernel::Line_3, Kernel::Sphere_3>::type> hits;
    const auto start = std::chrono::steady_clock::now();  // microseconds: the clock's cost does not matter
    CGAL::intersection(flight.line, sphere, std::back_inserter(hits));
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (hits.size() != 2) return {};
    const auto place = [&](const auto& hit) -> Root {
      const auto& point = boost::get<Hit>(hit).first;
      return flight.axis == 0 ? point.x() : flight.axis == 1 ? point.y() : point.z();
    };
    const Root a = place(hits[0]), b = place(hits[1]);
    return flight.before(a, b) ? a : b;
  }

  double seconds_ = 0;
};

int main() {
  Cgal engine;
  return Server(engine, Claim{"CGAL", CGAL_VERSION_STR, "binary64", {2, 3}}).run();
}
