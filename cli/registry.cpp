#include "registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine.hpp"
#include "exchange.hpp"
#include "walk.hpp"

namespace lorentz::cli {
namespace {

// Collision point, normal and impact parameter of a hit, as a binary64 engine would compute them.
Detail detail_of(const Answer& answer, const Query& query, const Scene& scene) {
  const Lattice& lattice = scene.lattices[answer.obstacle.lattice];
  const Atom& atom = lattice.atoms[answer.obstacle.atom];
  Detail detail;
  double across2 = 0;
  Vec centre = atom.position, arm{};
  for (int i = 0; i < scene.dimension; ++i)
    for (int k = 0; k < scene.dimension; ++k)
      centre[k] += std::stod(answer.obstacle.cell[i].decimal()) * lattice.vectors[i][k];
  double along = 0, v2 = 0;
  for (int k = 0; k < 3; ++k) {
    detail.point[k] = query.x[k] + *answer.time * query.v[k];
    detail.normal[k] = (detail.point[k] - centre[k]) / atom.radius;
    arm[k] = centre[k] - query.x[k];
    along += arm[k] * query.v[k];
    v2 += query.v[k] * query.v[k];
  }
  for (int k = 0; k < 3; ++k) across2 += std::pow(arm[k] - along / v2 * query.v[k], 2);
  detail.impact_parameter = std::sqrt(across2);
  return detail;
}

Answer with_request(Answer answer, const Query& query, const Scene& scene, const oracle::Request& request) {
  const bool nothing_before = answer.outcome == Outcome::never ||
                              (answer.time && request.max_time && !(*answer.time < *request.max_time));
  if (request.max_time && nothing_before) {
    answer = Answer{};
    answer.outcome = Outcome::later;
  }
  if (request.detail && answer.outcome == Outcome::hit) answer.detail = detail_of(answer, query, scene);
  return answer;
}

}  // namespace

std::vector<std::string> answerer_names() {
  std::vector<std::string> names = engine_names();
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
    return [truth](const Query& query, const oracle::Request& request) {
      return truth->first_hit(query, request);
    };
  }
  if (name == "walk") {
    auto walk = std::make_shared<oracle::Walk>(scene);
    return [walk, scene](const Query& query, const oracle::Request& request) {
      return with_request(walk->first_hit(query), query, scene, request);
    };
  }
  std::shared_ptr<Engine> engine = make_engine(name, scene);
  return [engine, scene](const Query& query, const oracle::Request& request) {
    const double max_time = request.max_time.value_or(std::numeric_limits<double>::infinity());
    Answer answer = engine->first_hit(query, max_time);
    if (request.detail && answer.outcome == Outcome::hit) answer.detail = detail_of(answer, query, scene);
    return answer;
  };
}

}  // namespace lorentz::cli
