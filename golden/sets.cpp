#include "golden/sets.hpp"

#include <limits>

#include "cases/bad_queries.hpp"

namespace lorentz::golden {
namespace {

constexpr std::string_view kBadQueries = "bad-queries";
constexpr std::uint64_t kCommitted = 640;  // 20 scenes of each family

std::vector<Set> make_sets() {
  std::vector<Set> all;
  for (const cases::Family& family : cases::families())
    all.push_back({std::string(family.name()), std::string(family.description()), family.tags(), kCommitted,
                   std::numeric_limits<std::uint64_t>::max()});
  const std::uint64_t bad = cases::bad_queries().size();
  all.push_back({std::string(kBadQueries), "Questions that are none: the answer is `error`.",
                 cases::bad_query_tags(), bad, bad});
  return all;
}

}  // namespace

SetQuestion Set::question(std::uint64_t seed, std::uint64_t index) const {
  if (name == kBadQueries) {
    const cases::BadQuery& bad = cases::bad_queries()[index];
    return {cases::bad_query_scene(), bad.text, {}, {bad.tag}};
  }
  cases::Case one = cases::family_named(name)->make(seed, index);
  std::string text = question_of(one.query, one.scene);
  return {std::move(one.scene), std::move(text), std::move(one.query), std::move(one.tags)};
}

const std::vector<Set>& sets() {
  static const std::vector<Set> all = make_sets();
  return all;
}

const Set* set_named(std::string_view name) {
  for (const Set& set : sets())
    if (set.name == name) return &set;
  return nullptr;
}

}  // namespace lorentz::golden
