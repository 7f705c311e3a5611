// Combines records of several sets into one: all, a selection, or a few of each tag.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "judge/golden/reader.hpp"

namespace lorentz::golden {

class Selection {
 public:
  /// Reads a set and takes each record for which `takes` is true. An id that is there already is skipped.
  /// Throws InputError, also if its precision or format differs from that of the sets before.
  void add(Reader& set, const std::function<bool(const Record&)>& takes);

  /// Keeps `count` records: in turn the first of each tag of each set, until there are enough.
  void thin(std::size_t count);

  std::size_t size() const { return records_.size(); }

  /// The set, with the name, description and generator of `header`.
  std::string text(Header header) const;

 private:
  struct TakenRecord {
    std::size_t scene;  // in scenes_
    std::string line, set;
    std::vector<std::string> tags;
  };

  void take_tags(const Header& header, const std::string& path);
  std::size_t scene_number(const std::string& scene_line);

  std::vector<std::string> scenes_;
  std::map<std::string, std::size_t> scene_numbers_;
  std::map<std::string, std::size_t> by_id_;
  std::vector<TakenRecord> records_;
  std::vector<std::pair<std::string, std::string>> tags_;
  std::optional<Header> first_;
};

}  // namespace lorentz::golden
