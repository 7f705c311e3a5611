#include "fuzz/campaign/stint.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <set>
#include <tuple>

#include <lorentz/geometry.hpp>
#include "fuzz/campaign/rewording.hpp"
#include "fuzz/campaign/variants.hpp"

namespace lorentz::fuzz {

using namespace cases;

namespace {

// Each scene is asked about in kWordings other wordings, one question in kCasesPerLimit with a time limit.
constexpr std::uint64_t kWordings = 3, kCasesPerLimit = 4;

std::shared_ptr<Place> place_in(const Scene& scene, const Plan& plan) {
  return std::make_shared<Place>(scene, plan.claim);
}

Examiner examiner_in(const Scene& scene, Answerer& answerer, const Plan& plan) {
  return {answerer, place_in(scene, plan), plan.sought.ulps};
}

// Makes this case the simplest known one of the finding.
void take_for_shrunk(Finding& finding, const Place& place, const Query& query, const Examined& examined) {
  const Scene& scene = place.scene();
  finding.shrunk = text_of(label_of(finding), scene, query, examined);
  if (const auto decision = place.margins().hardest_decision(query, examined.exact))
    finding.shrunk.margin = decision->margin;
  finding.cause = cause_of(scene, query, examined);
  finding.bits = most_bits(scene, query);
  finding.complexity = complexity(scene, query);
}

}  // namespace

// A case or a variant to be asked, as it was made or in other words.
struct StintRunner::Case {
  std::uint64_t index;
  int step;
  Question question;
  SceneContext* context;
  std::string words = {};           // the other words, if any
  bool is_carried = false;          // the exact answer came from the case in its own words
  std::optional<Reply> reply = {};  // of the engine
};

// A scene, with all that is needed to ask and to judge in it.
struct StintRunner::SceneContext {
  SceneContext(Answerer& answerer, const Scene& scene, const Plan& plan, std::size_t number)
      : number(number), examiner(examiner_in(scene, answerer, plan)) {}
  const std::size_t number;  // in the order in which the contexts were needed
  Examiner examiner;

  const std::shared_ptr<Place>& place() const { return examiner.place(); }
  const Scene& scene() const { return examiner.scene(); }

  // The scene in other words, and the context of that scene.
  struct OtherWords {
    Rewording rewording;
    SceneContext* context;
  };
  std::map<std::uint64_t, OtherWords> other_words;
};

// All questions of one stint, and what comes of them.
struct StintRunner::Questions {
  const Target& target;
  std::deque<SceneContext> contexts = {};
  std::deque<Case> cases = {};  // whose places stay while it grows
  StintResult result = {};

  SceneContext& add_context(Answerer& answerer, const Scene& scene, const Plan& plan) {
    return contexts.emplace_back(answerer, scene, plan, contexts.size());
  }

