#include "question/cells/cell_store.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include <lorentz/exchange.hpp>
#include "files/scene_file.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::question {
namespace {

CellKey key_of(const BenchGroup& group, const std::string& engine) {
  return {group.scene, group.radius, group.difficulty, engine};
}

CellKey key_of(const report::Cell& cell) {
  return {cell.scene, cell.radius, cell.difficulty, cell.engine};
}

runs::Plan words_of(const BenchPlan& plan, const std::vector<BenchGroup>& groups, const runs::Plan& more) {
  std::vector<std::string> names;
  std::string scenes;
  for (const BenchGroup& group : groups) {
    names.push_back(fmt::format("{}/{}/{}", group.scene, group.radius ? json::text_of(*group.radius) : "own",
                                group.difficulty));
    append_scene_line(scenes, load_scene(group.scene, group.radius));
  }
  runs::Plan words{{"engines", fmt::format("{}", fmt::join(names_of(plan.engines), ", "))},
                   {"queries", std::to_string(plan.count)},
                   {"seed", std::to_string(plan.seed)},
                   {"cells", fmt::format("{}", fmt::join(names, " "))},
                   {"scenes", scenes}};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

BenchStore::BenchStore(std::optional<std::string> path, const BenchPlan& plan,
                       const std::vector<BenchGroup>& groups, const runs::Plan& words, std::string manifest)
    : plan_(plan), store_(path, "bench", words_of(plan, groups, words)) {
  store_.each([&](const std::string& piece) {  // the first piece is the manifest
    if (manifest_.empty())
      manifest_ = piece;
    else
      keep(report::cell_of(piece));
  });
  if (manifest_.empty()) store_.add({manifest_ = std::move(manifest)});
}

bool BenchStore::keep(report::Cell cell) {
  const CellKey key = key_of(cell);
  return cells_.emplace(key, std::move(cell)).second;
}

std::optional<std::vector<report::Cell>> BenchStore::find(const BenchGroup& group) const {
  std::vector<report::Cell> found;
  for (const EngineInfo& engine : plan_.engines) {
    const auto cell = cells_.find(key_of(group, engine.name));
    if (cell == cells_.end()) return std::nullopt;
    found.push_back(cell->second);
  }
  return found;
}

void BenchStore::add(const std::vector<report::Cell>& cells) {
  std::vector<std::string> pieces;
  for (const report::Cell& cell : cells)
    if (keep(cell)) pieces.push_back(report::piece_of(cell));
  store_.add(std::move(pieces));
}

}  // namespace lorentz::question
