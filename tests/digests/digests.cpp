#include "tests/digests/digests.hpp"

#include <bit>
#include <cmath>
#include <functional>

#include <lorentz/batch.hpp>
#include <lorentz/collision.hpp>
#include <lorentz/trajectory_batch.hpp>
#include "question/starts/candidates.hpp"
#include "tests/digests/drawn_queries.hpp"
#include "tests/digests/scenes.hpp"

namespace lorentz::digests {
namespace {

constexpr double kLimit = 200;  // time limit for engines that go from cell to cell

// A hash of numbers in their order, of 64 bits, which shows whether two computers computed the same ones. If
// a stream is given, the hash also writes the numbers to it, one per line, so that the numbers of two
// computers can be compared one by one.
class Hash {
 public:
  explicit Hash(std::ostream* trace = nullptr) : trace_(trace) {}

  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15;
    value_ ^= value_ >> 32;
    if (trace_) *trace_ << std::hex << word << '\n';
  }
  void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(int number) { add(static_cast<std::int64_t>(number)); }

  // All NaNs count as the same, because processors give them different bits.
  void add(double number) {
    add(std::isnan(number) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(number));
  }
  void add(const Vec& vector) {
    for (const double component : vector) add(component);
  }

  std::uint64_t value() const { return value_; }

