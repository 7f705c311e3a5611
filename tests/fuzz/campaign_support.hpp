// Answerers and stores for the tests of campaigns.
#pragma once

#include <functional>
#include <sstream>
#include <utility>

#include <lorentz/oracle.hpp>
#include "fuzz/campaign/store.hpp"

namespace lorentz::test {

/// Says what it is told to.
class ToldAnswerer final : public question::Answerer {
 public:
  using Says = std::function<Answer(const question::Place&, const Query&)>;
  explicit ToldAnswerer(Says says) : says_(std::move(says)) {}
  void ask(const Id&, const Query& query) override { deliver({.answer = says_(*place_, query)}); }

 private:
  void enter(const Scene& scene) override { place_.emplace(scene); }
  const Says says_;
  std::optional<question::Place> place_;
};

inline question::MakeAnswerer told(const ToldAnswerer::Says& says) {
  return [=](const auto&) { return std::make_unique<ToldAnswerer>(says); };
}

/// Right, but for flights that leave an obstacle of cell 0 with v_1 > 1/2: these it takes a cell too far.
inline Answer skewed_answer(const question::Place& place, const Query& query) {
  Answer answer = place.exact(query);
  const bool skewed = query.from && query.v[0] > 0.5 && query.from->cell[0] == Integer(0);
  if (skewed && answer.outcome == Outcome::hit && answer.obstacle.cell[0].fits_int64())
    answer.obstacle.cell[0] = answer.obstacle.cell[0].int64() + 1;
  return answer;
}

inline question::MakeAnswerer skewed_answerers() {
  return told(skewed_answer);
}

inline std::string text_of(const fuzz::TargetTally& a) {
  std::ostringstream out;
  out << a.next << ' ' << a.cases << ' ' << a.variants << ' ' << a.reworded << ' ' << a.margin << ' '
      << a.margin_index;
  for (const question::CountName& name : question::kCountNames) out << ' ' << a.counts[name.count];
  for (const std::uint64_t n : a.stages) out << ' ' << n;
  for (const auto& [sort, number] : a.sorts)
    if (number > 0) out << '\n' << sort << ": " << number;
  return out.str() + '\n';
}

inline std::string text_of(const fuzz::Stored& stored) {
  const fuzz::Finding& f = stored.finding;
  std::ostringstream out;
  out << stored.label() << '\n'
      << f.words << '|' << f.kind << '|' << f.sort << '|' << f.cause << '|' << static_cast<int>(f.shrinking)
      << '|' << f.bits << '|' << f.complexity << '|' << f.tries << '\n';
  for (const fuzz::CaseText* text : {&f.text, &f.shrunk})
    out << text->scene << '\n'
        << text->query << '\n'
        << text->given << '\n'
        << text->exact << '\n'
        << text->departs << ' ' << text->margin.value_or(-1) << '\n';
  return out.str();
}

/// Everything that a store holds.
inline std::string text_of(const fuzz::Store& store) {
  std::string out;
  for (const fuzz::Campaign& campaign : store.campaigns()) {
    const fuzz::CampaignManifest& m = campaign.manifest;
    out += m.engine + ' ' + std::to_string(m.seed) + ' ' + m.options + '\n';
    for (const std::string& target : m.targets)
      out += target + ' ' + text_of(store.tally(campaign.id, target));
  }
  for (const fuzz::Stored& one : store.findings()) out += text_of(one);
  return out;
}

}  // namespace lorentz::test
