#include "judge/golden/sets.hpp"

#include <algorithm>
#include <limits>

#include "question/cases/bad_queries.hpp"

namespace lorentz::golden {
namespace {

constexpr std::string_view kBadQueries = "bad-queries";
constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();
// From 20 and 25 scenes.
constexpr std::uint64_t kCount = 640, kCountInBinary32 = 200;
constexpr std::uint64_t kCasesOfScene = 8;  // in a set in binary32

constexpr std::string_view kCommittedInBinary32[] = {
    "near-rational", "grazing",     "ties",    "boundary-starts", "corridor-edge",    "long-flight",
    "generic-3d",    "tricylinder", "ball-2d", "ball-3d",         "axis-and-diagonal"};

Set set_of(const cases::Family& family, NumberFormat precision) {
  const std::string name(family.name());
  if (precision == NumberFormat::binary64)
    return {name, name, std::string(family.description()), family.tags(), precision, kCount, kEndless, true};
  return {name + "-binary32",
          name,
          std::string(family.description(precision)),
          family.tags(precision),
          precision,
          kCountInBinary32,
          kEndless,
          std::ranges::find(kCommittedInBinary32, name) != std::end(kCommittedInBinary32)};
}

std::vector<Set> make_sets() {
  std::vector<Set> all;
  for (const cases::Family& family : cases::families()) all.push_back(set_of(family, NumberFormat::binary64));
  const std::uint64_t bad = cases::bad_queries().size();
  all.push_back({std::string(kBadQueries), std::string(kBadQueries),
                 "Questions that are none: the answer is `error`.", cases::bad_query_tags(),
                 NumberFormat::binary64, bad, bad, true});
  for (const cases::Family& family : cases::families()) all.push_back(set_of(family, NumberFormat::binary32));
  return all;
}

}  // namespace

SetQuestion Set::question(std::uint64_t seed, std::uint64_t index) const {
  if (family == kBadQueries) {
    const cases::BadQuery& bad = cases::bad_queries()[index];
    return {cases::bad_query_scene(), bad.text, {}, {bad.tag}};
  }
  if (precision == NumberFormat::binary32)
    index = index / kCasesOfScene * cases::kCasesPerScene + index % kCasesOfScene;
  cases::Case one = cases::family_named(family)->make(seed, index, precision);
  std::string text = question_of(one.query, one.scene);
  return {std::move(one.scene), std::move(text), std::move(one.query), std::move(one.tags)};
}

const std::vector<Set>& sets() {
  static const std::vector<Set> all = make_sets();
  return all;
}

const Set* set_named(std::string_view name, NumberFormat precision) {
  for (const Set& set : sets())
    if (set.family == name && set.precision == precision) return &set;
  for (const Set& set : sets())
    if (set.name == name) return &set;
  return nullptr;
}

}  // namespace lorentz::golden