 private:
  std::ostream* trace_;
  std::uint64_t value_ = 0;
};

void add(Hash& hash, const Flight& flight) {
  hash.add(static_cast<int>(flight.outcome));
  hash.add(static_cast<int>(flight.stage));
  hash.add(static_cast<int>(flight.time_is_rounded));
  hash.add(flight.lattice);
  hash.add(flight.atom);
  for (const std::int64_t n : flight.cell) hash.add(n);
  hash.add(flight.time);
}

void add(Hash& hash, const Answer& answer) {
  hash.add(static_cast<int>(answer.outcome));
  hash.add(answer.obstacle.lattice);
  hash.add(answer.obstacle.atom);
  for (const Integer& n : answer.obstacle.cell) hash.add(n.int64());
  hash.add(answer.time.value_or(0));
}

void fly_alone(const QueryFamily& family, Reduction::Processor processor, std::uint64_t flights, Hash& hash) {
  const Reduction engine(family.scene, processor);
  for (std::uint64_t i = 0; i < flights; ++i)
    add(hash, engine.fly(family.query(i), std::numeric_limits<double>::infinity(),
                         i % 2 == 0 ? Reduction::Time::close : Reduction::Time::rounded));
}

void fly_together(const QueryFamily& family, std::uint64_t flights, Hash& hash) {
  const Batch engine(family.scene);
  QueryTable queries;
  FlightTable close, rounded;
  for (std::uint64_t i = 0; i < flights; ++i) queries.push_back(family.query(i));
  close.resize(flights), rounded.resize(flights);
  engine.fly(queries.columns(), close.columns(), Batch::Time::close);
  engine.fly(queries.columns(), rounded.columns(), Batch::Time::rounded);
  for (std::uint64_t i = 0; i < flights; ++i) add(hash, i % 2 == 0 ? close[i] : rounded[i]);
}

void fly_by(const std::string& name, const QueryFamily& family, std::uint64_t flights, Hash& hash) {
  const std::unique_ptr<Engine> engine = make_engine(name, family.scene);
  for (std::uint64_t i = 0; i < flights; ++i) {
    const Query query = family.query(i);
    const Answer answer = engine->first_hit(query, kLimit);
    add(hash, answer);
    if (answer.outcome != Outcome::hit) continue;
    const Detail detail = collision_detail(family.scene, query, answer);
    hash.add(detail.point);
    hash.add(detail.normal);
    hash.add(detail.impact_parameter);
  }
}

void draw_starts(const Scene& scene, std::uint64_t flights, Hash& hash) {
  for (const flights::Ensemble ensemble : {flights::Ensemble::uniform, flights::Ensemble::surface}) {
    const starts::Candidates starts(scene, ensemble, kSeed);
    Query start;
    for (std::uint64_t i = 0; i < flights; ++i) {
      starts.draw(i, 0, start);
      hash.add(start.x);
      hash.add(start.v);
      if (!start.from) continue;
      hash.add(start.from->lattice);
      hash.add(start.from->atom);
      for (const Integer& n : start.from->cell) hash.add(n.int64());
    }
  }
}

void follow_paths(const Scene& scene, Precision precision, std::uint64_t flights, Hash& hash) {
  constexpr std::uint64_t kParticles = 64;
  const starts::Candidates starts(scene, flights::Ensemble::surface, kSeed);
  const Batch engine(scene);
  Particles particles(engine, scene, precision);
  Query start;
  for (std::uint64_t i = 0; i < kParticles; ++i) {
    starts.draw(i, 0, start);
    particles.add(start);
  }
  const auto add_collision = [&hash](std::size_t, const Particle& particle, const Collision& collision) {
    for (const Vec& vector :
         {particle.offset, particle.offset_low, particle.velocity, particle.velocity_low, collision.normal})
      hash.add(vector);
    for (const double number : {particle.time, particle.time_low, collision.flight, collision.cosine})
      hash.add(number);
    return true;
  };
  for (std::uint64_t done = 0; done < flights; done += kParticles)
    particles.advance(std::numeric_limits<double>::infinity(), add_collision);
}

/// How a digest is made, and its name.
struct Recipe {
  std::string name;
  std::function<void(std::uint64_t flights, Hash&)> make;
};

void add_engines(const QueryFamily& family, std::vector<Recipe>& recipes) {
  const std::string name = std::string(family.name) + ' ';
  using Processor = Reduction::Processor;
  for (const auto& [engine, processor] :
       {std::pair{"reduction", Processor::this_one}, {"reduction-without-fma", Processor::without_fma}})
    recipes.push_back({name + engine, [&family, processor = processor](std::uint64_t flights, Hash& hash) {
                         fly_alone(family, processor, flights, hash);
                       }});
  recipes.push_back({name + "batch",
                     [&family](std::uint64_t flights, Hash& hash) { fly_together(family, flights, hash); }});
  for (const std::string engine : {"classical", "published"}) {
    if (engine == "published" && !family.for_published) continue;
    recipes.push_back({name + engine, [&family, engine](std::uint64_t flights, Hash& hash) {
                         fly_by(engine, family, flights, hash);
                       }});
  }
}

void add_scene(const std::string& name, const Scene& scene, std::vector<Recipe>& recipes) {
  recipes.push_back(
      {"starts " + name, [scene](std::uint64_t flights, Hash& hash) { draw_starts(scene, flights, hash); }});
  for (const auto& [precision, numbers] :
       {std::pair{Precision::binary64, " binary64"}, {Precision::double_double, " double-double"}})
    recipes.push_back(
        {"paths " + name + numbers, [scene, precision = precision](std::uint64_t flights, Hash& hash) {
           follow_paths(scene, precision, flights, hash);
         }});
}

std::vector<Recipe> all_recipes() {
  std::vector<Recipe> recipes;
  for (const QueryFamily& family : query_families()) add_engines(family, recipes);
  add_scene("discs", square(0.3), recipes);
  add_scene("ellipses", leaning_ellipses(), recipes);
  add_scene("superposition", superposition(), recipes);
  add_scene("spheres", unit_scene(3, 0.3), recipes);
  add_scene("ellipsoids", leaning_ellipsoids(), recipes);
  return recipes;
}

}  // namespace

std::vector<Digest> digests(std::uint64_t flights, std::string_view only, std::ostream* trace) {
  std::vector<Digest> made;
  for (const Recipe& recipe : all_recipes()) {
    if (!recipe.name.starts_with(only)) continue;
    Hash hash(trace);
    recipe.make(flights, hash);
    made.push_back({recipe.name, hash.value()});
  }
  return made;
}

}  // namespace lorentz::digests
