// Google Benchmark of the figures in docs/results.md: engines by radius, lattices, hard directions, and the
// bare continued fraction for comparison. Times only; build/lorentz bench compares times and errors.
#include <benchmark/benchmark.h>

#include <cmath>

#include <lorentz/certified.hpp>
#include <lorentz/reduction.hpp>
#include "question/starts/free_starts.hpp"
#include "tests/bench/bare_continued_fraction.hpp"

using namespace lorentz;

namespace {

constexpr std::size_t kQueries = 4096;

Scene with_vectors(int dimension, double r, std::array<Vec, 3> vectors) {
  Scene scene = unit_scene(dimension, r);
  scene.lattices[0].vectors = vectors;
  return scene;
}

const double kHalfRoot3 = std::sqrt(3) / 2;

Scene hexagonal(double r) {
  return with_vectors(2, r, {Vec{1, 0, 0}, Vec{0.5, kHalfRoot3, 0}, Vec{}});
}
Scene fcc(double r) {
  return with_vectors(3, r, {Vec{0, 0.5, 0.5}, Vec{0.5, 0, 0.5}, Vec{0.5, 0.5, 0}});
}
Scene triclinic(double r) {
  return with_vectors(3, r, {Vec{1, 0, 0}, Vec{0.31, 1.07, 0}, Vec{-0.22, 0.41, 0.93}});
}

void fly(benchmark::State& state, const Scene& scene, const std::vector<Query>& queries) {
  const Reduction engine(scene);
  std::size_t i = 0;
  StageTally tally;
  for (auto _ : state) {
    const Flight flight = engine.fly(queries[i]);
    tally.count(flight.stage);
    benchmark::DoNotOptimize(flight.time);
    i = (i + 1) % queries.size();
  }
  state.counters["undecided"] =
      static_cast<double>(tally.undecided) / static_cast<double>(state.iterations());
  state.counters["double_double"] =
      static_cast<double>(tally.double_double) / static_cast<double>(state.iterations());
}

std::vector<Query> drawn(const Scene& scene) {
  return starts::free_starts(scene, starts::Kind::uniform, starts::kDefaultSeed, kQueries);
}

void reduction(benchmark::State& state, const Scene& scene) {
  fly(state, scene, drawn(scene));
}

void engine(benchmark::State& state, const char* name, const Scene& scene, std::size_t count) {
  const auto queries = starts::free_starts(scene, starts::Kind::uniform, starts::kDefaultSeed, count);
  const auto engine = make_engine(name, scene);
  Answer answer;
  std::size_t i = 0;
  for (auto _ : state) {
    engine->first_hit(queries[i], INFINITY, answer);
    benchmark::DoNotOptimize(answer);
    i = (i + 1) % queries.size();
  }
}

void certified(benchmark::State& state, const Scene& scene) {
  const auto queries = drawn(scene);
  const oracle::Certified certified(scene);
  Answer answer;
  std::size_t i = 0;
  for (auto _ : state) {
    certified.first_hit(queries[i], {}, answer);
    benchmark::DoNotOptimize(answer);
    i = (i + 1) % queries.size();
  }
}

void bare(benchmark::State& state, double r) {
  const auto queries = drawn(unit_scene(2, r));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(lorentz::bare_continued_fraction(queries[i].v, r));
    i = (i + 1) % queries.size();
  }
}

void channel(benchmark::State& state, const Scene& scene, Query query) {
  query.v[scene.dimension - 1] = std::ldexp(1, -static_cast<int>(state.range(0)));
  fly(state, scene, {query});
}

void near_rational(benchmark::State& state, const Scene& scene) {
  fly(state, scene, starts::free_starts(scene, starts::Kind::near_rational, starts::kDefaultSeed, kQueries));
}

}  // namespace

int main(int argc, char** argv) {
  const auto name = [](const char* what, double r) { return std::string(what) + "/r=" + std::to_string(r); };
  for (const double r : {0.4999, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    benchmark::RegisterBenchmark(name("square/reduction", r).c_str(), reduction, unit_scene(2, r));
    benchmark::RegisterBenchmark(name("square/certified", r).c_str(), certified, unit_scene(2, r));
    benchmark::RegisterBenchmark(name("square/bare_continued_fraction", r).c_str(), bare, r);
    benchmark::RegisterBenchmark(name("cubic/reduction", r).c_str(), reduction, unit_scene(3, r));
    benchmark::RegisterBenchmark(name("cubic/certified", r).c_str(), certified, unit_scene(3, r));
  }
  benchmark::RegisterBenchmark("square/published/r=1e-6", engine, "published", unit_scene(2, 1e-6), kQueries);
  benchmark::RegisterBenchmark("cubic/published/r=1e-3", engine, "published", unit_scene(3, 1e-3), 500);
  benchmark::RegisterBenchmark("square/classical/r=0.1", engine, "classical", unit_scene(2, 0.1), kQueries);
  benchmark::RegisterBenchmark("cubic/classical/r=0.1", engine, "classical", unit_scene(3, 0.1), kQueries);
  for (const double r : {0.1, 1e-3, 1e-6}) {
    benchmark::RegisterBenchmark(name("hexagonal/reduction", r).c_str(), reduction, hexagonal(r));
    benchmark::RegisterBenchmark(name("fcc/reduction", r).c_str(), reduction, fcc(r));
    benchmark::RegisterBenchmark(name("triclinic/reduction", r).c_str(), reduction, triclinic(r));
  }
  benchmark::RegisterBenchmark("square/corridor_2^-k", channel, unit_scene(2, 0.1),
                               Query{{0, 0.5, 0}, {1, 0, 0}, {}})
      ->DenseRange(10, 50, 10);
  benchmark::RegisterBenchmark("cubic/channel_2^-k", channel, unit_scene(3, 0.1),
                               Query{{0, 0, 0.5}, {1, 0.618, 0}, {}})
      ->DenseRange(10, 60, 5);
  benchmark::RegisterBenchmark("cubic/channel_0.53_2^-k", channel, unit_scene(3, 0.1),
                               Query{{0.5, 0.5, 0.5}, {0.53, 0.618, 0}, {}})
      ->DenseRange(10, 60, 5);
  benchmark::RegisterBenchmark("square/near_rational/r=0.1", near_rational, unit_scene(2, 0.1));
  benchmark::RegisterBenchmark("cubic/near_rational/r=0.1", near_rational, unit_scene(3, 0.1));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
