#include <charconv>
#include <cmath>

#include <lorentz/exchange.hpp>
#include "src/exchange/columns_csv.hpp"

namespace lorentz {
namespace {

void append_int(std::string& out, std::int64_t n) {
  char text[24];
  out.append(text, std::to_chars(text, text + sizeof text, n).ptr);
}

void append_obstacle_cells(std::string& out, const AnswerRows& answers, std::size_t i, const Cell* large,
                           const Components& components) {
  append_int(out, answers.lattice[i]);
  out += ',';
  append_int(out, answers.atom[i]);
  for (int k = 0; k < answers.dimension; ++k) {
    out += ',';
    if (k >= components.of_cells(answers.lattice[i])) continue;
    if (large)
      out += (*large)[k].decimal();
    else
      append_int(out, answers.cell(k)[i]);
  }
  out += ',';
}

void append_time(std::string& out, double time) {
  if (std::isnan(time)) return;
  if (std::isinf(time))
    out += time > 0 ? "inf" : "-inf";
  else
    append_number(out, time);
}

}  // namespace

void append_csv_query_names(std::string& out, int dimension, bool with_from) {
  const auto append = [&](const std::string& name) {
    for (int k = 1; k <= dimension; ++k) out += name + std::to_string(k) + ',';
  };
  append("x"), append("v");
  if (with_from) {
    out += "from_lattice,from_atom,";
    append("from_cell");
  }
  out.back() = '\n';
}

void append_csv_queries(std::string& out, const QueryRows& queries, const Components& components) {
  const int dimension = components.of_vectors();
  for (std::size_t i = 0; i < queries.count; ++i) {
    for (const auto* vector : {&queries.x, &queries.v})
      for (int k = 0; k < dimension; ++k) {
        append_number(out, (*vector)[k][i]);
        out += ',';
      }
    if (!queries.from_lattice.empty()) {
      append_int(out, queries.from_lattice[i]);
      out += ',';
      append_int(out, queries.from_atom[i]);
      for (int k = 0; k < dimension; ++k) {
        out += ',';
        if (k < components.of_cells(queries.from_lattice[i])) append_int(out, queries.from_cell[k][i]);
      }
      out += ',';
    }
    out.back() = '\n';
  }
}

void append_csv_names(std::string& out, int dimension, bool with_ids) {
  for (const std::string& name : csv_answer_columns(dimension))
    if (with_ids || name != "id") out += name + ',';
  out.back() = '\n';
}

void append_csv_answers(std::string& out, const QueryRows& queries, const AnswerRows& answers,
                        const Components& components, bool with_ids) {
  std::size_t next_large = 0;
  for (std::size_t i = 0; i < answers.count; ++i) {
    if (with_ids) {
      out += csv_field(queries.id[i]);
      out += ',';
    }
    const Outcome outcome = answers.outcome[i];
    out += name_of(outcome);
    out += ',';
    const bool is_large =
        next_large < answers.large_cells.size() && answers.large_cells[next_large].first == i;
    if (outcome == Outcome::hit || outcome == Outcome::inside)
      append_obstacle_cells(out, answers, i, is_large ? &answers.large_cells[next_large].second : nullptr,
                            components);
    else
      out.append(static_cast<std::size_t>(answers.dimension) + 2, ',');
    next_large += is_large;
    append_time(out, answers.time[i]);
    out += '\n';
  }
}

}  // namespace lorentz
