// Makes sets: many records on several threads, in an order that does not depend on these; stopped at any moment,
// the work can be gone on with.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "golden/sets.hpp"
#include "runs/piece_store.hpp"

namespace lorentz::golden {

/// Questions that were given, each once.
struct GivenQuestions {
  explicit GivenQuestions(Header its_header) : header(std::move(its_header)) {}

  Header header;  ///< of the set that is to be made of them
  std::vector<SetQuestion> questions;
  bool look = false;  ///< for tags_seen, which are added

  /// Adds it, or to the same question its tags that are new; returns whether it was new.
  bool add(SetQuestion question);

 private:
  std::map<std::string, std::size_t> by_id_;
};

struct Order {
  const Set* set = nullptr;
  std::uint64_t count = 0, seed = 0;
  std::uint64_t jobs = 1;
  const GivenQuestions* given = nullptr;  ///< in place of a set
};

/// What was made of an order.
struct RecordCounts {
  std::uint64_t records = 0, walked = 0, hits = 0, insides = 0, nevers = 0, errors = 0;
  std::uint64_t needing_judge = 0;
  std::uint64_t left_out = 0;  ///< given questions whose proof takes more steps than any checker goes
};

/// Called now and then with the number of records made.
using OnProgress = std::function<void(std::uint64_t)>;

/// The header of an order's set.
Header header_of(const Order& order);

/// What a store of its batches is begun with.
runs::Plan plan_of(const Order& order);

/// Makes the set and hands its text to `write`, line by line, from the header on. A set takes constant memory, but
/// for 8 bytes a record (no id comes twice); given questions and their records are all in memory. Batches that
/// `kept` has, a store of plan_of(order), are not made again, and the others are added. Throws std::logic_error if
/// the opinions about an answer differ.
RecordCounts produce(const Order& order, const std::function<void(std::string_view)>& write,
                     const OnProgress& progress, runs::PieceStore* kept = nullptr);

}  // namespace lorentz::golden
