// Makes sets: many records on several threads, in an order that does not depend on the threads.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "judge/golden/sets.hpp"

namespace lorentz::golden {

/// Given questions, each only once.
struct GivenQuestions {
  explicit GivenQuestions(Header its_header) : header(std::move(its_header)) {}

  Header header;  ///< of the set that is made from them
  std::vector<SetQuestion> questions;
  bool look = false;  ///< look for tags_seen, which are added

  /// Adds the question and returns true; if it exists already, adds only its new tags and returns false.
  bool add(SetQuestion question);

 private:
  std::map<std::string, std::size_t> by_id_;
};

struct Order {
  const Set* set = nullptr;
  std::uint64_t count = 0, seed = 0;
  std::uint64_t jobs = 1;
  const GivenQuestions* given = nullptr;  ///< used instead of a set
};

/// Counts of the records made for an order.
struct RecordCounts {
  std::uint64_t records = 0, walked = 0, hits = 0, insides = 0, nevers = 0, errors = 0;
  std::uint64_t needing_judge = 0;
  std::uint64_t left_out = 0;  ///< given questions whose proof needs more steps than a checker allows
};

/// Takes a part of a set's text.
using Write = std::function<void(std::string_view)>;

/// Called from time to time with the number of records made.
using OnProgress = std::function<void(std::uint64_t)>;

/// The header of the set of an order.
Header header_of(const Order& order);

/// Makes the set and passes its text to `write`, line by line, from the header on. A set takes constant
/// memory besides 8 bytes per record (no id comes twice); given questions and their records are all in
/// memory. Throws std::logic_error if the opinions about an answer differ.
RecordCounts produce(const Order& order, const Write& write, const OnProgress& progress);

}  // namespace lorentz::golden
