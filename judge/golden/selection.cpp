#include "judge/golden/selection.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <lorentz/errors.hpp>

namespace lorentz::golden {

void Selection::add(Reader& reader, const std::function<bool(const Record&)>& takes) {
  take_tags(reader.header(), reader.path());
  for (ReadRecord read; reader.next(read);) {
    const Record& record = read.record;
    if (!takes(record) || !by_id_.emplace(record.id, records_.size()).second) continue;
    records_.push_back({scene_number(reader.scene_line()), read.text, reader.header().name, record.tags});
  }
}

void Selection::take_tags(const Header& header, const std::string& path) {
  if (!first_) first_ = header;
  if (header.precision != first_->precision || header.format != first_->format)
    throw InputError(
        fmt::format("{}: is of {} in format {}, the sets before of {} in format {}; they do not mix", path,
                    name_of(header.precision), header.format, name_of(first_->precision), first_->format));
  for (const auto& tag : header.tags)
    if (std::ranges::none_of(tags_, [&](const auto& known) { return known.first == tag.first; }))
      tags_.push_back(tag);
}

std::size_t Selection::scene_number(const std::string& scene_line) {
  const auto [place, is_new] = scene_numbers_.try_emplace(scene_line, scenes_.size());
  if (is_new) scenes_.push_back(scene_line);
  return place->second;
}

void Selection::thin(std::size_t count) {
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> by_tag;
  for (std::size_t i = 0; i < records_.size(); ++i)
    if (records_[i].tags.empty())
      by_tag[{records_[i].set, ""}].push_back(i);
    else
      for (const std::string& tag : records_[i].tags) by_tag[{records_[i].set, tag}].push_back(i);
  std::set<std::size_t> chosen;
  for (std::size_t turn = 0; chosen.size() < std::min(count, records_.size()); ++turn)
    for (const auto& [tag, numbers] : by_tag)
      if (turn < numbers.size() && chosen.size() < count) chosen.insert(numbers[turn]);
  std::vector<TakenRecord> kept;
  for (const std::size_t i : chosen) kept.push_back(std::move(records_[i]));
  records_ = std::move(kept);
}

std::string Selection::text(Header header) const {
  if (first_) header.precision = first_->precision, header.format = first_->format;
  header.count = records_.size();
  std::set<std::string> used;
  for (const TakenRecord& record : records_) used.insert(record.tags.begin(), record.tags.end());
  for (const auto& tag : tags_)
    if (used.contains(tag.first)) header.tags.push_back(tag);
  std::string text;
  append_header_line(text, header);
  std::vector<std::vector<const TakenRecord*>> by_scene(scenes_.size());
  for (const TakenRecord& record : records_) by_scene[record.scene].push_back(&record);
  for (std::size_t scene = 0; scene < scenes_.size(); ++scene) {
    if (!by_scene[scene].empty()) text += scenes_[scene] + '\n';
    for (const TakenRecord* record : by_scene[scene]) text += record->line + '\n';
  }
  return text;
}

}  // namespace lorentz::golden
