#include "stint.hpp"

#include <cmath>
#include <deque>
#include <set>
#include <tuple>

#include "margin.hpp"
#include "mutation.hpp"
#include "parts.hpp"
#include "shrink.hpp"

namespace lorentz::fuzz {
namespace {

// Work (in the subject's own count) that shrinking one case may cost: some seconds of `published`.
constexpr double kShrinkWork = 1.5e7;

// An oracle asked which of a million obstacles contain x takes its time; shrinking does not go there.
constexpr double kLargestRadius = 100;

bool is_sane(const Scene& scene) {
  for (const Lattice& lattice : scene.lattices) {
    double shortest = length(lattice.vectors[0]), largest = 0;
    for (int i = 1; i < scene.dimension; ++i) shortest = std::min(shortest, length(lattice.vectors[i]));
    for (const Atom& atom : lattice.atoms) {
      largest = std::max(largest, atom.radius);
      for (const Vec& axis : atom.semiaxes) largest = std::max(largest, length(axis));
    }
    if (!(largest <= kLargestRadius * shortest)) return false;
  }
  return true;
}

// Does a case fail as another one did: in kind, and in both outcomes?
class SameFailure {
 public:
  SameFailure(Subject& subject, const Plan& plan, const std::atomic<bool>& stop, const Examined& like)
      : subject_(subject), plan_(plan), stop_(stop), like_(like) {}

  bool operator()(const Scene& scene, const Query& query) {
    if (stop_ || work_ > kShrinkWork || subject_.failed()) return false;
    if (!examiner_ || !same(examiner_->scene(), scene)) {
      if (!is_sound(scene) || !is_sane(scene)) return false;
      examiner_.emplace(subject_, scene, plan_.counts.ulps, plan_.truth);
    }
    if (flaw_of(query, scene)) return false;
    last_ = examiner_->examine(query);
    work_ += last_.work.value_or(0);
    speed_ = length(query.v);
    return last_.kind == like_.kind && last_.given.outcome == like_.given.outcome &&
           last_.exact.outcome == like_.exact.outcome;
  }

  double flight() const { return last_.exact.time ? *last_.exact.time * speed_ : -1; }

  // Whatever is left to spend.
  Examined examine(const Scene& scene, const Query& query) {
    return Examiner(subject_, scene, plan_.counts.ulps, plan_.truth).examine(query);
  }

 private:
  Subject& subject_;
  const Plan& plan_;
  const std::atomic<bool>& stop_;
  const Examined& like_;
  std::optional<Examiner> examiner_;
  Examined last_;
  double work_ = 0, speed_ = 0;
};

}  // namespace

// A case or a mutant that was asked about.
struct StintWorker::Case {
  const Target* target;
  std::uint64_t index;
  int step;
  Question question;
  Room* room;
};

// A scene.
struct StintWorker::Room {
  Room(Subject& subject, const Scene& scene, const Plan& plan)
      : examiner(subject, scene, plan.counts.ulps, plan.truth) {}
  const oracle::Scrutiny& scrutiny() {
    if (!scrutiny_) scrutiny_.emplace(examiner.scene());
    return *scrutiny_;
  }
  Examiner examiner;

