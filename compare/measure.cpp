#include "compare/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

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
      wrong_time += judgement.wrong_time;
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
  if (!judgement.ulps) return;
  ++timed_hits;
  ulps.push_back(*judgement.ulps);
  sum_ulp += *judgement.ulps;
  max_ulp = std::max(max_ulp, *judgement.ulps);
}

namespace {

// The value that this share of the values does not exceed; 0 of none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::lround(share * last));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

double Tally::ulp_at(double share) const {
  return quantile(ulps, share);
}

std::vector<Answer> exact_answers(const CaseSet& set, const Listener& listener) {
  std::vector<oracle::Oracle> oracles;
  for (const Scene& scene : set.scenes) oracles.emplace_back(scene);
  std::vector<Answer> answers;
  answers.reserve(set.cases.size());
  for (const Case& one : set.cases) {
    answers.push_back(oracles[one.scene].first_hit(one.query));
    report(listener, "exact answers", answers.size(), set.cases.size());
  }
  return answers;
}

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kBlock = 16;
constexpr double kEnoughSeconds = 10;  // no further rounds after that

struct Round {
  double total_ns = 0;
  std::vector<double> block_means;
};

// One answerer over all cases; `look` sees each answer, outside the timed stretches.
template <class Look>
Round run_round(const CaseSet& set, const std::string& name, const std::vector<FirstHit>& first_hit,
                const Listener& listener, Look look) {
  Round round;
  std::vector<Answer> answers(kBlock);
  const oracle::Request request;
  for (std::size_t begin = 0; begin < set.cases.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, set.cases.size());
    const auto start = Clock::now();
    for (std::size_t i = begin; i < end; ++i)
      first_hit[set.cases[i].scene](set.cases[i].query, request, answers[i - begin]);
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    round.total_ns += ns;
    round.block_means.push_back(ns / static_cast<double>(end - begin));
    for (std::size_t i = begin; i < end; ++i) look(i, answers[i - begin]);
    report(listener, name, end, set.cases.size());
  }
  return round;
}

// The same of another program, which has many queries at a time.
template <class Look>
Round run_round(const CaseSet& set, const std::string& name, Answerer& program, const Listener& listener,
                Look look) {
  std::vector<Answer> answers;
  answers.reserve(set.cases.size());
  program.on_answer([&](Answer& answer) {
    answers.push_back(std::move(answer));
    report(listener, name, answers.size(), set.cases.size());
  });
  const auto start = Clock::now();
  for (std::size_t i = 0; i < set.cases.size(); ++i) {
    const Case& one = set.cases[i];
    if (i == 0 || one.scene != set.cases[i - 1].scene) program.set_scene(set.scenes[one.scene]);
    program.ask(one.id, one.query);
  }
  program.drain();
  const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
  for (std::size_t i = 0; i < answers.size(); ++i) look(i, answers[i]);
  return {ns, {ns / static_cast<double>(std::max<std::size_t>(answers.size(), 1))}};
}

// One of the names, ready for every scene of the set.
struct Entrant {
  std::vector<FirstHit> first_hit;    // by scene
  std::unique_ptr<Answerer> program;  // or this

  Entrant(const CaseSet& set, const std::string& name, const MeasureOptions& options) {
    if (is_command(name))
      program = make_answerer(name, {{}, options.timeout, options.listener});
    else
      for (const Scene& scene : set.scenes) first_hit.push_back(make_first_hit(name, scene));
  }

  template <class Look>
  Round run(const CaseSet& set, const std::string& name, const Listener& listener, Look look) {
    return program ? run_round(set, name, *program, listener, look)
                   : run_round(set, name, first_hit, listener, look);
  }

  bool failed() const { return program && program->failed(); }
};

}  // namespace

std::vector<Tally> measure(const CaseSet& set, const std::vector<Answer>& exact,
                           const std::vector<std::string>& names, const OnWrong& on_wrong,
                           const MeasureOptions& options) {
  std::vector<Tally> tallies(names.size());
  std::vector<Entrant> entrants;
  std::vector<std::vector<Round>> rounds(names.size());
  for (std::size_t e = 0; e < names.size(); ++e) {
    tallies[e].name = names[e];
    entrants.emplace_back(set, names[e], options);
  }
  std::vector<oracle::Judge> judges;
  for (const Scene& scene : set.scenes) judges.emplace_back(scene);
  const auto start = Clock::now();
  for (int r = 0; r < options.rounds; ++r) {
    for (std::size_t e = 0; e < names.size(); ++e) {
      if (entrants[e].failed()) continue;
      rounds[e].push_back(
          entrants[e].run(set, names[e], options.listener, [&](std::size_t i, const Answer& given) {
            if (r > 0) return;
            if (exact.empty()) {
              ++tallies[e].queries;
              return;
            }
            const oracle::Judgement judgement =
                judges[set.cases[i].scene].judge(set.cases[i].query, exact[i], given, options.ulps);
            tallies[e].count(judgement);
            if (on_wrong && (judgement.verdict == oracle::Verdict::wrong ||
                             judgement.verdict == oracle::Verdict::ill_posed))
              on_wrong(set.cases[i], exact[i], names[e], given, judgement);
          }));
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() > kEnoughSeconds) break;
  }
  for (std::size_t e = 0; e < names.size(); ++e) {
    if (entrants[e].program) entrants[e].program->finish();
    tallies[e].failed = entrants[e].failed();
    auto& of_engine = rounds[e];
    std::sort(of_engine.begin(), of_engine.end(),
              [](const Round& a, const Round& b) { return a.total_ns < b.total_ns; });
    const Round& middle = of_engine[of_engine.size() / 2];
    if (set.cases.empty()) continue;
    tallies[e].ns_per_query = middle.total_ns / static_cast<double>(set.cases.size());
    tallies[e].ns_median = quantile(middle.block_means, 0.5);
    tallies[e].ns_low = quantile(middle.block_means, 0.25);
    tallies[e].ns_high = quantile(middle.block_means, 0.75);
  }
  return tallies;
}

}  // namespace lorentz::compare
