#include "compare/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>

#include <lorentz/certified.hpp>
#include <lorentz/collision.hpp>
#include <lorentz/engine.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/walk.hpp>
#include "compare/batch_answerer.hpp"
#include "compare/command_engine.hpp"
#include "compare/nearest_name.hpp"
#include "compare/precisions/precisions.hpp"

namespace lorentz::compare {

void add_detail(const Query& query, const Scene& scene, Answer& answer) {
  if (answer.outcome != Outcome::hit || !answer.time) return;
  if (flaw_of(Query{query.x, query.v, answer.obstacle}, scene)) return;
  const Detail detail = collision_detail(scene, query, answer);
  // Beyond the range of binary64 there is none; the oracle has it.
  if (std::isfinite(detail.point[0] + detail.point[1] + detail.point[2] + detail.impact_parameter))
    answer.detail = detail;
}

namespace {

constexpr std::string_view kCommand = "cmd:";

double limit_of(const oracle::Request& request) {
  return request.max_time.value_or(std::numeric_limits<double>::infinity());
}

FirstHit first_hits_of(std::shared_ptr<const Engine> engine, const Scene& scene) {
  return [engine, scene](const Query& query, const oracle::Request& request, Answer& answer) {
    engine->first_hit(query, limit_of(request), answer);
    if (request.detail) add_detail(query, scene, answer);
  };
}

FirstHit ask_engine(std::string_view name, const Scene& scene) {
  return first_hits_of(make_engine(name, scene), scene);
}

FirstHit ask_precision(std::string_view name, const Scene& scene) {
  return first_hits_of(make_precision(name, scene), scene);
}

FirstHit ask_single_flights(std::string_view, const Scene& scene) {
  return ask_engine("reduction", scene);
}

FirstHit ask_certified(std::string_view, const Scene& scene) {
  auto certified = std::make_shared<oracle::Certified>(scene);
  return [certified](const Query& query, const oracle::Request& request, Answer& answer) {
    certified->first_hit(query, request, answer);
  };
}

FirstHit ask_oracle(std::string_view, const Scene& scene) {
  auto truth = std::make_shared<oracle::Oracle>(scene);
  return [truth](const Query& query, const oracle::Request& request, Answer& answer) {
    answer = truth->first_hit(query, request);
  };
}

FirstHit ask_walk(std::string_view, const Scene& scene) {
  auto walk = std::make_shared<oracle::Walk>(scene);
  return [walk, scene](const Query& query, const oracle::Request& request, Answer& answer) {
    answer = walk->first_hit(query, limit_of(request));
    if (request.detail) add_detail(query, scene, answer);
  };
}

// All that this program answers with itself: name, what it is like, how it is asked in a scene.
struct Entry {
  std::string_view name;
  Traits traits;
  FirstHit (*ask)(std::string_view name, const Scene& scene);
};

constexpr Entry kAnswerers[] = {
    {"classical", {}, ask_engine},
    {"published", {}, ask_engine},
    {"reduction", {.leaves_undecided = true, .uses_reduction = true}, ask_engine},
    {"certified", {.is_exact = true, .uses_reduction = true}, ask_certified},
    {"batch", {.leaves_undecided = true, .uses_reduction = true, .in_bulk = true}, ask_single_flights},
    {"certified-batch", {.is_exact = true, .uses_reduction = true, .in_bulk = true}, ask_certified},
    {"oracle", {.is_exact = true, .knows_digits = true}, ask_oracle},
    {"walk", {.is_exact = true}, ask_walk},
    {"published-float", {}, ask_precision},
    {"published-dd", {}, ask_precision},
    {"published-128", {}, ask_precision},
    {"published-256", {}, ask_precision},
};

// The caller's own engines.
std::mutex guests_mutex;
std::map<std::string, MakeAnswerer>& guests() {
  static std::map<std::string, MakeAnswerer> all;
  return all;
}

MakeAnswerer guest_named(const std::string& name) {
  const std::lock_guard lock(guests_mutex);
  const auto guest = guests().find(name);
  return guest == guests().end() ? MakeAnswerer{} : guest->second;
}

const Entry* entry_of(std::string_view name) {
  for (const Entry& entry : kAnswerers)
    if (entry.name == name) return &entry;
  return nullptr;
}

}  // namespace

GuestEngine::GuestEngine(std::string name, MakeAnswerer make) : name_(std::move(name)) {
  const std::lock_guard lock(guests_mutex);
  if (is_command(name_) || entry_of(name_) || !guests().emplace(name_, std::move(make)).second)
    throw InputError("an engine called " + json_quoted(name_) + " is there already");
}

GuestEngine::~GuestEngine() {
  const std::lock_guard lock(guests_mutex);
  guests().erase(name_);
}

bool is_guest(const std::string& name) {
  return static_cast<bool>(guest_named(name));
}

Traits traits_of(std::string_view name) {
  const Entry* entry = entry_of(name);
  if (entry) return entry->traits;
  return {.in_bulk = is_guest(std::string(name))};
}

std::vector<std::string> answerer_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kAnswerers) names.emplace_back(entry.name);
  return names;
}

