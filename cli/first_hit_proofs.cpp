#include "cli/first_hit.hpp"

#include <lorentz/exchange.hpp>
#include "cli/golden_questions.hpp"
#include "cli/output.hpp"
#include "judge/golden/maker.hpp"
#include "report/files/messages.hpp"
#include "src/exchange/exchange_write.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::cli {
namespace {

// The proof; empty if it is too long for any checker.
std::optional<golden::Proved> proved_by(const golden::Maker& maker, const Query& query) {
  try {
    return maker.prove(query);
  } catch (const golden::ProofTooLong&) {
    return std::nullopt;
  }
}

void append_proved_line(std::string& out, const Id& id, const golden::Proved& proved,
                        const Components& count) {
  json::append(out, [&](json::Members& line) {
    line.add("id", json::Raw{id});
    add_answer(line, proved.exact, count);
    line.add("certificate",
             [&](json::Members& object) { golden::add_certificate(object, proved.certificate, count); });
  });
  out += '\n';
}

}  // namespace

int answer_with_proofs(QueryStream& stream, question::Answerer& answerer) {
  Output output;
  Answer answer;
  long unproved = 0;
  double limit = question::kForEver;  // of an engine that knows none
  answerer.on_reply([&](const question::Reply& reply) { answer = limited(reply.answer, limit); });
  std::optional<golden::Maker> maker;  // of the scene's proofs
  for (StreamItem item; stream.next(item); output.flush_if_due()) {
    if (item.kind == StreamItem::Kind::scene) {
      maker.reset();
      continue;
    }
    if (item.kind != StreamItem::Kind::query) {
      append_answer_line(output.buffer(), item.id, Answer::error(item.message), 0);
      continue;
    }
    const Scene& scene = *stream.scene();
    if (!maker) maker.emplace(scene);
    if (!answerer.is_in(scene)) answerer.set_scene(scene);
    if (!answerer.takes_limits()) limit = item.max_time;
    answerer.ask_until(item.id, item.query, item.max_time);
    answerer.drain();
    const std::optional<golden::Proved> proved = proved_by(*maker, item.query);
    if (proved && same_answer(answer, proved->exact)) {
      append_proved_line(output.buffer(), item.id, *proved, scene);
    } else {
      ++unproved;
      append_answer_line(output.buffer(), item.id, answer, scene);
    }
  }
  answerer.finish();
  output.flush();
  if (unproved > 0) say("{} of the answers can't be proved: they have no certificate", unproved);
  if (answerer.failed()) return kFailed;
  if (stream.had_bad_input()) return kBadInput;
  return unproved > 0 ? kDisagreement : kDone;
}

int write_records(GivenQueries& queries, const std::string& arguments) {
  golden::Header header{.name = "queries",
                        .description = "Given queries, answered exactly.",
                        .generator = "lorentz first-hit --prove --records" + arguments,
                        .version = LORENTZ_VERSION,
                        .tags = {{"given", "a query that was given"}}};
  std::size_t others = 0;
  const golden::GivenQuestions given = questions_in(queries, std::move(header), others);
  const auto [text, counts] = made_set(given);
  print_data(text);
  say_unproved(counts);
  return queries.had_bad_input() ? kBadInput : counts.left_out > 0 ? kDisagreement : kDone;
}

}  // namespace lorentz::cli
