#include "fuzz/examine/answerers.hpp"

#include <utility>

#include "question/examine.hpp"

namespace lorentz::fuzz {

using question::Answerer;
using question::Reply;

question::MakeAnswerer answerer_maker(const question::EngineInfo& engine,
                                      const question::AnswererOptions& options) {
  return [engine, options](const std::function<bool()>& enough) {
    question::AnswererOptions its = options;
    its.enough = enough;
    its.in_campaign = true;
    return engine.answerer(its);
  };
}

std::vector<Reply> replies_to(const question::Source& source, Answerer& answerer) {
  std::vector<Reply> replies;
  std::vector<std::pair<std::size_t, question::Question>> not_asked;
  question::ask_all(source, answerer, [&](const question::Question& question, Reply& reply) {
    if (!reply.was_asked()) not_asked.emplace_back(replies.size(), question);
    replies.push_back(std::move(reply));
  });
  for (const auto& [i, question] : not_asked) {
    if (answerer.is_hopeless()) break;
    answerer.try_again();
    question::ask_all(question::all_of({&question, 1}), answerer,
                      [&, i = i](const question::Question&, Reply& reply) { replies[i] = std::move(reply); });
    if (!replies[i].was_asked()) break;  // the time is over
  }
  return replies;
}

}  // namespace lorentz::fuzz
