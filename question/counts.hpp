// What an answer counts as: one enum, one table of names, one way to add up and to write.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string>
#include <tuple>
#include <vector>

#include <lorentz/verdict.hpp>
#include "src/exchange/json_writer.hpp"

namespace lorentz::question {

/// Every answer counts as one of the first seven, which are those of oracle::Verdict. The others count besides.
enum class Count : std::size_t {
  agree,
  ill_posed,
  wrong,
  undecided,
  unsupported,
  error,
  missing,
  wrong_time,      ///< of those that agree: the time is beyond its tolerance
  other_quantity,  ///< of the wrong times: no rounding explains them
  nonsense,        ///< an invalid question that was answered as if it were valid; it counts as nothing else
  too_slow         ///< an external engine was silent for longer than it may be; it counts as nothing else
};

/// Who counts what.
enum class Counted : unsigned { examinations = 1, judge = 2, campaigns = 4, curves = 8, no_column = 16 };

struct CountName {
  Count count;
  const char* key;             ///< in JSON
  std::string_view words;      ///< a column's title, and after a number: "3 ill-posed"
  std::string_view many = {};  ///< after a number above 1, if that is not the same: "2 errors"
  unsigned counted = 15;       ///< by these, a sum of Counted; no_column: only in JSON and in sentences

  constexpr bool is_counted(Counted by) const { return counted & static_cast<unsigned>(by); }
};

/// In the order of reports.
inline constexpr std::array kCountNames{
    CountName{Count::agree, "agree", "agree"},
    CountName{Count::ill_posed, "ill_posed", "ill-posed", {}, 1 + 2 + 8},
    CountName{Count::wrong, "wrong", "wrong"},
    CountName{Count::wrong_time, "wrong_time", "wrong time", "wrong times", 7},
    CountName{Count::other_quantity, "other_quantity", "of another quantity", {}, 3 + 16},
    CountName{Count::undecided, "undecided", "undecided"},
    CountName{Count::unsupported, "unsupported", "unsupported", {}, 7},
    CountName{Count::error, "error", "error", "errors", 7},
    CountName{Count::missing, "missing", "missing", {}, 1 + 2},
    CountName{Count::nonsense, "nonsense", "nonsense", {}, 2},
    CountName{Count::too_slow, "too_slow", "too slow", {}, 2 + 16}};

const CountName& name_of(Count count);

class Counts {
 public:
  std::size_t& operator[](Count count) { return number_[static_cast<std::size_t>(count)]; }
  std::size_t operator[](Count count) const { return number_[static_cast<std::size_t>(count)]; }

  void add(const oracle::Judgement& judgement);
  Counts& operator+=(const Counts& other);

  std::size_t sum(std::initializer_list<Count> some) const;
  std::size_t total() const;  ///< of all verdicts
  /// Those that name an outcome.
  std::size_t answers() const { return sum({Count::agree, Count::ill_posed, Count::wrong}); }

  friend bool operator==(const Counts&, const Counts&) = default;
  friend auto members_of(Counts& self) { return std::tie(self.number_); }

 private:
  std::array<std::size_t, kCountNames.size()> number_{};
};

/// The names of what is counted by these, in the order of reports.
std::vector<CountName> names_counted(Counted by);

/// Members of these names; null if nothing was judged.
void add_counts(json::Members& object, const Counts& counts, Counted by, bool judged = true);

/// The columns of a table between others: titles, and cells, each as `text` has it.
std::vector<std::string> titles_counted(Counted by, std::vector<std::string> before,
                                        const std::vector<std::string>& after);
using CellText = std::function<std::string(Count, std::size_t number)>;
std::vector<std::string> cells_counted(const Counts& counts, Counted by, std::vector<std::string> before,
                                       const std::vector<std::string>& after, const CellText& text);

/// The number, or "-" for 0, which makes other numbers stand out.
std::string dash_for_none(Count count, std::size_t number);

/// "3 ill-posed, 1 error": those of these that are not 0; empty if all are.
std::string counted_text(const Counts& counts, std::initializer_list<Count> some);

}  // namespace lorentz::question