  // The case's scene in the words of this number. They depend only on the scene and its place in the target,
  // so that they are the same in every stint.
  SceneContext::OtherWords& other_words(const Plan& plan, Answerer& answerer, const Case& one,
                                        std::uint64_t number) {
    auto& known = one.context->other_words;
    if (const auto found = known.find(number); found != known.end()) return found->second;
    Random random(plan.seed, target.name(), one.index / kCasesPerScene * kWordings + number,
                  Use::reworded_scenes);
    Rewording rewording(random, one.context->scene());
    SceneContext& context = add_context(answerer, rewording.scene(), plan);
    return known.emplace(number, SceneContext::OtherWords{std::move(rewording), &context}).first->second;
  }
};

StintRunner::StintRunner(const Plan& plan, const MakeAnswerer& make_answerer, const std::atomic<bool>& stop)
    : plan_(plan), make_answerer_(make_answerer), stop_(stop), answerer_(new_answerer()) {}
StintRunner::~StintRunner() = default;

std::unique_ptr<Answerer> StintRunner::new_answerer() const {
  return make_answerer_([&stop = stop_] { return stop.load(); });
}

std::optional<StintResult> StintRunner::run(const Stint& stint,
                                            const std::map<std::string, std::uint64_t>& known) {
  Questions questions{*plan_.targets[stint.target]};
  pose(stint, questions);
  if (stop_) return std::nullopt;
  take(questions, known);
  replace_broken_answerer();
  if (stop_) return std::nullopt;
  return std::move(questions.result);
}

void StintRunner::replace_broken_answerer() {
  if (!answerer_->failed()) return;
  answerer_failed_ = true;
  answerer_ = new_answerer();
}

// Makes the cases and variants, with their exact answers, and asks about them.
void StintRunner::pose(const Stint& stint, Questions& questions) {
  const Target& target = questions.target;
  TargetTally& met = questions.result.met;
  SceneContext* context = nullptr;
  for (std::uint64_t index = stint.begin; index < stint.end && !stop_; ++index) {
    const cases::Case base = target.make(plan_.seed, index, plan_.claim.precision);
    if (!plan_.scope.admits(base.scene)) continue;
    if (!context || context->scene() != base.scene)
      context = &questions.add_context(*answerer_, base.scene, plan_);
    const std::shared_ptr<Place>& place = context->place();
    const std::size_t first = questions.cases.size();
    const auto add = [&](int step, const Query& query, const Answer& exact) {
      const bool is_asked = place->takes(query) && place->takes(query, exact);
      if (is_asked)
        questions.cases.push_back({index, step, {.place = place, .query = query, .exact = exact}, context});
      ++(is_asked ? step > 0 ? met.variants : met.cases : met.outside);
    };
    const std::optional<Query> query = place->brought_inside(base.query);
    if (!query) {
      ++met.outside;
      continue;
    }
    add(0, *query, place->exact(*query));
    if (Random random(plan_.seed, target.name(), index, Use::variants);
        plan_.mutate > 0 && random.one_in(plan_.mutate)) {
      int step = 0;
      for (const Variant& variant : climb(random, *query, *place)) {
        if (variant.margin() > 0 && variant.margin() < met.margin)
          met.margin = variant.margin(), met.margin_index = index;
        add(++step, variant.query, variant.exact);
      }
    }
    if (Random random(plan_.seed, target.name(), index, Use::rewordings);
        plan_.reword > 0 && random.one_in(plan_.reword))
      pose_in_other_words(random, questions, first);
  }
  ask(questions);
}

// Poses the cases from `first` on in other words. The scene's words are one of kWordings, in turn; the
// query's are its own. The exact answer is carried over where possible.
void StintRunner::pose_in_other_words(Random& random, Questions& questions, std::size_t first) {
  for (std::size_t i = first, last = questions.cases.size(); i < last && !stop_; ++i) {
    const Case& one = questions.cases[i];
    random.bits();  // not used: with it, the words of a seed stay as they were
    const auto number = (one.index + static_cast<std::uint64_t>(one.step)) % kWordings;
    auto& [rewording, context] = questions.other_words(plan_, *answerer_, one, number);
    if (!plan_.scope.admits(context->scene())) continue;
    auto reworded = rewording.reword(random, one.question.query);
    if (!reworded || !context->place()->takes(reworded->query)) continue;
    auto carried = rewording.carried(one.question.exact, *reworded);
    Question question{.place = context->place(), .query = std::move(reworded->query)};
    question.exact = carried ? std::move(*carried) : question.place->exact(question.query);
    if (!question.place->takes(question.query, question.exact)) continue;
    std::string words = rewording.words(*reworded);
    if (random.one_in(kCasesPerLimit) && answerer_->takes_limits() && plan_.claim.domain.limits) {
      const LimitAt limit = drawn_limit(random, question.exact);
      question.max_time = limit_of(limit, question.exact);
      if (limit != LimitAt::none) words += (words.empty() ? "" : ", ") + words_of(limit);
    }
    if (words.empty()) continue;
    questions.cases.push_back(
        {one.index, one.step, std::move(question), context, std::move(words), carried.has_value()});
  }
}

// Scene by scene, so that an engine is prepared once for each scene.
void StintRunner::ask(Questions& questions) {
  std::vector<Case*> asked;
  for (Case& one : questions.cases) asked.push_back(&one);
  std::stable_sort(asked.begin(), asked.end(),
                   [](const Case* a, const Case* b) { return a->context->number < b->context->number; });
  const auto in_order = [&, next = std::size_t{0}]() mutable -> std::optional<Question> {
    if (stop_ || next == asked.size()) return std::nullopt;
    return asked[next++]->question;
  };
  std::vector<Reply> replies = replies_to(in_order, *answerer_);
  for (std::size_t i = 0; i < replies.size(); ++i) asked[i]->reply = std::move(replies[i]);
}

// Judges the replies. One finding of a sort is enough for a case and its variants.
void StintRunner::take(Questions& questions, const std::map<std::string, std::uint64_t>& known) {
  StintResult& result = questions.result;
  std::set<std::tuple<std::uint64_t, std::string>> kept;
  for (Case& one : questions.cases) {
    if (stop_) break;
    if (!one.reply) continue;
    const Examined examined = one.context->examiner.judge(one.question, *one.reply, one.is_carried);
    const bool in_other_words = !one.words.empty();
    // That an engine does not support the other words is not a finding.
    if (in_other_words && examined.kind == Kind::unsupported) continue;
    result.met.reworded += in_other_words;
    ++result.met.counts[examined.kind];
    if (examined.stage) ++result.met.stages[static_cast<std::size_t>(*examined.stage)];
    if (!plan_.sought.is_finding(examined.kind)) continue;
    const std::string sort = sort_of(one.context->scene(), one.question.query, examined) +
                             (in_other_words ? ", in other words" : "");
    std::uint64_t& number = result.met.sorts[sort];
    if (!kept.emplace(one.index, sort).second) continue;
    ++number;
    const auto before = known.find(sort);
    if (number + (before == known.end() ? 0 : before->second) > plan_.keep) continue;
    result.kept.push_back({finding_of(questions.target, one, sort, examined), number});
  }
}

Finding StintRunner::finding_of(const Target& target, const Case& one, const std::string& sort,
                                const Examined& examined) {
  Finding finding;
  finding.target = target.name();
  finding.index = one.index;
  finding.step = one.step;
  finding.words = one.words;
  finding.kind = name_of(examined.kind).words;
  finding.sort = sort;
  take_for_shrunk(finding, *one.context->place(), one.question.query, examined);
  finding.text = finding.shrunk;
  if (answerer_->failed()) finding.shrinking = Shrinking::done;
  return finding;
}

// Shrinks a case that fails: it must go on failing in the same kind and with the same two outcomes. Ends if
// the answerer fails.
Shrunk StintRunner::shrink_case(const ReadCase& found, const Examined& like, LimitAt limit,
                                const std::function<bool()>& is_late) {
  std::optional<Examiner> examiner;
  double flight = -1;
  const StillFails fails = in_places([this](const Scene& scene) { return place_in(scene, plan_); },
                                     [&](const std::shared_ptr<Place>& place, const Query& query) {
                                       if (!examiner || examiner->place() != place)
                                         examiner.emplace(*answerer_, place, plan_.sought.ulps);
                                       const Examined one = examiner->examine(query, limit);
                                       flight = one.exact.time ? *one.exact.time * length(query.v) : -1;
                                       return one.kind == like.kind &&
                                              one.given.outcome == like.given.outcome &&
                                              one.exact.outcome == like.exact.outcome;
                                     });
  const auto is_up = [&] { return stop_ || answerer_->failed() || is_late(); };
  return fuzz::shrink(found.scene, found.query, fails, [&] { return flight; }, {kShrinkTries, is_up});
}

std::optional<Finding> StintRunner::shrink(Finding finding, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto is_late = [&] { return std::chrono::duration<double>(Clock::now() - start).count() > seconds; };
  const ReadCase found = case_in(finding.text);
  const LimitAt limit = limit_in(finding.words);
  const Examined examined = examiner_in(found.scene, *answerer_, plan_).examine(found.query, limit);
  finding.shrinking = Shrinking::done;
  if (!answerer_->failed() && name_of(examined.kind).words == finding.kind) {
    const Shrunk shrunk = shrink_case(found, examined, limit, is_late);
    if (is_late()) finding.shrinking = Shrinking::cut_short;
    finding.tries = shrunk.tries;
    if (!stop_ && !answerer_->failed()) {
      Examiner examiner = examiner_in(shrunk.scene, *answerer_, plan_);  // beyond the budget
      const Examined after = examiner.examine(shrunk.query, limit);
      // Otherwise the engine's answers vary, and the finding stays as it was found.
      if (name_of(after.kind).words == finding.kind)
        take_for_shrunk(finding, *examiner.place(), shrunk.query, after);
    }
  }
  replace_broken_answerer();
  if (stop_) return std::nullopt;
  return finding;
}

std::string label_of(const Finding& finding) {
  std::string label = finding.target + '/' + std::to_string(finding.index);
  if (finding.step > 0) label += '.' + std::to_string(finding.step);
  return finding.words.empty() ? label : label + 'r';
}

}  // namespace lorentz::fuzz
