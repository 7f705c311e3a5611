#include "cli/compare_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <tuple>

#include <lorentz/exchange.hpp>
#include "cli/numbers.hpp"
#include "files/messages.hpp"
#include "files/scene_file.hpp"
#include "report/claim_words.hpp"
#include "src/exchange/json_piece.hpp"

namespace lorentz::question {

static auto members_of(Tally& self) {
  return std::tie(self.queries, self.agree, self.ill_posed, self.wrong, self.undecided, self.unsupported,
                  self.error, self.missing, self.wrong_time, self.other_quantity, self.timed_hits, self.ulps,
                  self.wrong_ulps, self.wrong_conditions);
}

}  // namespace lorentz::question

namespace lorentz::cli {

static auto members_of(ComparedPart& self) {
  return std::tie(self.number, self.check, self.tallies, self.wrong, self.disagreements);
}

namespace {

runs::Plan plan_of(const CompareOptions& options, const std::vector<std::string>& names) {
  std::string scene;
  if (options.scene || !options.queries)
    append_scene_line(scene, read_scene(options.scene.value_or("square"), options.radius));
  runs::Plan plan{{"compared", fmt::format("{}", fmt::join(names, ", "))},
                  {"queries", options.queries ? "given" : "drawn"},
                  {"count", options.queries ? "" : std::to_string(options.count)},
                  {"seed", options.queries ? "" : std::to_string(options.seed)},
                  {"scene", scene},
                  {"judge", options.judge},
                  {"ulps", options.ulps ? fmt::format("{}", *options.ulps) : "4"},
                  {"kept", fmt::format("{}{}{} wrong answers", options.disagreements ? "disagreements, " : "",
                                       options.times ? "times, " : "", options.json ? 0 : options.failures)}};
  if (const Claim claim = options.claim.claim(); !(claim == Claim()))
    plan.push_back({"claim", report::arguments_of(claim)});
  return plan;
}

}  // namespace

ComparedParts::ComparedParts(const CompareOptions& options, const std::vector<std::string>& names)
    : compared_(names.size()), store_(options.store, "compare", plan_of(options, names)) {
  std::tie(shard_, shards_) = shard_in(options.shard);
  read(store_, options.store.value_or(""));
  for (const std::string& path : options.parts)
    read(runs::PieceStore(path, "compare", plan_of(options, names), runs::Access::read), path);
}

void ComparedParts::read(const runs::PieceStore& store, const std::string& name) {
  std::size_t queries = 0;
  store.each([&](const std::string& piece) {
    ComparedPart part;
    json::read_piece(piece, part);
    queries += part.tallies.at(0).queries;
    const std::uint64_t number = part.number;
    if (!parts_.emplace(number, std::move(part)).second)
      throw InputError(fmt::format("is part {}, which is there twice", number));
  });
  if (queries > 0) say("{}: {} queries are judged", name, queries);
}

bool ComparedParts::is_to_do(std::uint64_t number, std::uint64_t check) const {
  const auto found = parts_.find(number);
  if (found != parts_.end() && found->second.check != check)
    throw InputError(
        fmt::format("--store: part {} was done of other queries; give those, or name another file", number));
  return found == parts_.end() && number % shards_ == shard_;
}

void ComparedParts::add(ComparedPart part, bool is_whole) {
  if (store_.is_file() && is_whole) store_.add({json::piece_of(part)});
  const std::uint64_t number = part.number;
  parts_.emplace(number, std::move(part));
}

std::uint64_t check_of(const std::vector<question::Question>& questions) {
  std::uint64_t check = runs::kCheckOfNothing;
  const question::Place* place = nullptr;
  std::string line;
  for (const question::Question& one : questions) {
    line.clear();
    const Scene& scene = one.place->scene();
    if (one.place.get() != place) append_scene_line(line, scene);
    place = one.place.get();
    append_query_line(line, one.id, one.query, scene);
    check = runs::check_of(line, check);
  }
  return check;
}

}  // namespace lorentz::cli
