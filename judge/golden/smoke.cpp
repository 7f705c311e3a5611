// The smoke set: in turn the first record of each tag of each set, until there are enough.
#include <algorithm>
#include <map>
#include <set>

#include "judge/golden/index.hpp"
#include "judge/golden/reader.hpp"

namespace lorentz::golden {
namespace {

struct SmokeRecord {
  std::size_t scene;  // its number
  std::string line;
  std::vector<std::string> tags;
};

}  // namespace

std::string smoke_of(const std::vector<std::string>& files, std::size_t count, Header header) {
  std::map<std::string, std::size_t> scene_numbers;
  std::set<std::string> ids;
  std::vector<SmokeRecord> records;
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> by_tag;
  for (const std::string& file : files) {
    Reader set(file);
    for (const auto& tag : set.header().tags)
      if (!header.explains(tag.first)) header.tags.push_back(tag);
    for (ReadRecord read; set.next(read);) {
      if (needs_judge(read.record) || !ids.insert(read.record.id).second) continue;
      const std::size_t scene =
          scene_numbers.try_emplace(set.scene_line(), scene_numbers.size()).first->second;
      for (const std::string& tag : read.record.tags)
        by_tag[{set.header().name, tag}].push_back(records.size());
      records.push_back({scene, read.text, read.record.tags});
    }
  }
  std::set<std::size_t> chosen;
  for (std::size_t turn = 0; chosen.size() < count && turn < records.size(); ++turn)
    for (const auto& [tag, numbers] : by_tag)
      if (turn < numbers.size() && chosen.size() < count) chosen.insert(numbers[turn]);
  std::set<std::string> used;
  std::map<std::size_t, std::string> lines_of_scene;  // in the order in which the scenes came
  for (const std::size_t i : chosen) {
    used.insert(records[i].tags.begin(), records[i].tags.end());
    lines_of_scene[records[i].scene] += records[i].line + '\n';
  }
  std::erase_if(header.tags, [&](const auto& tag) { return !used.contains(tag.first); });
  header.count = chosen.size();
  std::vector<const std::string*> scenes(scene_numbers.size());
  for (const auto& [line, number] : scene_numbers) scenes[number] = &line;
  std::string text;
  append_header_line(text, header);
  for (const auto& [scene, lines] : lines_of_scene) text += *scenes[scene] + '\n' + lines;
  return text;
}

}  // namespace lorentz::golden
