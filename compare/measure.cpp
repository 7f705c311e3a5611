#include "compare/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "compare/instruction_counter.hpp"

namespace lorentz::compare {

void Tally::count(const oracle::Judgement& judgement) {
  ++queries;
  switch (judgement.verdict) {
    case oracle::Verdict::agree:
      ++agree;
      break;
    case oracle::Verdict::ill_posed:
      ++ill_posed;
      break;
    case oracle::Verdict::wrong:
      ++wrong;
      break;
    case oracle::Verdict::undecided:
      ++undecided;
      break;
    case oracle::Verdict::unsupported:
      ++unsupported;
      break;
    case oracle::Verdict::error:
      ++error;
      break;
    case oracle::Verdict::missing:
      ++missing;
      break;
  }
  if (judgement.wrong_time) {
    ++wrong_time;
    wrong_ulps.push_back(judgement.ulps.value_or(std::numeric_limits<double>::infinity()));
    wrong_conditions.push_back(judgement.departs);
  }
  if (!judgement.ulps) return;
  ++timed_hits;
  ulps.push_back(*judgement.ulps);
  sum_ulp += *judgement.ulps;
  max_ulp = std::max(max_ulp, *judgement.ulps);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::lround(share * last));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

void Tally::add(const Tally& other) {
  for (const auto count :
       {&Tally::queries, &Tally::agree, &Tally::ill_posed, &Tally::wrong, &Tally::undecided,
        &Tally::unsupported, &Tally::error, &Tally::missing, &Tally::wrong_time, &Tally::timed_hits})
    this->*count += other.*count;
  failed |= other.failed;
  max_ulp = std::max(max_ulp, other.max_ulp);
  sum_ulp += other.sum_ulp;
  for (const auto errors : {&Tally::ulps, &Tally::wrong_ulps, &Tally::wrong_conditions})
    (this->*errors).insert((this->*errors).end(), (other.*errors).begin(), (other.*errors).end());
}

double Tally::ulp_at(double share) const {
  return quantile(ulps, share);
}

oracle::Judgement judgement_of_invalid(const Answer& given) {
  using oracle::Verdict;
  if (given.outcome == Outcome::undecided) return {Verdict::undecided};
  if (given.outcome == Outcome::error) return {given.unsupported ? Verdict::unsupported : Verdict::agree};
  return {Verdict::wrong, {}, std::numeric_limits<double>::infinity()};
}

bool departs(const oracle::Judgement& judgement) {
  return judgement.wrong_time || judgement.verdict == oracle::Verdict::wrong ||
         judgement.verdict == oracle::Verdict::ill_posed;
}

namespace {

constexpr const char* kExactAnswers = "exact answers";

// Scene by scene: that of a batch is prepared once.
std::vector<Answer> certified_answers(const CaseSet& set, const Listener& listener) {
  std::vector<std::size_t> order(set.cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return set.cases[a].scene < set.cases[b].scene; });
  std::vector<Answer> answers(order.size());
  std::size_t told = 0;
  const auto certified = engine_named("certified-batch").answerer({});
  certified->on_answer([&](Answer& answer) {
    answers[order[told++]] = std::move(answer);
    report(listener, kExactAnswers, told, answers.size());
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Case& one = set.cases[order[i]];
    if (i == 0 || one.scene != set.cases[order[i - 1]].scene) certified->set_scene(set.scenes[one.scene]);
    certified->ask(one.id, one.query);
  }
  certified->finish();
  return answers;
}

}  // namespace

std::vector<Answer> exact_answers(const CaseSet& set, const Listener& listener, Truth truth) {
  if (truth == Truth::certified) return certified_answers(set, listener);
  std::vector<oracle::Oracle> oracles;
  for (const Scene& scene : set.scenes) oracles.emplace_back(scene);
  std::vector<Answer> answers;
  answers.reserve(set.cases.size());
  for (const Case& one : set.cases) {
    answers.push_back(oracles[one.scene].first_hit(one.query));
    report(listener, kExactAnswers, answers.size(), set.cases.size());
  }
  return answers;
}

namespace {

using SteadyClock = std::chrono::steady_clock;
constexpr std::size_t kBlock = 16;
constexpr double kEnoughSeconds = 10;  // no further rounds after that

struct Round {
  double total_ns = 0;
  std::vector<double> block_means;
  std::optional<std::uint64_t> instructions = {};
};

// One answerer over the first `count` cases; `look` sees each answer, outside the timed stretches.
template <class Look>
Round run_round(const CaseSet& set, std::size_t count, const std::string& name,
                const std::vector<FirstHit>& first_hit, const Listener& listener, Look look) {
  Round round;
  std::vector<Answer> answers(kBlock);
  const oracle::Request request;
  InstructionCounter instructions;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, count);
    instructions.resume();
    const auto start = SteadyClock::now();
    for (std::size_t i = begin; i < end; ++i)
      first_hit[set.cases[i].scene](set.cases[i].query, request, answers[i - begin]);
    const double ns = std::chrono::duration<double, std::nano>(SteadyClock::now() - start).count();
    instructions.pause();
    round.total_ns += ns;
    round.block_means.push_back(ns / static_cast<double>(end - begin));
    for (std::size_t i = begin; i < end; ++i) look(i, &answers[i - begin]);
    report(listener, name, end, count);
  }
  round.instructions = instructions.count();
  return round;
}

