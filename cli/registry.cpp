#include "registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

#include "engine.hpp"
#include "escalate.hpp"
#include "exchange.hpp"
#include "walk.hpp"

namespace lorentz::cli {
namespace {

// Collision point, normal and impact parameter of a hit, in binary64.
Detail detail_of(const Answer& answer, const Query& query, const Scene& scene) {
  const Lattice& lattice = scene.lattices[answer.obstacle.lattice];
  const Atom& atom = lattice.atoms[answer.obstacle.atom];
  Vec centre = atom.position;
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < scene.dimension; ++k)
      centre[k] += std::strtod(answer.obstacle.cell[i].decimal().c_str(), nullptr) * lattice.vectors[i][k];
  Detail detail;
  const double speed = std::hypot(query.v[0], query.v[1], query.v[2]);
  double along = 0;
  Vec arm{};
  for (int k = 0; k < 3; ++k) {
    detail.point[k] = query.x[k] + *answer.time * query.v[k];
    arm[k] = detail.point[k] - centre[k];
    along += arm[k] * (query.v[k] / speed);
  }
  const double length = std::hypot(arm[0], arm[1], arm[2]);
  Vec across{};
  for (int k = 0; k < 3; ++k) {
    detail.normal[k] = arm[k] / length;
    across[k] = arm[k] - along * (query.v[k] / speed);
  }
  detail.impact_parameter = std::hypot(across[0], across[1], across[2]);
  return detail;
}

// Adds the detail to an engine's answer, where binary64 can compute it.
void add_detail(const Query& query, const Scene& scene, Answer& answer) {
  if (answer.outcome != Outcome::hit) return;
  const Detail detail = detail_of(answer, query, scene);
  // Beyond the range of binary64 there is none; the oracle has it.
  if (std::isfinite(detail.point[0] + detail.point[1] + detail.point[2] + detail.impact_parameter))
    answer.detail = detail;
}

double limit_of(const oracle::Request& request) {
  return request.max_time.value_or(std::numeric_limits<double>::infinity());
}

}  // namespace

std::vector<std::string> answerer_names() {
  std::vector<std::string> names = engine_names();
  names.push_back("certified");
  names.push_back("oracle");
  names.push_back("walk");
  return names;
}

void check_name(const std::string& name) {
  const auto names = answerer_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(
        fmt::format("no engine is called {}; there are {}", json_quoted(name), fmt::join(names, ", ")));
}

FirstHit make_first_hit(const std::string& name, const Scene& scene) {
  check_name(name);
  if (name == "oracle") {
    auto truth = std::make_shared<oracle::Oracle>(scene);
    return [truth](const Query& query, const oracle::Request& request, Answer& answer) {
      answer = truth->first_hit(query, request);
    };
  }
  if (name == "certified") {
    auto certified = std::make_shared<oracle::Certified>(scene);
    return [certified](const Query& query, const oracle::Request& request, Answer& answer) {
      certified->first_hit(query, request, answer);
    };
  }
  if (name == "walk") {
    auto walk = std::make_shared<oracle::Walk>(scene);
    return [walk, scene](const Query& query, const oracle::Request& request, Answer& answer) {
      answer = limited(walk->first_hit(query), limit_of(request));
      if (request.detail) add_detail(query, scene, answer);
    };
  }
  std::shared_ptr<Engine> engine = make_engine(name, scene);
  return [engine, scene](const Query& query, const oracle::Request& request, Answer& answer) {
    engine->first_hit(query, limit_of(request), answer);
    if (request.detail) add_detail(query, scene, answer);
  };
}

}  // namespace lorentz::cli
