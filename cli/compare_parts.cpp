#include "cli/compare_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <tuple>

#include <lorentz/exchange.hpp>
#include "cli/numbers.hpp"
#include "files/messages.hpp"
#include "files/scene_file.hpp"
#include "report/claim_words.hpp"
#include "src/exchange/exchange_json.hpp"
#include "src/exchange/json_writer.hpp"

namespace lorentz::cli {

using question::Tally;

namespace {

constexpr std::size_t Tally::*kCounts[] = {&Tally::queries,        &Tally::agree,     &Tally::ill_posed,
                                           &Tally::wrong,          &Tally::undecided, &Tally::unsupported,
                                           &Tally::error,          &Tally::missing,   &Tally::wrong_time,
                                           &Tally::other_quantity, &Tally::timed_hits};

std::string text_of(const ComparedPart& part) {
  std::size_t next = 0;
  const auto tally = [&](json::Members& one, const Tally& its) {
    std::vector<std::size_t> counts;
    for (const auto count : kCounts) counts.push_back(its.*count);
    one.add("counts", counts, "ulps", its.ulps, "wrong_ulps", its.wrong_ulps, "wrong_conditions",
            its.wrong_conditions, "wrong", part.wrong[next++]);
  };
  return json::text_of([&](json::Members& object) {
    object.add("part", part.number, "check", json::Digits{part.check}, "tallies",
               json::objects(part.tallies, tally), "disagreements", part.disagreements);
  });
}

std::vector<double> numbers_in(json::Array array) {
  std::vector<double> numbers;
  json::each_element(array, [&](json::Value value) {
    numbers.push_back(read_number_or_infinity(value, "an error of a time"));
  });
  return numbers;
}

Tally tally_in(json::Object object) {
  Tally tally;
  std::size_t next = 0;
  json::each_element(object["counts"].array(), [&](json::Value value) {
    if (next == std::size(kCounts)) throw InputError("has a count too many");
    tally.*kCounts[next++] = value.natural();
  });
  for (const auto& [key, numbers] : {std::pair{"ulps", &Tally::ulps},
                                     {"wrong_ulps", &Tally::wrong_ulps},
                                     {"wrong_conditions", &Tally::wrong_conditions}})
    tally.*numbers = numbers_in(object[key].array());
  const std::size_t sum = tally.agree + tally.ill_posed + tally.wrong + tally.undecided + tally.unsupported +
                          tally.error + tally.missing;
  if (next != std::size(kCounts) || sum != tally.queries || tally.timed_hits != tally.ulps.size() ||
      tally.other_quantity > tally.wrong_time || tally.wrong_time != tally.wrong_ulps.size() ||
      tally.wrong_time != tally.wrong_conditions.size())
    throw InputError("has counts that do not fit together");
  return tally;
}

ComparedPart part_in(const std::string& text) {
  try {
    json::Document document;
    document.open(text);
    json::Object object = document.object();
    ComparedPart part;
    part.number = object["part"].natural();
    part.check = object["check"].natural();
    json::each_element(object["tallies"].array(), [&](json::Value value) {
      json::Object one = value.object();
      part.tallies.push_back(tally_in(one));
      std::vector<std::string>& wrong = part.wrong.emplace_back();
      json::each_element(one["wrong"].array(), [&](json::Value its) { wrong.emplace_back(its.text()); });
    });
    part.disagreements = object["disagreements"].text();
    return part;
  } catch (const json::Error& error) {
    throw InputError(std::string("is not a part of a comparison: ") + error.what());
  }
}

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
    ComparedPart part = part_in(piece);
    if (part.tallies.size() != compared_) throw InputError("is of another number of engines");
    queries += part.tallies[0].queries;
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
  if (store_.is_file() && is_whole) store_.add({text_of(part)});
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
