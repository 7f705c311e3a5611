#include "cli/first_hit.hpp"

#include <lorentz/exchange.hpp>
#include "cli/output.hpp"
#include "report/files/messages.hpp"
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/columns_npy.hpp"

namespace lorentz::cli {
namespace {

constexpr long kMost = 20;  // complaints of one kind

// Reports why rows are errors.
class Complaints {
 public:
  void operator()(const std::string& name, const QueryRows& queries, const AnswerRows& answers) {
    for (const RowFlaw& reason : answers.reasons) {
      const std::string text = place(name, queries, reason.row) + ": " + reason.message;
      if (reason.unsupported ? ++beyond_ == 1 : ++bad_ <= kMost) say("{}", text);
    }
  }
  void finish(const std::string& name) const {
    if (bad_ > kMost) say("{}: {} more bad rows", name, bad_ - kMost);
    if (beyond_ > 1)
      say("{}: {} more rows are good, and have the outcome error nevertheless", name, beyond_ - 1);
  }
  bool had_bad_input() const { return bad_ > 0; }

 private:
  static std::string place(const std::string& name, const QueryRows& queries, std::size_t row) {
    if (!queries.lines.empty()) return fmt::format("{}:{}", name, queries.lines[row]);
    return fmt::format("{}: row {}", name, queries.first + row);
  }

  long bad_ = 0, beyond_ = 0;
};

// The CSV format: its reader and the writer of its answers.
class Csv {
 public:
  Csv(const ColumnOrder& order, std::string& out)
      : reader_(order.queries, order.scene,
                unknown_columns(csv_query_columns(order.scene.dimension), order.strict)),
        components_(order.scene),
        out_(out) {
    append_csv_names(out_, order.scene.dimension, reader_.has_ids());
  }
  ColumnReader& reader() { return reader_; }
  void write(const QueryRows& queries, AnswerRows& answers) {
    append_csv_answers(out_, queries, answers, components_, reader_.has_ids());
  }
  void finish() {}

 private:
  CsvQueryReader reader_;
  const Components components_;
  std::string& out_;
};

class Npy {
 public:
  Npy(const ColumnOrder& order, std::string& out)
      : reader_(read_npy_queries(order.queries, order.scene.dimension)), out_(out) {
    out_ += npy_answer_header(reader_->promised(), order.scene.dimension);
  }
  ColumnReader& reader() { return *reader_; }
  void write(const QueryRows&, AnswerRows& answers) {
    answers.refuse_large_cells();
    append_npy_answers(out_, answers);
  }
  void finish() {
    if (reader_->has_more())
      say("warning: {}: there is more behind the last row, which is ignored", reader_->name());
  }

 private:
  std::unique_ptr<ColumnReader> reader_;
  std::string& out_;
};

template <class Format>
int answer_all(const ColumnOrder& order) {
  const question::SceneEngine engine = order.engine.in(order.scene);
  const double max_time = order.max_time.value_or(question::kForEver);
  Output output;
  Format format(order, output.buffer());
  ColumnReader& reader = format.reader();
  Complaints complaints;
  QueryRows queries;
  AnswerRows answers;
  const auto answer = [&] {
    answers.resize(queries.count, order.scene.dimension);
    engine.answer(queries, answers, 0, max_time, order.jobs);
    format.write(queries, answers);
    complaints(reader.name(), queries, answers);
    queries.clear();
  };
  // While the input pauses, the rows that have arrived are answered.
  reader.before_waiting([&] {
    answer();
    output.flush();
  });
  const auto finish = [&] {
    output.flush();
    complaints.finish(reader.name());
  };
  try {
    const std::size_t together =
        std::max<std::size_t>(order.engine.traits.together, 4096) * static_cast<std::size_t>(order.jobs);
    for (; reader.next(queries, together); output.flush_if_due()) answer();
    format.finish();
  } catch (const InputError&) {  // the rows before it have their answers
    finish();
    throw;
  } catch (const FileError&) {  // those that were read get theirs
    answer();
    finish();
    throw;
  }
  finish();
  return complaints.had_bad_input() ? kBadInput : kDone;
}

}  // namespace

int answer_columns(const ColumnOrder& order) {
  return order.format == ColumnOrder::Format::csv ? answer_all<Csv>(order) : answer_all<Npy>(order);
}

}  // namespace lorentz::cli
