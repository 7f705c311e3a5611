// Queries and answers as arrays of NumPy (docs/formats.md). Private to the formats and the program.
#pragma once

#include "src/exchange/columns.hpp"

namespace lorentz {

/// Reads queries: an array of numbers with one row per query, or an array of fields x, v, .. Opens the file, or
/// standard input for "-", and reads its header. Throws FileError, or InputError if it is not an array of queries
/// in this number of dimensions.
std::unique_ptr<ColumnReader> read_npy_queries(const std::string& path, int dimension);

/// The same for answers, as append_npy_answers writes them; `stage` and `time_is_rounded` may be missing.
std::unique_ptr<AnswerReader> read_npy_answers(const std::string& path, int dimension);

/// The header of an array of `count` queries without limits: an array of numbers, or of fields if the queries
/// leave obstacles. And its rows.
std::string npy_query_header(std::uint64_t count, int dimension, bool with_from);
void append_npy_queries(std::string& out, const QueryRows& queries, int dimension);

/// The header of an array of `count` answers, and its rows, without large cells.
std::string npy_answer_header(std::uint64_t count, int dimension);
void append_npy_answers(std::string& out, const AnswerRows& answers);

}  // namespace lorentz
