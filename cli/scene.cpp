// lorentz scene: the catalogue, and the properties of a scene.
#include <fstream>

#include <lorentz/exchange.hpp>
#include <lorentz/scene_check.hpp>
#include "cli/app.hpp"
#include "cli/output.hpp"
#include "cli/terminal.hpp"
#include "report/files/data_folder.hpp"
#include "report/files/scene_file.hpp"
#include "report/horizon_report.hpp"
#include "report/table.hpp"
#include "src/exchange/exchange_write.hpp"
#include "src/problem/scene_geometry.hpp"

namespace lorentz::cli {

namespace {

struct SceneOptions {
  std::optional<std::string> scene;
  std::optional<double> radius;
  bool json = false;
};

// The first comment of a scene file, which describes the scene.
std::string description_in(const std::string& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line) && line.size() < 4096;) {
    if (line.empty()) continue;
    if (line[0] != '#') break;
    const auto start = line.find_first_not_of("# \t"), end = line.find_last_not_of(" \t\r");
    if (start != std::string::npos) return line.substr(start, end + 1 - start);
  }
  return "";
}

std::size_t atoms_in(const Scene& scene) {
  std::size_t atoms = 0;
  for (const Lattice& lattice : scene.lattices) atoms += lattice.atoms.size();
  return atoms;
}

int show_catalogue() {
  report::Table table({"scene", "dimension", "lattices", "atoms", "what it is"});
  table.with_prose();
  const std::map<std::string, std::string> scenes = catalogue();
  if (scenes.empty()) throw FileError("no catalogue of scenes; looked for in " + data_places("scenes"));
  int status = kDone;
  for (const auto& [name, file] : scenes) try {
      const Scene scene = read_scene(file, std::nullopt);
      table.add({name, std::to_string(scene.dimension), std::to_string(scene.lattices.size()),
                 std::to_string(atoms_in(scene)), description_in(file)});
    } catch (const InputError& error) {
      say("{}", error.what());
      status = kBadInput;
    }
  print(table.text());
  return status;
}

constexpr std::size_t kMostLooks =
    500'000;  // directions or planes: some seconds. `lorentz horizon` takes longer, too

oracle::SearchProgress short_search() {
  return [shown = search_progress()](const std::string& what, std::size_t done, std::size_t total) {
    if (total > kMostLooks)
      throw oracle::TooManyChannels(fmt::format("{} {} to look along would take long", total, what));
    if (shown) shown(what, done, total);
  };
}

// The verdict on the horizon: whether free flights are bounded.
std::string horizon_verdict(const Scene& scene) {
  try {
    const oracle::Horizon horizon = oracle::horizon_of(scene, 0, false, short_search());
    const bool all = scene.dimension == 2 || horizon.is_infinite();  // otherwise cylinders matter
    std::string verdict =
        report::verdict_of(all ? horizon : oracle::horizon_of(scene, 0, true, short_search()));
    const std::string word = " horizon";  // the row's name already has it
    if (const auto at = verdict.find(word); at != std::string::npos) verdict.erase(at, word.size());
    return verdict;
  } catch (const oracle::TooManyChannels& error) {
    return std::string("not searched: ") + error.what() + "; see `lorentz horizon --min-width`";
  } catch (const InputError& error) {  // of crystals only
    return "not searched" + std::string(error.what()).substr(std::string("horizon").size());
  }
}

// The computed properties of a scene.
struct SceneFacts {
  oracle::Contacts contacts;
  std::optional<Filling> filling;  // set if it is certain that nothing overlaps
  std::string no_filling;          // why `filling` is empty
};

constexpr std::size_t kMostContacts = 1000, kContactsShown = 10;

SceneFacts findings_on(const Scene& scene) {
  SceneFacts findings;
  findings.contacts = oracle::contacts_in(scene, kMostContacts);
  if (!is_crystal(scene)) findings.no_filling = "not given, for the scene does not repeat in all directions";
  for (const oracle::Contact& contact : findings.contacts.found)
    if (contact.overlap && findings.no_filling.empty())
      findings.no_filling =
          contact.cell ? "not given, for obstacles overlap"
                       : "not given, for obstacles of two lattices overlap, as in superpositions they do";
  if (findings.no_filling.empty() && findings.contacts.end != oracle::SearchEnd::complete)
    findings.no_filling = "not given, for obstacles may overlap: not every pair was looked at";
  if (!findings.no_filling.empty()) return findings;
  findings.filling = filling_of(scene);
  if (!findings.filling) findings.no_filling = "not given, for it is beyond the range of binary64";
  return findings;
}

