#include "judge/golden/production.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <deque>
#include <iterator>
#include <unordered_set>

#include "judge/golden/maker.hpp"
#include "question/examine.hpp"

namespace lorentz::golden {

namespace {

constexpr std::uint64_t kBatch = cases::kCasesPerScene;

struct Made {
  std::string scene_line;
  Components components = 2;
  std::optional<MadeRecord> record;  // nothing: the question is left out
};

using Batch = std::vector<Made>;

NumberFormat precision_of(const Order& order) {
  return order.given ? order.given->header.precision : order.set->precision;
}

// Nothing if a given question cannot be proved.
std::optional<MadeRecord> make_record(const Maker& maker, const Order& order, const SetQuestion& question) {
  try {
    MadeRecord made = maker.make(question.text, question.query);
    if (order.given && order.given->look && !question.query) made.record.tags.emplace_back("invalid");
    if (order.given && order.given->look && question.query) {
      for (std::string& tag : tags_seen(question.scene, *question.query, made.record.expect, made.hardest))
        made.record.tags.push_back(std::move(tag));
    }
    made.record.tags.insert(made.record.tags.begin(), question.tags.begin(), question.tags.end());
    made.record.source_id = question.source_id;
    return made;
  } catch (const ProofTooLong&) {
    if (!order.given) throw;
    return std::nullopt;
  }
}

// The questions of one batch, most of which share a scene.
Batch make_batch(const Order& order, std::uint64_t number) {
  Batch batch;
  std::optional<Maker> maker;
  const std::uint64_t all = order.given ? order.given->questions.size() : order.set->most;
  const std::uint64_t end = std::min(all, (number + 1) * kBatch);
  for (std::uint64_t index = number * kBatch; index < end; ++index) {
    const SetQuestion question =
        order.given ? order.given->questions[index] : order.set->question(order.seed, index);
    const std::string scene_line = lorentz::scene_line(question.scene);
    if (!maker || maker->scene_line() != scene_line)
      maker.emplace(question.scene, Others{}, precision_of(order));
    batch.push_back({scene_line, question.scene, make_record(*maker, order, question)});
  }
  return batch;
}

// The batches from number `first` on, made by all threads: a few for each, but no more than hold `most` questions.
std::vector<Batch> make_batches(const Order& order, std::uint64_t first, std::uint64_t most) {
  constexpr std::uint64_t kOfEach = 4;
  std::vector<Batch> batches(std::min(kOfEach * order.jobs, most / kBatch + 1));
  std::atomic<std::size_t> next = 0;
  question::in_stretches(order.jobs, order.jobs, [&](auto...) {
    for (std::size_t i; (i = next++) < batches.size();) batches[i] = make_batch(order, first + i);
  });
  return batches;
}

// The number with the sixteen hexadecimal digits of an id.
std::uint64_t number_of(std::string_view id) {
  std::uint64_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number, 16);
  return number;
}

void count(RecordCounts& counts, const MadeRecord& made) {
  ++counts.records;
  counts.needing_judge += needs_judge(made.record);
  counts.walked += made.walked;
  const Outcome outcome = made.record.expect.outcome;
  counts.hits += outcome == Outcome::hit;
  counts.insides += outcome == Outcome::inside;
  counts.nevers += outcome == Outcome::never;
  counts.errors += outcome == Outcome::error;
}

// Makes all records, and passes on the text of one batch at a time.
RecordCounts produce_lines(const Order& order, const Write& write, const OnProgress& progress) {
  RecordCounts counts;
  std::deque<Batch> batches;
  std::uint64_t number = 0;  // of batches so far
  std::string scene_line;    // the last one written
  std::unordered_set<std::uint64_t> ids;
  while (counts.records + counts.left_out < order.count) {
    if (batches.empty()) {
      auto more = make_batches(order, number, order.count - counts.records - counts.left_out);
      number += more.size();
      std::ranges::move(more, std::back_inserter(batches));
    }
    std::string text;
    for (const Made& made : batches.front()) {
      if (!made.record) ++counts.left_out;
      if (!made.record) continue;
      const Record& record = made.record->record;
      if (counts.records == order.count || !ids.insert(number_of(record.id)).second) continue;
      if (made.scene_line != scene_line) {
        scene_line = made.scene_line;
        text += scene_line + '\n';
      }
      append_record_line(text, record, made.components);
      count(counts, *made.record);
    }
    batches.pop_front();
    write(text);
    if (progress) progress(counts.records);
  }
  return counts;
}

}  // namespace

bool GivenQuestions::add(SetQuestion question) {
  const auto [place, is_new] =
      by_id_.try_emplace(id_of(scene_line(question.scene), question.text), questions.size());
  if (is_new) {
    questions.push_back(std::move(question));
    return true;
  }
  std::vector<std::string>& tags = questions[place->second].tags;
  for (std::string& tag : question.tags)
    if (std::ranges::find(tags, tag) == tags.end()) tags.push_back(std::move(tag));
  return false;
}

Header header_of(const Order& order) {
  Header header;
  if (order.given) {
    header = order.given->header;
    if (order.given->look) header.tags.insert(header.tags.end(), seen_tags().begin(), seen_tags().end());
  } else {
    const Set& set = *order.set;
    header = {.name = set.name,
              .description = set.description,
              .version = LORENTZ_VERSION,
              .precision = set.precision};
    const bool is_wide = set.precision == NumberFormat::binary64;
    header.generator = fmt::format("lorentz golden make --set {}{} --count {} --seed {}", set.family,
                                   is_wide ? "" : " --precision binary32", order.count, order.seed);
    for (const cases::Tag& tag : set.tags) header.tags.emplace_back(tag.name, tag.note);
  }
  header.count = order.count;
  header.tags.emplace_back(kNeedsJudge, kNeedsJudgeNote);
  return header;
}

// For given questions the number of records is known only at the end.
RecordCounts produce(const Order& order, const Write& write, const OnProgress& progress) {
  auto write_header = [&, header = header_of(order)](std::uint64_t count) mutable {
    header.count = count;
    std::string line;
    append_header_line(line, header);
    write(line);
  };
  if (!order.given) {
    write_header(order.count);
    return produce_lines(order, write, progress);
  }
  std::string all;
  const RecordCounts counts = produce_lines(
      order, [&](std::string_view text) { all += text; }, progress);
  write_header(counts.records);
  write(all);
  return counts;
}

}  // namespace lorentz::golden
