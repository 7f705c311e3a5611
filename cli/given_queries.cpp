#include "cli/given_queries.hpp"

#include "report/files/messages.hpp"
#include "src/exchange/columns_csv.hpp"
#include "src/exchange/columns_npy.hpp"

namespace lorentz::cli {
namespace {

constexpr std::size_t kMostComplaints = 20, kRowsTogether = 4096;

std::unique_ptr<ColumnReader> columns_in(const std::string& path, const Scene& scene, bool strict) {
  if (path.ends_with(".npy")) return read_npy_queries(path, scene.dimension);
  return std::make_unique<CsvQueryReader>(path, Components(scene),
                                          unknown_columns(csv_query_columns(scene.dimension), strict));
}

}  // namespace

GivenQueries::GivenQueries(const std::string& path, std::optional<Scene> scene, bool strict)
    : scene_(std::move(scene)) {
  if (!is_columns(path)) {
    stream_.emplace(path, scene_, strict);
  } else {
    if (!scene_) throw InputError("--queries: columns hold no scene; --scene says it");
    columns_ = columns_in(path, *scene_, strict);
  }
}

bool GivenQueries::next(GivenQuery& given) {
  given = {};
  const bool found = columns_ ? next_row(given) : next_line(given);
  if (found && scene()) given.new_scene = std::exchange(new_scene_, false);
  return found;
}

bool GivenQueries::next_line(GivenQuery& given) {
  for (StreamItem item; stream_->next(item);) {
    if (item.kind == StreamItem::Kind::scene) {
      new_scene_ = true;
      continue;
    }
    given.id = std::move(item.id);
    if (item.kind == StreamItem::Kind::query)
      given.query = std::move(item.query), given.max_time = item.max_time;
    given.line = stream_->line();
    return true;
  }
  return false;
}

bool GivenQueries::next_row(GivenQuery& given) {
  if (row_ == rows_.count) {
    rows_.clear();
    row_ = flaw_ = 0;
    if (!columns_->next(rows_, kRowsTogether)) {
      const std::size_t more = bad_rows_ > kMostComplaints ? bad_rows_ - kMostComplaints : 0;
      if (more > 0) say("{}: {} more bad rows", columns_->name(), more);
      bad_rows_ -= more;  // said once
      return false;
    }
  }
  if (row_ < rows_.count) take_row(given);
  return true;
}

void GivenQueries::take_row(GivenQuery& given) {
  given.id = rows_.id.empty() ? std::to_string(number_) : json_quoted(rows_.id[row_]);
  Query query = rows_.query(row_, scene_->dimension);
  if (!rows_.max_time.empty()) given.max_time = rows_.max_time[row_];
  std::optional<std::string> why = flaw_of(query, *scene_, given.max_time);
  if (flaw_ < rows_.flaws.size() && rows_.flaws[flaw_].row == row_) why = rows_.flaws[flaw_++].message;
  ++row_, ++number_;
  if (!why)
    given.query = std::move(query);
  else if (++bad_rows_ <= kMostComplaints)
    say("{}: row {}: {}", columns_->name(), given.id, *why);
}

}  // namespace lorentz::cli
