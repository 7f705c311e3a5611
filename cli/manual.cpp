#include "cli/manual.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cctype>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <sstream>

#include "cli/whole_file.hpp"

namespace lorentz::cli {
namespace {

// Text as roff takes it: hyphens that are minus signs, so that options can be copied out of the page.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  return out;
}

// A line as it is, which no dot or quote at its beginning may make a request.
std::string line_of(const std::string& text) {
  const bool is_request = text.starts_with('.') || text.starts_with('\'');
  return (is_request ? "\\&" : "") + escaped(text) + '\n';
}

// Prose, in short lines, which man fills.
std::string prose_of(const std::string& text) {
  constexpr std::size_t kWidth = 72;
  std::string out, line;
  std::istringstream words(text);
  for (std::string word; words >> word; line += (line.empty() ? "" : " ") + word)
    if (!line.empty() && line.size() + word.size() > kWidth) {
      out += line_of(line);
      line.clear();
    }
  return line.empty() ? out : out + line_of(line);
}

// What a page is called: lorentz-scene-draw.
std::string page_name(const CLI::App& app) {
  return app.get_parent() ? page_name(*app.get_parent()) + '-' + app.get_name() : app.get_name();
}

std::string called(const CLI::App& app) {
  return app.get_parent() ? called(*app.get_parent()) + ' ' + app.get_name() : app.get_name();
}

bool is_shown(const CLI::Option& option) {
  return !option.get_group().empty();
}

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() > 1;
}

std::string synopsis_of(const CLI::App& app) {
  std::string out = fmt::format(".SH SYNOPSIS\n.B {}\n[\\fIOPTIONS\\fR]\n", escaped(called(app)));
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name =
        fmt::format("\\fI{}\\fR{}", escaped(option->get_name(true)), takes_many(*option) ? "\\&..." : "");
    out += option->get_required() ? name + '\n' : '[' + name + "]\n";
  }
  if (app.get_subcommands({}).empty()) return out;
  return out + (app.get_require_subcommand_min() > 0 ? "\\fISUBCOMMAND\\fR\n" : "[\\fISUBCOMMAND\\fR]\n");
}

std::string names_of(const CLI::Option& option) {
  if (option.get_positional()) return "\\fI" + escaped(option.get_name(true)) + "\\fR";
  std::string out;
  for (const std::string& name : option.get_snames())
    out += (out.empty() ? "\\fB\\-" : ", \\fB\\-") + escaped(name) + "\\fR";
  for (const std::string& name : option.get_lnames())
    out += (out.empty() ? "\\fB\\-\\-" : ", \\fB\\-\\-") + escaped(name) + "\\fR";
  return out;
}

std::string entry_of(const CLI::Option& option) {
  std::string heading = names_of(option);
  if (option.get_items_expected_max() > 0) {
    heading += " \\fI" + escaped(option.get_type_name()) + "\\fR";
    if (takes_many(option)) heading += "\\&...";
    if (!option.get_default_str().empty())
      heading += fmt::format(" (default: {})", escaped(option.get_default_str()));
    if (option.get_required()) heading += " (required)";
  }
  std::string text = option.get_description();
  for (const CLI::Option* other : option.get_excludes())
    text += "; not together with --" + other->get_lnames().at(0);
  return ".TP\n" + heading + '\n' + prose_of(text);
}

std::string section_of_options(const CLI::App& app, const char* heading, bool positional) {
  std::string entries;
  for (const CLI::Option* option : app.get_options())
    if (is_shown(*option) && option->get_positional() == positional) entries += entry_of(*option);
  return entries.empty() ? "" : fmt::format(".SH {}\n{}", heading, entries);
}

std::string section_of_subcommands(const CLI::App& app) {
  std::string entries;
  for (const CLI::App* command : app.get_subcommands({}))
    entries += fmt::format(".TP\n\\fB{}\\fR(1)\n{}", escaped(page_name(*command)),
                           prose_of(command->get_description()));
  return entries.empty() ? "" : ".SH SUBCOMMANDS\n" + entries;
}

// The text under the options: prose, and from "Example" on examples, whose lines are indented.
struct Footer {
  std::string prose, examples;
};

Footer footer_of(const CLI::App& app) {
  Footer footer;
  std::string* part = &footer.prose;
  bool in_code = false;
  std::istringstream lines(app.get_footer());
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Example")) part = &footer.examples;
    const bool is_code = line.starts_with("  ");
    if (is_code != in_code) *part += is_code ? ".nf\n" : ".fi\n.PP\n";
    in_code = is_code;
    if (line == "Example:" || line == "Examples:") continue;  // the section's heading says so
    *part += is_code ? line_of(line) : prose_of(line);
  }
  if (in_code) *part += ".fi\n";
  return footer;
}

std::string section_of_files() {
  return ".SH ENVIRONMENT\n"
         ".TP\nLORENTZ_DATA\n"
         "The folder with the catalogue of scenes and the golden sets,\n"
         "instead of the one that was installed with the program.\n"
         ".TP\nLORENTZ_PROGRESS_AFTER\n"
         "From which second of the work on progress is drawn on a terminal\n(default: 1).\n";
}

// The page above, the pages beside it.
std::string section_of_others(const CLI::App& app) {
  const CLI::App* above = app.get_parent();
  if (!above) return "";
  std::string out = fmt::format(".SH SEE ALSO\n.BR {} (1)", escaped(page_name(*above)));
  for (const CLI::App* other : above->get_subcommands({}))
    if (other != &app) out += fmt::format(",\n.BR {} (1)", escaped(page_name(*other)));
  return out + '\n';
}

std::string date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t time = epoch ? std::strtoll(epoch, nullptr, 10) : std::time(nullptr);
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(time));
}

const CLI::App& root_of(const CLI::App& app) {
  return app.get_parent() ? root_of(*app.get_parent()) : app;
}

std::string page_of(const CLI::App& app) {
  const std::string& description = app.get_description();
  const bool is_sentence = description.ends_with('.');
  const Footer footer = footer_of(app);
  std::string upper = page_name(app);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string out =
      fmt::format(".TH {} 1 {} \"lorentz {}\" \"lorentz\"\n.SH NAME\n{} \\- {}\n", escaped(upper), date(),
                  LORENTZ_VERSION, escaped(page_name(app)),
                  escaped(is_sentence ? description.substr(0, description.size() - 1) : description));
  out += synopsis_of(app) + ".SH DESCRIPTION\n" + prose_of(description);
  if (app.get_parent() && !footer.prose.empty()) out += ".PP\n" + footer.prose;
  out += section_of_options(app, "ARGUMENTS", true) + section_of_options(app, "OPTIONS", false);
  out += section_of_subcommands(app);
  out +=
      ".SH EXIT STATUS\n" + footer_of(root_of(app)).prose +
      "Files are put in their place when they are whole: if the program is ended,\nwhat was there stands.\n";
  out += section_of_files();
  if (!footer.examples.empty()) out += ".SH EXAMPLES\n" + footer.examples;
  return out + section_of_others(app);
}

void write_pages(const CLI::App& app, const std::filesystem::path& folder) {
  WholeFile file((folder / (page_name(app) + ".1")).string());
  file.write(page_of(app));
  file.commit();
  for (const CLI::App* command : app.get_subcommands({})) write_pages(*command, folder);
}

}  // namespace

void write_manuals(const CLI::App& app, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);  // what is wrong with it the first file will say
  write_pages(app, folder);
}

}  // namespace lorentz::cli
