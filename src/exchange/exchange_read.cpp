// Lines of query and answer streams.
#include <algorithm>
#include <cmath>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_line.hpp"

namespace lorentz {
namespace {

// The content of a line of a query stream, before it is compared with the scene.
struct QueryFields {
  NumbersRead x, v;
  std::optional<FromRead> from;
  std::optional<SceneNode> scene;
  bool golden = false;
  bool has_x = false, has_v = false;
};

void read_query_field(std::string_view key, json::Value value, Id& id, QueryFields& fields,
                      const OnUnknownKey& on_unknown_key) {
  if (key == "x") {
    fields.has_x = true;
    fields.x = read_numbers(value, "x");
  } else if (key == "v") {
    fields.has_v = true;
    fields.v = read_numbers(value, "v");
  } else if (key == "id") {
    id = read_id(value);
  } else if (key == "from") {
    fields.from = read_from(value, on_unknown_key);
  } else if (key == "scene") {
    fields.scene = read_node(value);
  } else {
    fields.golden |= key == "golden";
    skip(value);
    if (on_unknown_key && !is_beside_query(key)) on_unknown_key(std::string(key));
  }
}

Query query_from(QueryFields& fields, const Scene& scene) {
  if (!fields.has_x) throw InputError("x is missing");
  if (!fields.has_v) throw InputError("v is missing");
  check_dimension("x", fields.x.count, scene.dimension);
  check_dimension("v", fields.v.count, scene.dimension);
  Query query{fields.x.values, fields.v.values, {}};
  if (fields.from) {
    check_cell(*fields.from, scene);
    query.from = std::move(fields.from->obstacle);
  }
  if (auto flaw = flaw_of(query, scene)) throw InputError(*flaw);
  return query;
}

}  // namespace

ExchangeReader::ExchangeReader() : impl_(std::make_unique<Impl>()) {}
ExchangeReader::~ExchangeReader() = default;

void ExchangeReader::on_unknown_key(OnUnknownKey listener) {
  impl_->on_unknown_key = std::move(listener);
}

void ExchangeReader::Impl::read_query(const LineReader::Line& line, const Scene* scene, StreamItem& item) {
  QueryFields fields;
  std::string flaw;  // the first; reading goes on, because the id may follow
  read_members(line, item.id, flaw, [&](std::string_view key, json::Value value) {
    item.bad_scene |= key == "scene";
    read_query_field(key, value, item.id, fields, on_unknown_key);
  });
  if (!flaw.empty()) throw InputError(flaw);
  if (fields.scene) {
    if (on_unknown_key && (fields.has_x || fields.has_v || fields.from))
      on_unknown_key("a query in the line of a scene");
    item.scene = scene_from(*fields.scene, on_unknown_key);
    item.bad_scene = false;
    item.kind = StreamItem::Kind::scene;
  } else if (!fields.golden || fields.has_x || fields.has_v) {
    item.no_scene = scene == nullptr;
    if (item.no_scene) throw InputError("no scene before this query");
    item.query = query_from(fields, *scene);
    item.kind = StreamItem::Kind::query;
  }
}

void ExchangeReader::read_query_line(const LineReader::Line& line, const Scene* scene, StreamItem& item) {
  impl_->read_item(line, item, [&] { impl_->read_query(line, scene, item); });
}

namespace {

Outcome read_outcome(std::string_view name) {
  if (const auto outcome = outcome_named(name)) return *outcome;
  throw InputError("outcome: " + json_quoted(name) +
                   " is not one of hit, never, inside, later, undecided, error");
}

double read_time(json::Value value) {
  return read_number_or_infinity(value, "time");
}

struct AnswerFields {
  bool outcome = false, lattice = false, atom = false, cell = false, golden = false;
  std::size_t components = 0;  // of the cell
};

// The keys that --digits and --detail add to an answer, and that of a header.
bool is_beside_answer(std::string_view key) {
  return key == "golden" || key == "time_decimal" || key == "point" || key == "normal" ||
         key == "impact_parameter";
}

void read_answer_field(std::string_view key, json::Value value, Id& id, Answer& answer, AnswerFields& has,
                       const OnUnknownKey& on_unknown_key) {
  if (key == "id") {
    id = read_id(value);
  } else if (key == "outcome") {
    answer.outcome = read_outcome(value.text());
    has.outcome = true;
  } else if (key == "lattice") {
    answer.obstacle.lattice = read_index(value, "lattice");
    has.lattice = true;
  } else if (key == "atom") {
    answer.obstacle.atom = read_index(value, "atom");
    has.atom = true;
  } else if (key == "cell") {
    CellRead cell = read_cell(value);
    answer.obstacle.cell = std::move(cell.cell);
    has.components = cell.count, has.cell = true;
  } else if (key == "time") {
    answer.time = read_time(value);
  } else if (key == "message") {
    answer.message = value.text();
  } else if (key == "reason") {
    answer.unsupported = value.text() == "unsupported";
  } else {
    has.golden |= key == "golden";
    skip(value);
    if (on_unknown_key && !is_beside_answer(key)) on_unknown_key(std::string(key));
  }
}

}  // namespace

bool read_answer(json::Object object, Id& id, Answer& answer, std::size_t& components,
                 const OnUnknownKey& on_unknown_key, std::set<std::string>* keys, double* ulps) {
  AnswerFields has;
  json::each_member(object, [&](std::string_view key, json::Value value) {
    if (keys) keys->emplace(key);
    if (ulps && key == "ulps")
      *ulps = read_number(value, "ulps");
    else
      read_answer_field(key, value, id, answer, has, on_unknown_key);
  });
  if (has.golden && !has.outcome) return false;
  if (!has.outcome) throw InputError("outcome is missing");
  const bool names_obstacle = answer.outcome == Outcome::hit || answer.outcome == Outcome::inside;
  if (names_obstacle && !(has.lattice && has.atom && has.cell))
    throw InputError("needs lattice, atom and cell");
  components = has.components;
  return true;
}

bool ExchangeReader::read_answer_line(const LineReader::Line& line, Id& id, Answer& answer,
                                      std::size_t& components) {
  if (is_blank(line)) return false;
  answer = Answer{};
  id = "null";
  components = 0;
  try {
    const bool is_answer =
        read_answer(impl_->json_line.open(line), id, answer, components, impl_->on_unknown_key);
    impl_->json_line.close();
    return is_answer;
  } catch (const json::Error& error) {
    throw InputError(not_json(line, error.what()));
  } catch (const NotJson& error) {
    throw InputError(not_json(line, error.what()));
  }
}

}  // namespace lorentz
