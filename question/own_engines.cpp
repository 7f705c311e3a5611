// The table of this program's engines. Those of the fast library have their own in
// src/engines/make_engine.cpp.
#include <cmath>

#include <lorentz/certified_batch.hpp>
#include <lorentz/collision.hpp>
#include <lorentz/engine.hpp>
#include <lorentz/geometry.hpp>
#include <lorentz/walk.hpp>
#include "question/engines.hpp"
#include "question/precisions/precisions.hpp"
#include "src/engines/gpu/gpu_batch.hpp"

namespace lorentz::question {

void add_detail(const Query& query, const Scene& scene, Answer& answer) {
  const bool has_obstacle =
      answer.outcome == Outcome::inside || (answer.outcome == Outcome::hit && answer.time);
  if (!has_obstacle || flaw_of(Query{query.x, query.v, answer.obstacle}, scene)) return;
  const Detail detail = collision_detail(scene, query, answer);
  // No detail is added outside the range of binary64. The oracle has it.
  const Vec all = sum(sum(detail.point, detail.exit_point), sum(detail.normal, detail.exit_normal));
  const double exit = exit_time(scene, query, answer);
  if (!std::isfinite(all[0] + all[1] + all[2] + detail.impact_parameter) || !std::isnormal(exit)) return;
  answer.detail = detail;
  if (!answer.exit_time) answer.exit_time = exit;
}

namespace {

// A binary64 engine that answers one query at a time. Detail is added, if it is requested.
SceneEngine of_engine(const Scene& scene, const Traits& traits, std::shared_ptr<const Engine> engine) {
  return {scene, traits, [engine, scene](const Query& query, const oracle::Request& request, Reply& reply) {
            engine->first_hit(query, limit_of(request), reply.answer);
            if (request.detail) add_detail(query, scene, reply.answer);
          }};
}

// `reduction` and `batch`: single flights, and many in lanes.
SceneEngine of_batch(const Scene& scene, const Traits& traits) {
  if (const auto why_not = Reduction::beyond(scene))
    return SceneEngine::unsupported(scene, traits,
                                    (traits.together > 0 ? "batch " : "reduction ") + *why_not);
  const auto batch = std::make_shared<const Batch>(scene);
  return {scene, traits,
          [batch, scene](const Query& query, const oracle::Request& request, Reply& reply) {
            batch->one_at_a_time().first_hit(query, limit_of(request), reply.answer);
            if (request.detail) add_detail(query, scene, reply.answer);
          },
          [batch](const QueryColumns& queries, const FlightColumns& flights, std::vector<std::size_t>& rest,
                  int jobs) {
            rest.clear();
            batch->fly(queries, flights, Batch::Time::close, jobs);
          }};
}

Stage stage_in(const StageTally& tally) {
  return tally.binary64 ? Stage::binary64 : tally.double_double ? Stage::double_double : Stage::undecided;
}

// `certified`, `certified-batch` and `gpu`.
SceneEngine certified(const Scene& scene, const Traits& traits) {
  if (traits.needs_card)
    if (const std::string why = gpu::beyond(prepare(scene)); !why.empty())
      return SceneEngine::unsupported(scene, traits, "gpu " + why);
  const auto batch = traits.needs_card ? std::make_shared<const oracle::CertifiedBatch>(scene, 0)
                                       : std::make_shared<const oracle::CertifiedBatch>(scene);
  return {scene, traits,
          [batch](const Query& query, const oracle::Request& request, Reply& reply) {
            StageTally tally;
            batch->one_at_a_time().first_hit(query, request, reply.answer, &tally);
            reply.stage = stage_in(tally);
          },
          [batch](const QueryColumns& queries, const FlightColumns& flights, std::vector<std::size_t>& rest,
                  int jobs) { batch->first_hits(queries, flights, rest, jobs); }};
}

SceneEngine exact(const Scene& scene, const Traits& traits) {
  const auto truth = std::make_shared<const oracle::Oracle>(scene);
  return {scene, traits, [truth](const Query& query, const oracle::Request& request, Reply& reply) {
            reply.answer = truth->first_hit(query, request);
          }};
}

SceneEngine walking(const Scene& scene, const Traits& traits, std::shared_ptr<const oracle::Walk> walk) {
  return {scene, traits, [walk, scene](const Query& query, const oracle::Request& request, Reply& reply) {
            reply.answer = walk->first_hit(query, limit_of(request));
            if (request.detail) add_detail(query, scene, reply.answer);
          }};
}

SceneEngine walk(const Scene& scene, const Traits& traits) {
  return walking(scene, traits, std::make_shared<const oracle::Walk>(scene));
}

// ---- As campaigns ask: a flight through very many cells takes seconds, in which an engine could answer thousands of
// others.

// Up to a time in which the flight passes about this many cells.
SceneEngine hasty_classical(const Scene& scene, const Traits& traits) {
  constexpr double kCells = 10'000;
  const std::shared_ptr<const Engine> engine = make_engine("classical", scene);
  return {
      scene, traits,
      [engine, u = scene.lattices[0].vectors[0]](const Query& query, const oracle::Request&, Reply& reply) {
        const Vec& v = query.v;
        const double cells = std::hypot(u[0], u[1], u[2]) / std::hypot(v[0], v[1], v[2]);
        engine->first_hit(query, kCells * cells, reply.answer);
      }};
}

SceneEngine hasty_walk(const Scene& scene, const Traits& traits) {
  constexpr std::int64_t kCells = 200;
  return walking(scene, traits, std::make_shared<const oracle::Walk>(scene, kCells));
}

// With the stage of each.
SceneEngine staged_flights(const Scene& scene, const Traits& traits) {
  if (const auto why_not = Reduction::beyond(scene)) return SceneEngine::unsupported(scene, traits, *why_not);
  const auto engine = std::make_shared<const Reduction>(scene);
  return {scene, traits, [engine](const Query& query, const oracle::Request& request, Reply& reply) {
            std::array<WideInteger, 3> cell{};
            const Flight flight = engine->fly(query, limit_of(request), Reduction::Time::close, &cell);
            reply.answer.clear();
            set_answer(flight, cell, reply.answer);
            reply.stage = flight.stage;
          }};
}

SceneEngine batch_checked(const Scene& scene, const Traits& traits) {
  return batch_both_ways(scene, traits);
}

// ---- The table

using Make = std::function<SceneEngine(const Scene&, const Traits&)>;

EngineInfo own(std::string name, const Traits& traits, const Make& make, const Make& in_campaign = {}) {
  EngineInfo engine{std::move(name), traits};
  const auto with_traits = [traits](const Make& its) {
    return [traits, its](const Scene& scene) { return its(scene, traits); };
  };
  engine.in = with_traits(make);
  engine.answerer = [traits, plain = engine.in, campaign = with_traits(in_campaign ? in_campaign : make)](
                        const AnswererOptions& options) {
    return own_answerer(traits, options.in_campaign ? campaign : plain, options);
  };
  return engine;
}

std::vector<EngineInfo> table() {
  const Traits fast{.leaves_undecided = true, .uses_reduction = true, .takes_limits = true};
  const Traits sure{.is_exact = true, .uses_reduction = true, .takes_limits = true};
  const auto in_bulk = [](Traits traits, std::size_t together = 4096) {
    return traits.together = together, traits;
  };
  Traits on_card = in_bulk(sure, 1 << 17);
  on_card.needs_card = true;
  const auto plain = [](const char* name) {
    return [name](const Scene& scene, const Traits& traits) {
      return of_engine(scene, traits, make_engine(name, scene));
    };
  };
  std::vector<EngineInfo> all{
      own("classical", {}, plain("classical"), hasty_classical),
      own("published", {}, plain("published")),
      own("golse", {}, plain("golse")),
      own("reduction", fast, of_batch, staged_flights),
      own("certified", sure, certified),
      own("batch", in_bulk(fast), of_batch, batch_checked),
      own("certified-batch", in_bulk(sure), certified),
      own("gpu", on_card, certified),
      own("oracle", {.is_exact = true, .knows_digits = true, .takes_limits = true}, exact),
      own("walk", {.is_exact = true, .takes_limits = true}, walk, hasty_walk)};
  for (const std::string& name : precision_names())
    all.push_back(own(name, {}, [name](const Scene& scene, const Traits& traits) {
      return of_engine(scene, traits, make_precision(name, scene));
    }));
  return all;
}

}  // namespace

const std::vector<EngineInfo>& own_engines() {
  static const std::vector<EngineInfo> all = table();
  return all;
}

}  // namespace lorentz::question
