// Private to cli/first_hit*.cpp: columns, and answers with proofs.
#pragma once

#include <optional>
#include <string>

#include <lorentz/scene.hpp>
#include "cli/command.hpp"
#include "cli/given_queries.hpp"
#include "question/engines.hpp"
#include "report/files/unknown_keys.hpp"

namespace lorentz::cli {

/// --format csv|npy: queries in columns to answers in columns.
struct ColumnOrder {
  enum class Format { csv, npy };
  Format format{};
  std::string queries;
  question::EngineInfo engine;
  Scene scene{};
  std::optional<double> max_time{};
  int jobs = 1;
  bool strict = false;
};

/// Answers all rows on standard output. Returns an ExitStatus. Throws InputError, FileError.
int answer_columns(const ColumnOrder& order);

/// --prove: adds `time_decimal` and `certificate` to each answer that is exactly right. Other answers are
/// written without them and counted. Returns the exit status.
int answer_with_proofs(QueryStream& stream, question::Answerer& answerer);

/// --records: writes a golden set of the exact answers. `arguments` follow in its generator. Returns the exit
/// status.
int write_records(GivenQueries& queries, const std::string& arguments);

}  // namespace lorentz::cli
