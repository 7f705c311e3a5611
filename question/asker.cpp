// <lorentz/lorentz.h>: what C asks, by the engines of this program.
#include <lorentz/lorentz.h>

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include <lorentz/environment.hpp>
#include <lorentz/scene_check.hpp>
#include "question/engines.hpp"

using namespace lorentz;

struct lorentz_asker {
  std::optional<question::SceneEngine> engine = {};  ///< empty if lorentz_open refused
  int dimension = 0;
  std::string why = {};
  QueryRows queries = {};
  AnswerRows answers = {};
};

namespace {

// Rows that are answered together: their columns stay in the cache.
constexpr std::size_t kTogether = 4096;

// By Outcome; an error that is "unsupported" has its own.
constexpr std::int32_t kCodes[] = {LORENTZ_HIT,   LORENTZ_NEVER,     LORENTZ_INSIDE,
                                   LORENTZ_LATER, LORENTZ_UNDECIDED, LORENTZ_INVALID};

// Does the work, and returns a status. `why` is empty before, and says what was wrong.
template <class Work>
std::int32_t status_of(std::string& why, const Work& work) noexcept try {
  try {
    work();
    return why.empty() ? LORENTZ_DONE : LORENTZ_BAD_ROWS;
  } catch (const InputError& error) {
    why = error.what();
    return LORENTZ_REFUSED;
  } catch (const std::exception& error) {
    why = error.what();
    return LORENTZ_FAILED;
  }
} catch (...) {
  why = "out of memory";  // so short that it needs none
  return LORENTZ_FAILED;
}

void open(lorentz_asker& asker, const char* text, const char* name) {
  if (!text) throw InputError("scene: is NULL; it needs the text of a scene");
  const question::EngineInfo* engine = question::own_engine(name ? name : "certified-batch");
  if (!engine)
    throw InputError(fmt::format("engine: {} is not one of {}", json_quoted(name),
                                 fmt::join(question::own_names(), ", ")));
  const Scene scene = read_scene_text(text, [](const std::string& key) {
    throw InputError(fmt::format("the key {} is not known", json_quoted(key)));
  });
  if (const auto flaw = oracle::dependence_in(scene)) throw InputError(*flaw);
  asker.dimension = scene.dimension;
  asker.engine = engine->in(scene);
}

QueryColumns columns_of(const lorentz_queries& queries, const double* max_time, int dimension) {
  const auto rows = [&](const auto* column) {
    return std::span(column, column && queries.count > 0 ? static_cast<std::size_t>(queries.count) : 0);
  };
  QueryColumns columns;
  for (int k = 0; k < dimension; ++k) {
    columns.x[k] = rows(queries.x[k]), columns.v[k] = rows(queries.v[k]);
    columns.from_cell[k] = rows(queries.from_cell[k]);
  }
  columns.max_time = rows(max_time);
  columns.from_lattice = rows(queries.from_lattice), columns.from_atom = rows(queries.from_atom);
  return columns;
}

void check(const lorentz_queries& queries, const QueryColumns& columns, const lorentz_answers& answers) {
  if (queries.count < 0) throw InputError("count: must not be below 0");
  if (static_cast<std::int64_t>(columns.size()) != queries.count)
    throw InputError("the column x[0] is missing");
  if (queries.count > 0 && !answers.outcome) throw InputError("the column outcome is missing");
  for (const ArithmeticCheck& check : arithmetic_checks())
    if (!check.fit)
      throw InputError(
          fmt::format("the arithmetic of this thread is unfit: {}: {}, not {}; link without -ffast-math",
                      check.name, check.found, check.expected));
}

void ask(lorentz_asker& asker, const QueryColumns& some) {
  const auto copy = [](const auto& column, auto& to) { to.assign(column.begin(), column.end()); };
  QueryRows& rows = asker.queries;
  rows.count = some.size();
  for (int k = 0; k < 3; ++k)
    copy(some.x[k], rows.x[k]), copy(some.v[k], rows.v[k]), copy(some.from_cell[k], rows.from_cell[k]);
  copy(some.max_time, rows.max_time);
  copy(some.from_lattice, rows.from_lattice), copy(some.from_atom, rows.from_atom);
  asker.answers.resize(rows.count, asker.dimension);
  if (const auto flaw = flaw_of(some, {.outcome = asker.answers.outcome}, asker.dimension))
    throw InputError(*flaw);
  asker.engine->answer(rows, asker.answers);
}

void tell(lorentz_asker& asker, const lorentz_answers& all, std::size_t first) {
  const AnswerRows& answers = asker.answers;
  const auto copy = [&](const auto* column, auto* to) {
    if (to) std::copy_n(column, answers.count, to + first);
  };
  for (std::size_t i = 0; i < answers.count; ++i)
    all.outcome[first + i] = kCodes[static_cast<std::size_t>(answers.outcome[i])];
  copy(answers.lattice.data(), all.lattice), copy(answers.atom.data(), all.atom);
  for (int k = 0; k < asker.dimension; ++k) copy(answers.cell(k), all.cell[k]);
  copy(answers.time.data(), all.time);
  for (const auto& [row, cell] : answers.large_cells) {
    all.outcome[first + row] = LORENTZ_FAR;
    for (int k = 0; k < asker.dimension; ++k)
      if (all.cell[k]) all.cell[k][first + row] = 0;
  }
  for (const RowFlaw& reason : answers.reasons)
    if (reason.unsupported)
      all.outcome[first + reason.row] = LORENTZ_UNSUPPORTED;
    else if (asker.why.empty())
      asker.why = fmt::format("row {}: {}", first + reason.row, reason.message);
}

}  // namespace

std::int32_t lorentz_interface() {
  return LORENTZ_INTERFACE;
}

lorentz_asker* lorentz_open(const char* scene, const char* engine) {
  lorentz_asker* asker = new (std::nothrow) lorentz_asker;
  if (asker) status_of(asker->why, [&] { open(*asker, scene, engine); });
  return asker;
}

std::int32_t lorentz_first_hits(lorentz_asker* asker, const lorentz_queries* queries, const double* max_time,
                                const lorentz_answers* answers) {
  if (!asker) return LORENTZ_FAILED;
  if (!asker->engine) return LORENTZ_REFUSED;  // still for the reason that lorentz_open had
  asker->why.clear();
  return status_of(asker->why, [&] {
    if (!queries || !answers) throw InputError("queries and answers: must not be NULL");
    const QueryColumns all = columns_of(*queries, max_time, asker->dimension);
    check(*queries, all, *answers);
    for (std::size_t first = 0; first < all.size(); first += kTogether) {
      ask(*asker, all.part(first, std::min(kTogether, all.size() - first)));
      tell(*asker, *answers, first);
    }
  });
}

const char* lorentz_why(const lorentz_asker* asker) {
  if (!asker) return "out of memory";
  return asker->why.empty() ? nullptr : asker->why.c_str();
}

void lorentz_close(lorentz_asker* asker) {
  delete asker;
}
