// A first-hit engine to copy and to replace, standard library only: cell by cell in doubles, one ball per
// cell on the unit square or cubic lattice. Anything else is `unsupported`, and it never answers `never`. It
// reads a query stream of lorentz on stdin and writes an answer stream on stdout. Try
//   lorentz compare --scene cubic --count 1000 --engine cmd:build/naive_engine
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using Vec = std::vector<double>;
constexpr long kMaxCells = 10'000'000;

// The numbers in the value of a key, with any brackets around them; empty if the key is missing.
Vec numbers(const std::string& line, const std::string& key) {
  Vec found;
  std::size_t at = line.find('"' + key + "\":");
  if (at == std::string::npos) return found;
  for (at += key.size() + 3; at < line.size() && line[at] != '"' && line[at] != '}';) {
    char* end = nullptr;
    const double number = std::strtod(&line[at], &end);
    if (end != &line[at]) found.push_back(number);
    at = end != &line[at] ? static_cast<std::size_t>(end - line.data()) : at + 1;
  }
  return found;
}

struct Scene {
  Vec centre;         // of the ball in the cell 0; empty: an unsupported scene
  double radius = 0;  // at most 1/2: a cell between lattice points sees only the balls at its corners

  explicit Scene(const std::string& line) {
    const Vec vectors = numbers(line, "vectors"), size = numbers(line, "radius");
    const bool one = line.find("\"radius\"") == line.rfind("\"radius\"") && size.size() == 1;
    const bool unit = vectors == Vec{1, 0, 0, 1} || vectors == Vec{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (!one || size[0] > 0.5 || !unit || line.find("semiaxes") != std::string::npos) return;
    centre = numbers(line, "position");
    radius = size[0];
  }
};

std::string text_of(double number) {  // the shortest text that reads back as the same number
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

std::string obstacle(const Vec& n) {
  std::string cell;
  for (const double component : n) cell += (cell.empty() ? "" : ",") + text_of(component);
  return "\"lattice\":0,\"atom\":0,\"cell\":[" + cell + "]";
}

std::string first_hit(const Scene& scene, Vec x, const Vec& v, const Vec& from, double limit) {
  const std::size_t dimension = scene.centre.size();
  Vec cell(dimension), n(dimension), best;
  double speed2 = 0, first = INFINITY;
  for (std::size_t k = 0; k < dimension; ++k)
    cell[k] = std::floor(x[k] -= scene.centre[k]), speed2 += v[k] * v[k];
  for (long step = 0; step < kMaxCells; ++step) {
    for (unsigned corner = 0; corner < 1u << dimension; ++corner) {
      double along = 0, distance2 = 0, miss2 = 0;
      for (std::size_t k = 0; k < dimension; ++k) {
        n[k] = cell[k] + (corner >> k & 1);
        along += (n[k] - x[k]) * v[k] / speed2;
        distance2 += (n[k] - x[k]) * (n[k] - x[k]);
      }
      for (std::size_t k = 0; k < dimension; ++k) miss2 += std::pow(n[k] - x[k] - along * v[k], 2);
      const double room = scene.radius * scene.radius - miss2;
      if (n == from || !(room > 0)) continue;
      if (distance2 < scene.radius * scene.radius) return "\"outcome\":\"inside\"," + obstacle(n);
      const double time = along - std::sqrt(room / speed2);
      if (time >= 0 && time < first) first = time, best = n;
    }
    std::size_t axis = 0;
    double leave = INFINITY;
    for (std::size_t k = 0; k < dimension; ++k)
      if (const double t = (cell[k] + (v[k] > 0) - x[k]) / v[k]; v[k] != 0 && t < leave) leave = t, axis = k;
    if (std::min(first, leave) >= limit) return "\"outcome\":\"later\"";
    if (first <= leave) return "\"outcome\":\"hit\"," + obstacle(best) + ",\"time\":" + text_of(first);
    cell[axis] += v[axis] > 0 ? 1 : -1;
  }
  return "\"outcome\":\"undecided\"";
}

int main() {
  Scene scene("");
  for (std::string line; std::getline(std::cin, line);) {
    if (line.find("\"scene\":") != std::string::npos) {
      scene = Scene(line);
      continue;
    }
    const Vec x = numbers(line, "x"), v = numbers(line, "v"), id = numbers(line, "id"),
              limit = numbers(line, "max_time");
    std::string answer = R"("outcome":"error","message":"no such scene here","reason":"unsupported")";
    if (!scene.centre.empty() && x.size() == scene.centre.size() && v.size() == x.size())
      answer = first_hit(scene, x, v, numbers(line, "cell"), limit.empty() ? INFINITY : limit[0]);
    const std::string name = id.empty() ? "null" : text_of(id[0]);
    std::cout << "{\"id\":" + name + ',' + answer + "}\n" << std::flush;  // the caller may wait for it
  }
}
