#include "question/race.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <deque>
#include <map>

#include "question/examine.hpp"

namespace lorentz::question {
namespace {

using Questions = std::span<const Question>;
using SteadyClock = std::chrono::steady_clock;
constexpr std::size_t kBlock = 16;
constexpr double kEnoughSeconds = 10;  // after this no further rounds, nor blocks of a round

struct Round {
  double total_ns = 0;
  std::size_t asked = 0;
  std::vector<double> block_means;
  std::optional<double> processor_ns = {};

  double ns_per_query() const { return asked ? total_ns / static_cast<double>(asked) : 0; }

  // Calls ask(begin, end), which returns the nanoseconds that it took, for blocks of `count` questions until
  // it is enough.
  template <class Ask>
  void time_blocks(std::size_t count, std::size_t block, const Ask& ask) {
    for (std::size_t begin = 0; begin < count && total_ns < 1e9 * kEnoughSeconds; begin += block) {
      const std::size_t length = std::min(block, count - begin);
      const double ns = ask(begin, begin + length);
      total_ns += ns;
      asked += length;
      block_means.push_back(ns / static_cast<double>(length));
    }
  }
};

double ns_since(SteadyClock::time_point start) {
  return std::chrono::duration<double, std::nano>(SteadyClock::now() - start).count();
}

// Processor time of this thread until now.
double thread_ns() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

// An engine that is asked one query at a time; `engines` has it for each question's scene.
Round run_round(Questions questions, const std::vector<const SceneEngine*>& engines, const std::string& name,
                const Listener& listener) {
  Round round;
  std::vector<Reply> replies(kBlock);
  double spent = 0;
  round.time_blocks(questions.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    spent -= thread_ns();
    const auto start = SteadyClock::now();
    for (std::size_t i = begin; i < end; ++i)
      engines[i]->ask(questions[i].query, {.max_time = questions[i].max_time}, replies[i - begin]);
    const double ns = ns_since(start);
    spent += thread_ns();
    report(listener, name, end, questions.size());
    return ns;
  });
  round.processor_ns = spent;
  return round;
}

// Questions of one place, one behind the other, as columns for a batch engine.
struct ColumnsThere {
  ColumnsThere(const EngineInfo& of, const Place* there) : place(there), engine(of.in(there->scene())) {}

  const Place* place;
  SceneEngine engine;
  QueryTable queries = {};
};

// A query whose `from` does not fit into columns is left out; such queries are rare.
std::deque<ColumnsThere> columns_of(Questions questions, const EngineInfo& engine) {
  std::deque<ColumnsThere> all;
  for (const Question& question : questions) {
    const Place* const place = question.place.get();
    if (all.empty() || all.back().place != place) all.emplace_back(engine, place);
    all.back().queries.push_back(question.query, question.max_time);
  }
  return all;
}

// A batch engine. Timed is the task that it is made for: columns to columns.
Round run_round(const std::deque<ColumnsThere>& all, const std::string& name, const Listener& listener) {
  constexpr std::size_t kTogether = 1024;  // their columns stay in the cache
  Round round;
  FlightTable flights;
  for (const ColumnsThere& there : all)
    round.time_blocks(there.queries.size(), kTogether, [&](std::size_t begin, std::size_t end) {
      const QueryColumns queries = there.queries.columns().part(begin, end - begin);
      const auto start = SteadyClock::now();
      there.engine.fly(queries, flights);
      return ns_since(start);
    });
  report(listener, name, round.asked, round.asked);
  return round;
}

// `place` is that of the question before, and becomes that of the last.
void ask_program(Questions questions, Answerer& program, const Place*& place) {
  for (const Question& question : questions) {
    if (question.place.get() != place) program.set_scene((place = question.place.get())->scene());
    ask(program, question);
  }
  program.drain();
}

// A library, timed by its own calls. It needs few of them for a part.
Round run_round_by_own_time(Questions questions, Answerer& program) {
  constexpr std::size_t kPart = 256;
  Round round;
  const Place* place = nullptr;
  round.time_blocks(questions.size(), kPart, [&](std::size_t begin, std::size_t end) {
    const double before = program.own_time()->seconds;
    ask_program(questions.subspan(begin, end - begin), program, place);
    return 1e9 * (program.own_time()->seconds - before);
  });
  return round;
}

// An external engine, or a function of the caller.
Round run_round(Questions questions, Answerer& program, const std::string& name, const Listener& listener) {
  std::size_t answered = 0;
  program.on_reply([&](Reply&) { report(listener, name, ++answered, questions.size()); });
  const std::optional<double> spent = program.processor_seconds();
  const auto start = SteadyClock::now();
  const Place* place = nullptr;
  ask_program(questions, program, place);
  const double ns = ns_since(start);
  Round round{ns, questions.size(), {ns / static_cast<double>(std::max<std::size_t>(answered, 1))}};
  if (spent) round.processor_ns = 1e9 * (*program.processor_seconds() - *spent);
  return round;
}

// An engine, ready for every place, and its times in each round.
class Entrant {
 public:
  Entrant(Questions questions, const EngineInfo& engine, Answerer* running, const RaceOptions& options)
      : questions_(questions),
        name_(engine.name),
        listener_(options.answerer.listener),
        is_library_(engine.kind == EngineInfo::Kind::library) {
    if (engine.is_own() && engine.traits.together > 0) {
      columns_ = columns_of(questions, engine);
      return;
    }
    if (!engine.is_own()) {
      if (!running) own_ = engine.answerer(options.answerer);
      program_ = running ? running : own_.get();
      return;
    }
    for (const Question& question : questions) {
      auto there = by_place_.find(question.place.get());
      if (there == by_place_.end())
        there = by_place_.emplace(question.place.get(), engine.in(question.place->scene())).first;
      engines_.push_back(&there->second);
    }
  }