std::string coordinates(const Vec& a, int dimension) {
  return dimension == 2 ? fmt::format("({:.6g}, {:.6g})", a[0], a[1])
                        : fmt::format("({:.6g}, {:.6g}, {:.6g})", a[0], a[1], a[2]);
}

std::string shape_in_words(const Atom& atom, int dimension) {
  if (atom.is_ball())
    return fmt::format("{} of radius {:.6g}", dimension == 2 ? "disc" : "sphere", atom.radius);
  const auto [a, b, c] = principal_semiaxes(atom, dimension);
  return dimension == 2 ? fmt::format("ellipse of semiaxes {:.6g}, {:.6g}", a, b)
                        : fmt::format("ellipsoid of semiaxes {:.6g}, {:.6g}, {:.6g}", a, b, c);
}

std::string line(const std::string& name, const std::string& value) {
  return fmt::format("{:<15}{}\n", name, value);
}

std::string lattice_in_words(const Scene& scene, std::size_t l) {
  constexpr std::size_t kAtomsShown = 20;
  const Lattice& lattice = scene.lattices[l];
  const int d = scene.dimension;
  std::string out = fmt::format("lattice {}\n", l);
  for (int i = 0; i < lattice.rank_in(d); ++i)
    out += line(fmt::format("  u{}", i + 1), coordinates(lattice.vectors[i], d));
  const double volume = cell_volume(lattice, d);
  if (lattice.rank >= d)
    out += line(d == 2 ? "  cell area" : "  cell volume",
                std::isnormal(volume) ? fmt::format("{:.6g}", volume) : "beyond the range of binary64");
  else
    out += line("  repeats", fmt::format("in {} of {} directions", lattice.rank_in(d), d));
  for (std::size_t a = 0; a < lattice.atoms.size() && a < kAtomsShown; ++a)
    out += line(fmt::format("  atom {}", a), fmt::format("{} at {}", shape_in_words(lattice.atoms[a], d),
                                                         coordinates(lattice.atoms[a].position, d)));
  if (lattice.atoms.size() > kAtomsShown)
    out += fmt::format("  and {} more atoms\n", lattice.atoms.size() - kAtomsShown);
  return out;
}

std::string contact_in_words(const oracle::Contact& contact, const Components& count) {
  if (!contact.cell) return oracle::description_of(contact) + " somewhere";
  return fmt::format("lattice {}: atom {} {} atom {} of cell ({})", contact.lattice, contact.atom,
                     contact.overlap ? "overlaps" : "touches", contact.other_atom,
                     decimals(components(*contact.cell, count.of_cells(contact.lattice))));
}

std::string contacts_in_words(const oracle::Contacts& contacts, const Components& cells) {
  const std::size_t count = contacts.found.size();
  const bool complete = contacts.end == oracle::SearchEnd::complete;
  if (count == 0)
    return line("obstacles",
                complete ? "none touch, none overlap" : "not checked for overlaps: too many pairs");
  const auto overlaps = static_cast<std::size_t>(
      std::count_if(contacts.found.begin(), contacts.found.end(), [](const auto& c) { return c.overlap; }));
  std::string out = line("obstacles", fmt::format("{}{} overlap, {} touch (pairs, up to translations)",
                                                  complete ? "" : "at least ", overlaps, count - overlaps));
  for (std::size_t i = 0; i < count && i < kContactsShown; ++i)
    out += line("", contact_in_words(contacts.found[i], cells));
  if (count > kContactsShown) out += line("", fmt::format("and {} more", count - kContactsShown));
  return out;
}

