// lorentz first-hit --format csv|npy: queries in columns to answers in columns.
#pragma once

#include <optional>
#include <string>

#include <lorentz/scene.hpp>
#include "files/unknown_keys.hpp"
#include "question/engines.hpp"

namespace lorentz::cli {

/// The options of the command line.
struct ColumnOrder {
  enum class Format { csv, npy };
  Format format{};
  std::string queries;
  question::EngineInfo engine;
  Scene scene{};
  std::optional<double> max_time{};
  int jobs = 1;
  UnknownKeys unknown = UnknownKeys::warned;
};

/// Answers all rows on standard output. Returns an ExitStatus. Throws InputError, FileError.
int answer_columns(const ColumnOrder& order);

}  // namespace lorentz::cli
