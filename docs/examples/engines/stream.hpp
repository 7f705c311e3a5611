// The parts that all adapters in C++ share: vectors, lattices of balls, reading and writing of the streams of
// docs/formats.md. walk.hpp adds the walk from cell to cell.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

using Vec = std::array<double, 3>;  // in 2D with z = 0
using json = nlohmann::json;

inline double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec add(const Vec& a, const Vec& b, double s = 1) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// A scene or a query that an adapter does not support. The scene or query itself is valid.
struct Unsupported : std::runtime_error {
  using runtime_error::runtime_error;
};

inline double number(const json& j) {
  if (!j.is_string()) {
    if (!j.is_number()) throw std::runtime_error("expected a number, found " + j.dump());
    return j.get<double>();
  }
  const std::string text = j.get<std::string>();  // a hexadecimal float
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if ((text.rfind("0x", 0) != 0 && text.rfind("-0x", 0) != 0) || *end)
    throw std::runtime_error("expected a number, found " + j.dump());
  return value;
}

inline double integer(const json& j) {
  if (!j.is_string()) {
    const double value = number(j);
    if (value != std::floor(value)) throw std::runtime_error("expected an integer, found " + j.dump());
    return value;
  }
  const std::string text = j.get<std::string>();  // beyond 2^53
  const std::size_t digits = text.rfind("-", 0) == 0 ? 1 : 0;
  if (text.size() == digits || text.find_first_not_of("0123456789", digits) != std::string::npos)
    throw std::runtime_error("expected an integer, found " + j.dump());
  return std::stod(text);
}

inline Vec vec(const json& j, std::size_t size, double component(const json&) = number) {
  if (!j.is_array() || j.size() != size) throw std::runtime_error("wrong number of components: " + j.dump());
  Vec v{};
  for (std::size_t k = 0; k < size; ++k)
    if (!std::isfinite(v[k] = component(j[k]))) throw std::runtime_error("not finite: " + j.dump());
  return v;
}

using Name = std::tuple<int, int, Vec>;  // an obstacle: lattice, atom, cell

// A crystal of balls, or single balls: lattices that have as many vectors as the scene has dimensions, or
// none.
struct Lattice {
  struct Near {  // a ball that reaches into the cell 0, and its own cell
    int atom;
    double r;
    Vec n, centre;
  };
  std::size_t rank;
  std::array<Vec, 3> u{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, dual;  // dual[i] . u[k] = (i == k)
  std::vector<Near> near;
  std::vector<Vec> position;  // of the atoms

  Lattice(const json& lattice, std::size_t dimension) : rank(lattice.at("vectors").size()) {
    if (rank != 0 && rank != dimension) throw Unsupported("rows and layers are not done");
    for (std::size_t k = 0; k < rank; ++k) u[k] = vec(lattice["vectors"][k], dimension);
    const double volume = dot(u[0], cross(u[1], u[2]));
    if (volume == 0) throw std::runtime_error("the primitive vectors are dependent");
    for (int k = 0; k < 3; ++k) dual[k] = cross(u[(k + 1) % 3], u[(k + 2) % 3]);
    for (Vec& w : dual)
      for (double& c : w) c /= volume;
    for (const json& atom : lattice.at("atoms")) add_atom(atom, dimension);
    if (position.empty()) throw std::runtime_error("a lattice without atoms");
  }

  Vec at(const Vec& n) const { return add(add(add({}, u[0], n[0]), u[1], n[1]), u[2], n[2]); }

 private:
  void add_atom(const json& atom, std::size_t dimension) {
    if (atom.contains("semiaxes")) throw Unsupported("ellipsoids are not done, only balls");
    const Vec p = vec(atom.at("position"), dimension);
    const double r = number(atom.at("radius"));
    if (!(r > 0) || std::isinf(r)) throw std::runtime_error("a radius must be positive");
    Vec low{}, high{};
    for (std::size_t k = 0; k < rank; ++k) {
      // Slightly wider than the ball, because the walk rounds.
      const double c = -dot(dual[k], p), e = r * std::sqrt(dot(dual[k], dual[k])) + 1e-9;
      low[k] = std::ceil(c - e), high[k] = std::floor(c + 1 + e);
    }
    if ((high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1) > 1000)
      throw Unsupported("a ball that reaches into more than 1000 cells");
    for (double a = low[0]; a <= high[0]; ++a)
      for (double b = low[1]; b <= high[1]; ++b)
        for (double c = low[2]; c <= high[2]; ++c)
          near.push_back({static_cast<int>(position.size()), r, {a, b, c}, add(at({a, b, c}), p)});
    position.push_back(p);
  }
};

struct Scene {
  std::size_t dimension;
  std::vector<Lattice> lattices;
};

struct Query {
  Vec x, v;
  std::optional<Name> from;
  double max_time = INFINITY;
};

// The result of an engine: the ball that contains the start, or the ball that is entered first.
struct Found {
  std::optional<Name> inside;
  std::optional<std::pair<double, Name>> hit;
  bool undecided = false;

