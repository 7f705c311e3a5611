#include "judge/golden/index.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "judge/golden/reader.hpp"
#include "report/files/whole_file.hpp"

namespace lorentz::golden {
namespace {

namespace fs = std::filesystem;

// What a consumer must support in the scenes.
void see_scene(const Scene& scene, std::set<std::string>& kinds) {
  for_each_atom(scene, [&](const Atom& atom) { kinds.insert(atom.is_ball() ? "balls" : "ellipsoids"); });
  if (scene.lattices.size() > 1) kinds.insert("several lattices");
  for (const Lattice& lattice : scene.lattices) {
    if (lattice.atoms.size() > 1) kinds.insert("several atoms");
    const int rank = lattice.rank_in(scene.dimension);
    kinds.insert(rank == scene.dimension ? "crystals"
                 : rank == 0             ? "single obstacles"
                 : rank == 1             ? "rows"
                                         : "layers");
  }
}

bool has_exponent(std::string_view text) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i)
    if ((text[i] == 'e' || text[i] == 'E') && text[i - 1] >= '0' && text[i - 1] <= '9') return true;
  return false;
}

// What a consumer must support in the texts of numbers, in questions and answers but not in proofs.
void see_notation(std::string_view text, std::set<std::string>& notations) {
  text = text.substr(0, text.find(",\"certificate\""));
  if (text.find("\"0x") != text.npos || text.find("\"-0x") != text.npos) notations.insert("hexadecimal");
  if (has_exponent(text)) notations.insert("exponents");
  if (text.find("\"inf\"") != text.npos) notations.insert("inf");
}

// True if a cell has numbers that JSON readers would round; these are decimal strings.
bool has_text(const ObstacleId& obstacle) {
  constexpr std::int64_t kExact = std::int64_t{1} << 53;
  return std::ranges::any_of(obstacle.cell, [](const Integer& n) {
    return !n.fits_int64() || n.int64() > kExact || n.int64() < -kExact;
  });
}

void see_cells(const ReadRecord& read, std::set<std::string>& notations) {
  const Record& record = read.record;
  const bool is_text =
      has_text(record.expect.obstacle) || (read.query && read.query->from && has_text(*read.query->from)) ||
      std::ranges::any_of(record.acceptable,
                          [](const oracle::ExcusedAnswer& one) { return has_text(one.answer.obstacle); });
  if (is_text) notations.insert("integers as strings");
}

// SHA-256, in hexadecimal.
std::string sum_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return sha256(std::string{std::istreambuf_iterator<char>(in), {}});
}

void add_set(json::Members& object, const std::string& folder, const std::string& name) {
  const std::string file = (fs::path(folder) / name).string();
  Reader reader(file);
  const Header& header = reader.header();
  std::set<std::string> kinds, notations;
  std::set<int> dimensions;
  std::map<Outcome, std::size_t> outcomes;
  std::size_t with_others = 0, needing = 0, scene = 0;
  for (ReadRecord read; reader.next(read);) {
    if (reader.scene_number() != scene) {
      see_scene(reader.scene(), kinds), see_notation(reader.scene_line(), notations);
      dimensions.insert(reader.scene().dimension);
    }
    scene = reader.scene_number();
    see_notation(read.text.substr(read.text.find("],")), notations);  // ids and tags may hold 9e
    see_cells(read, notations);
    ++outcomes[read.record.expect.outcome];
    with_others += !read.record.acceptable.empty();
    needing += needs_judge(read.record);
  }
  object.add("name", header.name, "file", name, "sha256", sum_of(file), "description", header.description,
             "count", header.count, "precision", name_of(header.precision), "dimensions", dimensions);
  object.add("hit", outcomes[Outcome::hit], "never", outcomes[Outcome::never], "inside",
             outcomes[Outcome::inside], "error", outcomes[Outcome::error]);
  object.add("with_acceptable", with_others, "needs_judge", needing, "scenes", kinds, "notations", notations,
             "tags", [&](json::Members& tags) {
               for (const auto& [tag, note] : header.tags) tags.add_named(tag, note);
             });
}

}  // namespace

std::string index_of(const std::string& folder, const std::vector<std::string>& names) {
  return json::line_of([&](json::Members& index) {
    const auto add = [&](json::Members& one, const std::string& name) { add_set(one, folder, name); };
    index.add("format", kFormat, "sets", json::objects(names, add, "\n"));
  });
}

void write_index(const std::string& folder, const std::vector<std::string>& names) {
  const auto path_of = [&](const std::string& name) { return (fs::path(folder) / name).string(); };
  write_whole(path_of("index.json"), index_of(folder, names));
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(folder).string());
  std::erase_if(files, [](auto& name) { return name == "SHA256SUMS" || name.starts_with("itineraries/"); });
  std::string sums;
  for (const std::string& name : files) sums += sum_of(path_of(name)) + "  " + name + '\n';
  write_whole(path_of("SHA256SUMS"), sums);
}

// ---- The smoke set: in turn the first record of each tag of each set, until there are enough

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
