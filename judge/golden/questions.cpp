#include "judge/golden/questions.hpp"

namespace lorentz::golden {

question::Source questions_of(Reader& reader, const Claim& claim) {
  return [&reader, claim, scene = std::size_t{0},
          place = std::shared_ptr<question::Place>()]() mutable -> std::optional<question::Question> {
    ReadRecord read;
    if (!reader.next(read)) return std::nullopt;
    if (scene != reader.scene_number())
      place = std::make_shared<question::Place>(reader.scene(), question::Truth::oracle, claim);
    scene = reader.scene_number();
    Record& record = read.record;
    if (claim.inside != StartInside::inside && record.expect.outcome == Outcome::inside && read.query)
      record.expect = place->exact(*read.query);
    return question::Question{
        .place = place,
        .query = read.query.value_or(Query()),
        .exact = std::move(record.expect),
        .where = record.id,
        .text = read.query ? "" : std::move(record.question),
        .id = json_quoted(record.id),
        .tags = std::move(record.tags),
        .margin = claim.precision == reader.header().precision ? record.margin : std::nullopt};
  };
}

}  // namespace lorentz::golden