  void run() {
    rounds_.push_back(is_library_         ? run_round_by_own_time(questions_, *program_)
                      : program_          ? run_round(questions_, *program_, name_, listener_)
                      : !columns_.empty() ? run_round(columns_, name_, listener_)
                                          : run_round(questions_, engines_, name_, listener_));
  }
  bool failed() const { return program_ && program_->failed(); }

  /// Ends the program, if it was started here, and takes the times from the median round.
  Speed finish() {
    if (own_) own_->finish();
    Speed speed;
    speed.failed = failed();
    if (own_ && own_->own_time()) speed.own_ns = own_->own_time()->ns_per_query();
    if (questions_.empty() || rounds_.empty()) return speed;
    std::ranges::sort(rounds_, {}, &Round::ns_per_query);
    const Round& middle = rounds_[rounds_.size() / 2];
    speed.ns_per_query = middle.ns_per_query();
    if (middle.processor_ns && middle.asked)
      speed.processor_ns = *middle.processor_ns / static_cast<double>(middle.asked);
    speed.ns_median = quantile(middle.block_means, 0.5);
    speed.ns_low = quantile(middle.block_means, 0.25);
    speed.ns_high = quantile(middle.block_means, 0.75);
    return speed;
  }

 private:
  const Questions questions_;
  const std::string name_;
  const Listener& listener_;
  const bool is_library_;
  std::map<const Place*, SceneEngine> by_place_;
  std::vector<const SceneEngine*> engines_;
  std::deque<ColumnsThere> columns_;  // instead of these, for a batch engine
  std::unique_ptr<Answerer> own_;
  Answerer* program_ = nullptr;  // likewise, for an external engine or a function of the caller
  std::vector<Round> rounds_;
};

}  // namespace

std::vector<Speed> race(Questions questions, const std::vector<EngineInfo>& engines,
                        const RaceOptions& options) {
  std::vector<std::unique_ptr<Entrant>> entrants;
  for (std::size_t i = 0; i < engines.size(); ++i) {
    const std::size_t most = options.counts.empty() ? questions.size() : options.counts.at(i);
    Answerer* const running = options.running.empty() ? nullptr : options.running.at(i);
    entrants.push_back(std::make_unique<Entrant>(questions.first(std::min(most, questions.size())),
                                                 engines[i], running, options));
  }
  // In turn, so that a temporary slowdown of the machine affects all of them.
  const auto start = SteadyClock::now();
  for (int round = 0; round < options.rounds && ns_since(start) < 1e9 * kEnoughSeconds; ++round)
    for (const auto& entrant : entrants)
      if (!entrant->failed()) entrant->run();
  std::vector<Speed> speeds;
  for (const auto& entrant : entrants) speeds.push_back(entrant->finish());
  return speeds;
}

}  // namespace lorentz::question
