// Lines of query and answer streams.

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_line.hpp"
#include "src/exchange/exchange_write.hpp"

namespace lorentz {
namespace {

// The content of a line of a query stream.
struct QueryFields : LineFields {
  static constexpr const char* kName = "query";
  std::optional<NumbersRead> x, v;
  double max_time = std::numeric_limits<double>::infinity();

  void read(std::string_view key, json::Value value, Id& id, const OnUnknownKey& on_unknown_key) {
    if (key == "x")
      x = read_numbers(value, "x");
    else if (key == "v")
      v = read_numbers(value, "v");
    else if (key == "max_time")
      max_time = read_number_or_infinity(value, "max_time");
    else
      LineFields::read(key, value, id, on_unknown_key);
  }

  void set(StreamItem& item, const Scene& scene) {
    if (!x) throw InputError("x is missing");
    if (!v) throw InputError("v is missing");
    check_dimension("x", x->count, scene.dimension);
    check_dimension("v", v->count, scene.dimension);
    Query query{x->values, v->values, {}};
    if (from) {
      check_cell(*from, scene);
      query.from = std::move(from->obstacle);
    }
    if (auto flaw = flaw_of(query, scene)) throw InputError(*flaw);
    if (!(max_time > 0)) throw InputError("max_time: must be above zero");
    item.query = std::move(query);
    item.max_time = max_time;
  }
};

}  // namespace

ExchangeReader::ExchangeReader() : impl_(std::make_unique<Impl>()) {}
ExchangeReader::~ExchangeReader() = default;

void ExchangeReader::on_unknown_key(OnUnknownKey listener) {
  impl_->on_unknown_key = std::move(listener);
}

void ExchangeReader::read_query_line(const LineReader::Line& line, const Scene* scene, StreamItem& item) {
  impl_->read_item<QueryFields>(line, scene, item);
}

namespace {

Outcome read_outcome(std::string_view name) {
  if (const auto outcome = outcome_named(name)) return *outcome;
  throw InputError("outcome: " + json_quoted(name) +
                   " is not one of hit, never, inside, later, undecided, error");
}

// A text; an empty one for null.
std::string_view read_text(json::Value value, std::string_view key) {
  if (value.type() == json::Type::string) return value.text();
  if (value.type() != json::Type::null) throw InputError(std::string(key) + ": needs a text");
  skip(value);
  return {};
}

struct AnswerFields {
  bool outcome = false, golden = false;
  ObstacleRead obstacle;
};

// The keys that --digits and --detail add to an answer, and that of a header.
bool is_beside_answer(std::string_view key) {
  return key == "golden" || key == "time_decimal" || key == "point" || key == "normal" ||
         key == "impact_parameter" || key == "exit_point" || key == "exit_normal";
}

void read_answer_field(std::string_view key, json::Value value, Id& id, Answer& answer, AnswerFields& has,
                       const OnUnknownKey& on_unknown_key) {
  if (key == "id") {
    id = read_id(value);
  } else if (key == "outcome") {
    answer.outcome = read_outcome(read_text(value, key));
    has.outcome = true;
  } else if (key == "time") {
    answer.time = read_number_or_infinity(value, "time");
  } else if (key == "exit_time") {
    answer.exit_time = read_number_or_infinity(value, "exit_time");
  } else if (key == "message") {
    answer.message = read_text(value, key);
  } else if (key == "reason") {
    answer.unsupported = read_text(value, key) == "unsupported";
  } else if (!has.obstacle.read(key, value)) {
    has.golden |= key == "golden";
    skip(value);
    if (on_unknown_key && !is_beside_answer(key)) on_unknown_key(std::string(key));
  }
}

}  // namespace

bool read_answer(json::Value object, Id& id, Answer& answer, std::size_t& components,
                 const OnUnknownKey& on_unknown_key, std::set<std::string>* keys, double* ulps) {
  AnswerFields has;
  json::each_member(object, [&](std::string_view key, json::Value value) {
    if (keys) keys->emplace(key);
    if (keys && (key == "message" || key == "reason") && value.type() == json::Type::null)
      throw InputError(std::string(key) + ": needs a text, not null, in a record");
    if (ulps && key == "ulps")
      *ulps = read_number(value, "ulps");
    else
      read_answer_field(key, value, id, answer, has, on_unknown_key);
  });
  answer.obstacle = std::move(has.obstacle.obstacle);
  if (has.golden && !has.outcome) return false;
  if (!has.outcome) throw InputError("outcome is missing");
  const bool names_obstacle = answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
  if (names_obstacle && !has.obstacle.is_whole()) throw InputError("needs lattice, atom and cell");
  components = has.obstacle.components;
  return true;
}

bool ExchangeReader::read_answer_line(const LineReader::Line& line, Id& id, Answer& answer,
                                      std::size_t& components) {
  if (is_blank(line)) return false;
  answer = Answer{};
  id = "null";
  components = 0;
  try {
    const bool is_answer = read_answer(impl_->open(line), id, answer, components, impl_->on_unknown_key);
    impl_->close();
    return is_answer;
  } catch (const NotJson& error) {
    throw InputError(not_json(line, error.what()));
  }
}

}  // namespace lorentz
