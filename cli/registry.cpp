#include "registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "collision.hpp"
#include "engine.hpp"
#include "escalate.hpp"
#include "exchange.hpp"
#include "walk.hpp"

namespace lorentz::cli {
namespace {

// Adds the detail to an engine's answer, where binary64 can compute it.
void add_detail(const Query& query, const Scene& scene, Answer& answer) {
  if (answer.outcome != Outcome::hit) return;
  const Detail detail = collision_detail(scene, query, answer);
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