// The same of who has many queries at a time: another program, a batch engine. Queries that it was not asked,
// for it was given up, have no answer.
template <class Look>
Round run_round(const CaseSet& set, std::size_t count, const std::string& name, Answerer& program,
                const Listener& listener, Look look) {
  std::vector<std::optional<Answer>> answers;
  answers.reserve(count);
  program.on_answer([&](Answer& answer) {
    answers.emplace_back(std::move(answer));
    if (program.origin() == Answerer::Origin::not_asked) answers.back().reset();
    report(listener, name, answers.size(), count);
  });
  const auto start = SteadyClock::now();
  for (std::size_t i = 0; i < count; ++i) {
    const Case& one = set.cases[i];
    if (i == 0 || one.scene != set.cases[i - 1].scene) program.set_scene(set.scenes[one.scene]);
    program.ask(one.id, one.query);
  }
  program.drain();
  const double ns = std::chrono::duration<double, std::nano>(SteadyClock::now() - start).count();
  for (std::size_t i = 0; i < answers.size(); ++i) look(i, answers[i] ? &*answers[i] : nullptr);
  return {ns, {ns / static_cast<double>(std::max<std::size_t>(answers.size(), 1))}};
}

// One of the names, ready for every scene of the set, and what it did in each round.
struct Entrant {
  Tally tally;
  std::size_t count;                  // of the cases, from the first
  std::vector<FirstHit> first_hit;    // by scene
  std::unique_ptr<Answerer> program;  // or this, of who answers in bulk
  std::vector<Round> rounds;

  Entrant(const CaseSet& set, const EngineInfo& engine, std::size_t most, const MeasureOptions& options)
      : count(std::min(most, set.cases.size())) {
    tally.name = engine.name;
    if (!engine.is_own() || engine.traits.in_bulk)
      program = engine.answerer(
          {{}, options.timeout, options.listener, options.strict, 1, options.start_timeout, options.enough});
    else
      for (const Scene& scene : set.scenes) first_hit.push_back(engine.first_hit(scene));
  }

  template <class Look>
  void run(const CaseSet& set, const Listener& listener, Look look) {
    rounds.push_back(program ? run_round(set, count, tally.name, *program, listener, look)
                             : run_round(set, count, tally.name, first_hit, listener, look));
  }

  bool failed() const { return program && program->failed(); }

  // Ends the program, and takes the times from the median round.
  void finish() {
    if (program) program->finish();
    tally.failed = failed();
    if (count == 0 || rounds.empty()) return;
    std::sort(rounds.begin(), rounds.end(),
              [](const Round& a, const Round& b) { return a.total_ns < b.total_ns; });
    const Round& middle = rounds[rounds.size() / 2];
    tally.ns_per_query = middle.total_ns / static_cast<double>(count);
    if (middle.instructions)
      tally.instructions = static_cast<double>(*middle.instructions) / static_cast<double>(count);
    tally.ns_median = quantile(middle.block_means, 0.5);
    tally.ns_low = quantile(middle.block_means, 0.25);
    tally.ns_high = quantile(middle.block_means, 0.75);
  }
};

// The answers of a set, each held against the exact one.
class Examination {
 public:
  Examination(const CaseSet& set, const std::vector<Answer>& exact, const OnWrong& on_wrong,
              const MeasureOptions& options)
      : set_(set), exact_(exact), on_wrong_(on_wrong), on_judged_(options.on_judged), ulps_(options.ulps) {
    for (const Scene& scene : set.scenes) judges_.emplace_back(scene);
  }

  // No answer: it is missing.
  void judge(std::size_t name, std::size_t i, const Answer* given, Tally& tally) const {
    if (exact_.empty()) {
      ++tally.queries;
      return;
    }
    const Case& one = set_.cases[i];
    const oracle::Judgement judgement =
        given ? judges_[one.scene].judge(one.query, exact_[i], *given, ulps_) : oracle::Judgement{};
    tally.count(judgement);
    if (on_judged_) on_judged_(name, i, judgement);
    if (on_wrong_ && departs(judgement)) on_wrong_(one, exact_[i], tally.name, *given, judgement);
  }

 private:
  const CaseSet& set_;
  const std::vector<Answer>& exact_;
  const OnWrong& on_wrong_;
  const OnJudged& on_judged_;
  const double ulps_;
  std::vector<oracle::Judge> judges_;
};

// In turn, so that what slows the machine down for a while slows all of them. Answers are judged once.
void run_rounds(const CaseSet& set, std::vector<Entrant>& entrants, const Examination& examination,
                const MeasureOptions& options) {
  const auto start = SteadyClock::now();
  for (int r = 0; r < options.rounds; ++r) {
    for (std::size_t name = 0; name < entrants.size(); ++name)
      if (Entrant& entrant = entrants[name]; !entrant.failed())
        entrant.run(set, options.listener, [&](std::size_t i, const Answer* given) {
          if (r == 0) examination.judge(name, i, given, entrant.tally);
        });
    if (std::chrono::duration<double>(SteadyClock::now() - start).count() > kEnoughSeconds) break;
  }
}

}  // namespace

std::vector<Tally> measure(const CaseSet& set, const std::vector<Answer>& exact,
                           const std::vector<EngineInfo>& engines, const OnWrong& on_wrong,
                           const MeasureOptions& options) {
  std::vector<Entrant> entrants;
  for (std::size_t i = 0; i < engines.size(); ++i)
    entrants.emplace_back(set, engines[i], options.counts.empty() ? set.cases.size() : options.counts.at(i),
                          options);
  run_rounds(set, entrants, Examination(set, exact, on_wrong, options), options);
  std::vector<Tally> tallies;
  for (Entrant& entrant : entrants) {
    entrant.finish();
    tallies.push_back(std::move(entrant.tally));
  }
  return tallies;
}

}  // namespace lorentz::compare
