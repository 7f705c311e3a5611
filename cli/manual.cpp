#include "cli/manual.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cctype>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <sstream>
#include <vector>

#include "report/files/whole_file.hpp"

namespace lorentz::cli {
namespace {

// Text escaped for roff. Hyphens become minus signs, so that options can be copied from the page.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  return out;
}

// A literal line. A dot or quote at its beginning must not make it a request.
std::string line_of(const std::string& text) {
  const bool is_request = text.starts_with('.') || text.starts_with('\'');
  return (is_request ? "\\&" : "") + escaped(text) + '\n';
}

// Prose in short lines, which man joins into paragraphs.
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

// A command and its parents, the program first.
struct ManualPage {
  const Command& command;
  std::vector<const Command*> above;

  std::string joined(const char* between) const {
    std::string name;
    for (const Command* one : above) name += one->name + between;
    return name + command.name;
  }
  // The page's name, for example lorentz-scene-draw.
  std::string name() const { return joined("-"); }

  ManualPage of(const Command& one) const {
    ManualPage page{one, above};
    page.above.push_back(&command);
    return page;
  }
};

std::string synopsis_of(const ManualPage& page) {
  std::string out = fmt::format(".SH SYNOPSIS\n.B {}\n[\\fIOPTIONS\\fR]\n", escaped(page.joined(" ")));
  for (const Option& option : page.command.options) {
    if (!option.is_argument()) continue;
    const std::string name =
        fmt::format("\\fI{}\\fR{}", escaped(option.name()), option.takes_many() ? "\\&..." : "");
    out += option.traits & kRequired ? name + '\n' : '[' + name + "]\n";
  }
  if (page.command.commands.empty()) return out;
  return out + (!page.command.act ? "\\fISUBCOMMAND\\fR\n" : "[\\fISUBCOMMAND\\fR]\n");
}

std::string names_of(const Option& option) {
  if (option.is_argument()) return "\\fI" + escaped(option.name()) + "\\fR";
  std::string out;
  for (const auto& names : {option.short_names(), option.long_names()})
    for (const std::string& name : names) out += (out.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
  return out;
}

std::string entry_of(const Option& option) {
  std::string heading = names_of(option);
  if (option.takes_value()) {
    heading += " \\fI" + escaped(option.type) + "\\fR";
    if (option.takes_many()) heading += "\\&...";
    if (const std::string usual = option.default_text(); !usual.empty())
      heading += fmt::format(" (default: {})", escaped(usual));
    if (option.traits & kRequired) heading += " (required)";
  }
  std::string text = option.help;
  if (!option.excludes.empty()) text += "; not together with " + option.excludes;
  return ".TP\n" + heading + '\n' + prose_of(text);
}

std::string section_of_options(const Command& command, const char* heading, bool arguments) {
  std::string entries;
  for (const Option& option : command.options)
    if (!option.is_hidden() && option.is_argument() == arguments) entries += entry_of(option);
  return entries.empty() ? "" : fmt::format(".SH {}\n{}", heading, entries);
}

std::string section_of_subcommands(const ManualPage& page) {
  std::string entries;
  for (const Command& command : page.command.commands)
    entries += fmt::format(".TP\n\\fB{}\\fR(1)\n{}", escaped(page.of(command).name()),
                           prose_of(command.description));
  return entries.empty() ? "" : ".SH SUBCOMMANDS\n" + entries;
}

// The text below the options: prose, followed by examples from "Example" on, whose lines are indented.
struct Footer {
  std::string prose, examples;
};

Footer footer_of(const Command& command) {
  Footer footer;
  std::string* part = &footer.prose;
  bool in_code = false;
  std::istringstream lines(command.footer);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Example")) part = &footer.examples;
    const bool is_code = line.starts_with("  ");
    if (is_code != in_code) *part += is_code ? ".nf\n" : ".fi\n.PP\n";
    in_code = is_code;
    if (line == "Example:" || line == "Examples:") continue;  // replaced by the section's heading
    *part += is_code ? line_of(line) : prose_of(line);
  }
  if (in_code) *part += ".fi\n";
  return footer;
}

std::string section_of_files() {
  return ".SH ENVIRONMENT\n.TP\nLORENTZ_DATA\nThe folder with the catalogue of scenes and the golden sets,\n"
         "instead of the one that was installed with the program.\n.TP\nLORENTZ_PROGRESS_AFTER\n"
         "From which second of the work on progress is drawn on a terminal\n(default: 1).\n";
}

// References to the parent page and to the other pages beside this one.
std::string section_of_others(const ManualPage& page) {
  if (page.above.empty()) return "";
  ManualPage above{*page.above.back(), page.above};
  above.above.pop_back();
  std::string out = fmt::format(".SH SEE ALSO\n.BR {} (1)", escaped(above.name()));
  for (const Command& other : above.command.commands)
    if (&other != &page.command) out += fmt::format(",\n.BR {} (1)", escaped(above.of(other).name()));
  return out + '\n';
}

std::string date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t time = epoch ? std::strtoll(epoch, nullptr, 10) : std::time(nullptr);
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(time));
}

std::string page_of(const ManualPage& page) {
  const Command& command = page.command;
  const std::string& description = command.description;
  const bool is_sentence = description.ends_with('.');
  const Footer footer = footer_of(command);
  std::string upper = page.name();
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string out =
      fmt::format(".TH {} 1 {} \"lorentz {}\" \"lorentz\"\n.SH NAME\n{} \\- {}\n", escaped(upper), date(),
                  LORENTZ_VERSION, escaped(page.name()),
                  escaped(is_sentence ? description.substr(0, description.size() - 1) : description));
  out += synopsis_of(page) + ".SH DESCRIPTION\n" + prose_of(description);
  if (!page.above.empty() && !footer.prose.empty()) out += ".PP\n" + footer.prose;
  out += section_of_options(command, "ARGUMENTS", true) + section_of_options(command, "OPTIONS", false);
  out += section_of_subcommands(page);
  out +=
      ".SH EXIT STATUS\n" + footer_of(page.above.empty() ? command : *page.above.front()).prose +
      "Files are put in their place when they are whole: if the program is ended,\nwhat was there stands.\n";
  out += section_of_files();
  if (!footer.examples.empty()) out += ".SH EXAMPLES\n" + footer.examples;
  return out + section_of_others(page);
}

void write_pages(const ManualPage& page, const std::filesystem::path& folder) {
  write_whole((folder / (page.name() + ".1")).string(), page_of(page));
  for (const Command& command : page.command.commands) write_pages(page.of(command), folder);
}

}  // namespace

void write_manuals(const Command& program, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);  // an error shows when the first file is written
  write_pages({program, {}}, folder);
}

}  // namespace lorentz::cli