std::string names_for_help() {
  return fmt::format("{}, cmd:COMMAND (another program, docs/command_engines.md)",
                     fmt::join(answerer_names(), ", "));
}

bool is_command(const std::string& name) {
  return name.starts_with(kCommand);
}

void check_name(const std::string& name) {
  if (is_command(name)) {
    if (name.find_first_not_of(" \t\n", kCommand.size()) == std::string::npos)
      throw InputError("cmd: is no engine yet; it is followed by the command that runs one");
    return;
  }
  if (entry_of(name) || is_guest(name)) return;
  const std::vector<std::string> names = answerer_names();
  throw InputError(fmt::format("no engine is called {}{}; there are {}, and cmd:COMMAND for another program",
                               json_quoted(name), did_you_mean(name, names), fmt::join(names, ", ")));
}

std::vector<std::string> names_in(const std::vector<std::string>& arguments) {
  std::vector<std::string> names;
  for (const std::string& argument : arguments)
    for (std::size_t begin = 0; begin <= argument.size();) {
      const bool whole = argument.compare(begin, kCommand.size(), kCommand) == 0;
      const std::size_t end = whole ? argument.size() : std::min(argument.find(',', begin), argument.size());
      names.push_back(argument.substr(begin, end - begin));
      begin = end + 1;
    }
  return names;
}

FirstHit make_first_hit(const std::string& name, const Scene& scene) {
  check_name(name);
  if (is_command(name) || is_guest(name)) throw std::logic_error(name + ": answers in bulk only");
  return entry_of(name)->ask(name, scene);
}

namespace {

// An engine of this program.
class EngineAnswerer final : public Answerer {
 public:
  EngineAnswerer(std::string name, const oracle::Request& request)
      : name_(std::move(name)), request_(request) {}
  void set_scene(const Scene& scene) override { first_hit_ = make_first_hit(name_, scene); }
  void ask(const Id&, const Query& query) override {
    first_hit_(query, request_, answer_);
    deliver(answer_);
  }

 private:
  std::string name_;
  oracle::Request request_;
  FirstHit first_hit_;
  Answer answer_;
};

}  // namespace

std::unique_ptr<Answerer> make_answerer(const std::string& name, const AnswererOptions& options) {
  check_name(name);
  if (is_command(name)) return std::make_unique<CommandEngine>(name.substr(kCommand.size()), options);
  if (const MakeAnswerer make = guest_named(name)) return make(options);
  if (traits_of(name).in_bulk) return std::make_unique<BatchAnswerer>(traits_of(name).is_exact, options);
  return std::make_unique<EngineAnswerer>(name, options.request);
}

}  // namespace lorentz::compare