 private:
  std::optional<oracle::Scrutiny> scrutiny_;
};

// All that is asked about in one stint, and the margins met in its climbs.
struct StintWorker::Desk {
  std::deque<Room> rooms;
  std::vector<Case> cases;
  Account met;
};

StintWorker::StintWorker(const Plan& plan, const MakeSubject& make_subject, const std::atomic<bool>& stop)
    : plan_(plan), make_subject_(make_subject), stop_(stop), subject_(make_subject()) {}
StintWorker::~StintWorker() = default;

std::optional<StintResult> StintWorker::work(const Stint& stint,
                                             const std::map<std::string, std::uint64_t>& known) {
  Desk desk;
  pose(stint, desk);
  if (stop_) return std::nullopt;
  StintResult result;
  result.met = desk.met;
  take(desk, known, result);
  if (subject_->failed()) {
    subject_failed_ = true;
    subject_ = make_subject_();
  }
  if (stop_) return std::nullopt;
  return result;
}

// Makes the cases and mutants, with their exact answers, and asks the subject.
void StintWorker::pose(const Stint& stint, Desk& desk) {
  const Target& target = *plan_.targets[stint.target];
  for (std::uint64_t index = stint.begin; index < stint.end && !stop_; ++index) {
    if (index % plan_.shards != plan_.shard) continue;
    const fuzz::Case base = target.make(plan_.seed, index);
    if (desk.rooms.empty() || !same(desk.rooms.back().examiner.scene(), base.scene))
      desk.rooms.emplace_back(*subject_, base.scene, plan_);
    Room& room = desk.rooms.back();
    desk.cases.push_back({&target, index, 0, {base.query, room.examiner.exact(base.query)}, &room});
    ++desk.met.cases;
    Random random(plan_.seed, target.name(), index, Use::mutants);
    if (plan_.mutate == 0 || !random.one_in(plan_.mutate)) continue;
    int step = 0;
    for (Mutant& mutant : climb(random, base, room.examiner, room.scrutiny())) {
      if (mutant.margin() > 0 && mutant.margin() < desk.met.margin)
        desk.met.margin = mutant.margin(), desk.met.margin_index = index;
      desk.cases.push_back({&target, index, ++step, std::move(mutant.question), &room});
    }
    desk.met.mutants += static_cast<std::uint64_t>(step);
  }
  for (const Case& one : desk.cases) {
    if (stop_) break;
    one.room->examiner.ask(one.question);
  }
}

// Judges the replies. Of a case and its mutants one finding of a sort is enough.
void StintWorker::take(Desk& desk, const std::map<std::string, std::uint64_t>& known, StintResult& result) {
  std::vector<Reply> replies = subject_->replies();
  std::set<std::tuple<std::uint64_t, std::string>> kept;
  for (std::size_t i = 0; i < replies.size() && !stop_; ++i) {
    const Case& one = desk.cases[i];
    const Examined examined = one.room->examiner.judge(one.question, replies[i]);
    ++result.met.kinds[static_cast<std::size_t>(examined.kind)];
    if (examined.stage) ++result.met.stages[static_cast<std::size_t>(*examined.stage)];
    if (!plan_.counts.is_finding(examined.kind)) continue;
    const std::string sort = sort_of(one.room->examiner.scene(), one.question.query, examined);
    std::uint64_t& number = result.met.sorts[sort];
    if (!kept.emplace(one.index, sort).second) continue;
    ++number;
    const auto before = known.find(sort);
    if (number + (before == known.end() ? 0 : before->second) > plan_.keep) continue;
    result.kept.push_back({finding_of(one, examined), number});
  }
}

Finding StintWorker::finding_of(const Case& one, const Examined& examined) {
  const Scene& scene = one.room->examiner.scene();
  const std::string label = label_of(one.target->name(), one.index, one.step);
  Finding finding;
  finding.target = one.target->name();
  finding.index = one.index;
  finding.step = one.step;
  finding.kind = name_of(examined.kind);
  finding.sort = sort_of(scene, one.question.query, examined);
  finding.text = text_of(label, scene, one.question.query, examined);
  finding.departs = examined.departs;
  if (const auto decision = one.room->scrutiny().hardest_decision(one.question.query, examined.exact))
    finding.margin = decision->margin;
  shrink_into(finding, one, examined);
  return finding;
}

void StintWorker::shrink_into(Finding& finding, const Case& one, const Examined& examined) {
  Shrunk shrunk{one.room->examiner.scene(), one.question.query};
  Examined after = examined;
  if (!subject_->failed()) {
    SameFailure fails(*subject_, plan_, stop_, examined);
    shrunk = shrink(shrunk.scene, shrunk.query, std::ref(fails), [&] { return fails.flight(); });
    if (!stop_ && !subject_->failed()) after = fails.examine(shrunk.scene, shrunk.query);
  }
  finding.shrunk =
      text_of(label_of(finding.target, finding.index, finding.step), shrunk.scene, shrunk.query, after);
  finding.cause = cause_of(shrunk.scene, shrunk.query, after);
  finding.bits = most_bits(shrunk.scene, shrunk.query);
  finding.complexity = complexity(shrunk.scene, shrunk.query);
  finding.tries = shrunk.tries;
}

std::string label_of(std::string_view target, std::uint64_t index, int step) {
  std::string label = std::string(target) + '/' + std::to_string(index);
  if (step > 0) label += '.' + std::to_string(step);
  return label;
}

}  // namespace lorentz::fuzz
