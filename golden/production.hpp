// Makes sets: many records on several threads, in an order that does not depend on these; and writes them to
// a file in such a way that the work can be stopped at any moment and gone on with.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "golden/sets.hpp"

namespace lorentz::golden {

struct Order {
  const Set* set = nullptr;
  std::uint64_t count = 0, seed = 0;
  std::uint64_t jobs = 1;
};

/// What was made of an order.
struct RecordCounts {
  std::uint64_t records = 0, walked = 0, hits = 0, insides = 0, nevers = 0, errors = 0;
};

/// Called now and then with the number of records made.
using OnProgress = std::function<void(std::uint64_t)>;

/// The header of an order's set.
Header header_of(const Order& order);

/// Makes the set and hands its text to `write`, line by line, from the header on. Constant memory, but for 8
/// bytes a record (no id comes twice). Throws std::logic_error if the opinions about an answer differ.
RecordCounts produce(const Order& order, const std::function<void(std::string_view)>& write,
                     const OnProgress& progress);

/// Makes the set in a file. It grows as PATH.part beside a note of how far it is, and gets its name when it
/// is complete; a part of the same order that is there already, from a run that was killed, is gone on with.
/// Throws FileError.
RecordCounts produce_file(const Order& order, const std::string& path, const OnProgress& progress);

}  // namespace lorentz::golden
