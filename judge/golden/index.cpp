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
    const int rank = lattice.rank(scene.dimension);
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
    see_notation(read.text, notations);
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
  std::string sums;
  const auto add_sum = [&](const std::string& name) { sums += sum_of(path_of(name)) + "  " + name + '\n'; };
  std::ranges::for_each(names, add_sum);
  add_sum("index.json");
  write_whole(path_of("SHA256SUMS"), sums);
}

}  // namespace lorentz::golden