void show_text(const std::string& name, const std::string& file, const Scene& scene,
               const SceneFacts& findings) {
  const int d = scene.dimension;
  std::string out = line("scene", name);
  if (const std::string what = description_in(file); !what.empty()) out += line("what it is", what);
  out += line("file", file) + line("dimension", std::to_string(d));
  for (std::size_t l = 0; l < scene.lattices.size(); ++l) out += lattice_in_words(scene, l);
  out += contacts_in_words(findings.contacts, scene);
  if (findings.filling) {
    const Filling& filling = *findings.filling;
    out += line("filling", fmt::format("{:.10g} of {} is taken by obstacles", filling.fraction,
                                       d == 2 ? "the plane" : "space"));
    out += line("mean free path",
                fmt::format("{:.10g} between hits: {} (1 - filling) / ({} {:.6g})", filling.mean_free_path,
                            d == 2 ? "pi" : "4", d == 2 ? "perimeter per area" : "surface per volume",
                            filling.surface));
  } else {
    out += line("filling", findings.no_filling) + line("mean free path", findings.no_filling);
  }
  // The search of the horizon may take long, so the other results are printed first.
  print(out);
  std::fflush(stdout);
  print(line("horizon", horizon_verdict(scene)));
}

void add_contact(json::Members& object, const oracle::Contact& contact, const Components& count) {
  object.add(
      "lattice", contact.lattice, "atom", contact.atom, "other_lattice", contact.other_lattice, "other_atom",
      contact.other_atom, "cell",
      contact.cell ? std::optional(components(*contact.cell, count.of_cells(contact.lattice))) : std::nullopt,
      "kind", contact.overlap ? "overlap" : "touch");
}

void show_json(const std::string& name, const std::string& file, const Scene& scene,
               const SceneFacts& findings) {
  std::vector<std::optional<double>> volumes;
  for (const Lattice& lattice : scene.lattices) {
    volumes.emplace_back(cell_volume(lattice, scene.dimension));
    if (!std::isnormal(*volumes.back())) volumes.back().reset();
  }
  const std::vector<oracle::Contact>& contacts = findings.contacts.found;
  const std::span first(contacts.data(), std::min(contacts.size(), kContactsShown));
  const auto contact = [&](json::Members& one, const oracle::Contact& c) { add_contact(one, c, scene); };
  const auto filling = [&](double Filling::*number) {
    return findings.filling ? std::optional(*findings.filling.*number) : std::nullopt;
  };
  print(json::line_of([&](json::Members& object) {
    object.add("name", name, "description", description_in(file), "file", file, "scene", scene);
    object.add("cell_volumes", volumes, "contacts", [&](json::Members& all) {
      all.add("count", contacts.size(), "complete", findings.contacts.end == oracle::SearchEnd::complete,
              "first", json::objects(first, contact));
    });
    object.add("filling", filling(&Filling::fraction), "surface_per_volume", filling(&Filling::surface),
               "mean_free_path", filling(&Filling::mean_free_path), "horizon", horizon_verdict(scene));
  }));
}

int show(const SceneOptions& options) {
  if (!options.scene && (options.radius || options.json)) throw InputError("scene: name one to use options");
  if (!options.scene) return show_catalogue();
  const Scene scene = read_scene(*options.scene, options.radius);
  const SceneFacts findings = findings_on(scene);
  (options.json ? show_json : show_text)(*options.scene, find_scene(*options.scene), scene, findings);
  return kDone;
}

Command scene_show_command() {
  auto options = std::make_shared<SceneOptions>();
  return {"show",
          "Cell, obstacles, which of them touch or overlap, filling fraction, mean free path, horizon; "
          "without a scene the catalogue.",
          {{"scene", &options->scene, "SCENE", "a name of the catalogue, or a file"},
           {"--radius", Positive{&options->radius}, "R", "radius of every ball"},
           {"--json", &options->json, "", "as one JSON object"}},
          "Example:\n  lorentz scene show fcc --radius 0.35",
          [options] { return show(*options); }};
}

}  // namespace

Command scene_command() {
  return {"scene", "The catalogue of scenes, what is known of one, and its picture.",
          {},      "Example:\n  lorentz scene show fcc --radius 0.35",
          {},      {scene_show_command(), scene_draw_command()}};
}

}  // namespace lorentz::cli