  void add_inside(const Name& name) { inside = inside ? std::min(*inside, name) : name; }
  void add_hit(double time, const Name& name) {
    if (std::isnan(time)) throw std::runtime_error("the library says: not a number");
    const std::pair<double, Name> another{time, name};
    hit = hit ? std::min(*hit, another) : another;
  }
};

struct Claim {
  std::string name, version, precision;
  std::vector<int> dimensions;
  std::string starts_inside;  // the rule for them that the library promises, or empty
};

inline Query query_of(const json& item, const Scene& scene) {
  Query query{vec(item.at("x"), scene.dimension), vec(item.at("v"), scene.dimension), {}};
  if (query.v == Vec{}) throw std::runtime_error("v is zero");
  if (item.contains("max_time") && item["max_time"] != "inf") query.max_time = number(item["max_time"]);
  if (!item.contains("from")) return query;
  const json& from = item["from"];
  const auto index = [&](const char* key, std::size_t size) {
    const double value = integer(from.at(key));
    if (!(value >= 0 && value < double(size))) throw std::runtime_error("from: no such obstacle");
    return static_cast<std::size_t>(value);
  };
  const std::size_t lattice = index("lattice", scene.lattices.size());
  const std::size_t atom = index("atom", scene.lattices[lattice].position.size());
  const Vec cell = vec(from.at("cell"), scene.lattices[lattice].rank, integer);
  query.from = Name{static_cast<int>(lattice), static_cast<int>(atom), cell};
  return query;
}

inline Scene scene_of(const json& item, const std::vector<int>& dimensions) {
  Scene scene{item.at("dimension"), {}};
  if (scene.dimension != 2 && scene.dimension != 3) throw std::runtime_error("dimension must be 2 or 3");
  if (std::find(dimensions.begin(), dimensions.end(), static_cast<int>(scene.dimension)) == dimensions.end())
    throw Unsupported("the library does not do this dimension");
  for (const json& lattice : item.at("lattices")) scene.lattices.emplace_back(lattice, scene.dimension);
  if (scene.lattices.empty()) throw std::runtime_error("a scene without lattices");
  return scene;
}

inline json answer_of(const Found& found, const Scene& scene, double max_time) {
  const bool in_time = found.hit && found.hit->first < max_time;
  if (!found.inside && !in_time && !found.undecided && std::isfinite(max_time)) return {{"outcome", "later"}};
  if (!found.inside && found.undecided) return {{"outcome", "undecided"}};
  if (!found.inside && !found.hit) return {{"outcome", "never"}};
  const auto& [lattice, atom, n] = found.inside ? *found.inside : found.hit->second;
  json cell = json::array();
  for (std::size_t k = 0; k < scene.lattices[lattice].rank; ++k) {
    char digits[400];
    std::snprintf(digits, sizeof digits, "%.0f", n[k]);
    cell.push_back(std::abs(n[k]) < 9e15 ? json(static_cast<std::int64_t>(n[k])) : json(digits));
  }
  json answer = {
      {"outcome", found.inside ? "inside" : "hit"}, {"lattice", lattice}, {"atom", atom}, {"cell", cell}};
  if (!found.inside) answer["time"] = std::isinf(found.hit->first) ? json("inf") : json(found.hit->first);
  return answer;
}

inline json error_of(const std::exception& error, bool unsupported) {
  json answer = {{"outcome", "error"}, {"message", error.what()}};
  if (unsupported) answer["reason"] = "unsupported";
  return answer;
}

// Answers the stream on standard input. An engine has
//   void use(const Scene&);                    the scene of the following queries
//   Found first(const Scene&, const Query&);
//   double seconds();                          the time of the library's own calls up to now
template <class Engine>
class Server {
 public:
  Server(Engine& engine, const Claim& claim) : engine_(engine), claim_(claim) {}

  int run() {
    std::int64_t queries = 0;
    bool empty = true;
    for (std::string line; std::getline(std::cin, line); empty = false)
      if (line.find_first_not_of(" \t\r") != std::string::npos) queries += take(line);
    if (empty) {
      std::cout << json{{"engine", claim()}} << std::endl;
    } else {
      const json time = {{"seconds", engine_.seconds()}, {"queries", queries}};
      std::cout << json{{"engine_time", time}} << std::endl;
    }
    return 0;
  }

 private:
  json claim() const {
    json claim = {{"name", claim_.name},
                  {"version", claim_.version},
                  {"precision", claim_.precision},
                  {"dimensions", claim_.dimensions}};
    if (!claim_.starts_inside.empty()) claim["inside"] = claim_.starts_inside;
    return claim;
  }

  json answer_to(const Query& query) {
    return answer_of(engine_.first(*scene_, query), *scene_, query.max_time);
  }

  bool take(const std::string& line) {  // true if it was a query
    json id, answer;
    try {
      const json item = json::parse(line);
      if (item.contains("golden")) return false;
      if (item.contains("scene")) return take_scene(item["scene"]), false;
      if (item.contains("id")) id = item["id"];
      answer = scene_ ? answer_to(query_of(item, *scene_)) : trouble_;
    } catch (const Unsupported& error) {
      answer = error_of(error, true);
    } catch (const std::exception& error) {  // an invalid line does not end the stream
      answer = error_of(error, false);
    }
    answer["id"] = id;
    std::cout << answer << std::endl;  // flushed, because the asking program may wait for it
    return true;
  }

  void take_scene(const json& item) {
    scene_.reset();
    try {
      Scene scene = scene_of(item, claim_.dimensions);
      engine_.use(scene);
      scene_ = std::move(scene);
    } catch (const Unsupported& error) {  // a valid scene: only its queries are answered
      trouble_ = error_of(error, true);
    } catch (const std::exception& error) {
      trouble_ = error_of(error, false);
      trouble_["id"] = nullptr;
      std::cout << trouble_ << std::endl;
    }
  }

  Engine& engine_;
  Claim claim_;
  std::optional<Scene> scene_;
  json trouble_ = error_of(std::runtime_error("no scene yet"), false);
};
