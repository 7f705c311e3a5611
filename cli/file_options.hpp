// Options that name files: which of them are written, and that none of those is a file that another names.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lorentz::cli {

/// From here on check_files takes this option's file for one that is written.
CLI::Option* names_output(CLI::Option* option);

/// An option for a file that is written, or (a store) written and read.
template <class Path>
CLI::Option* add_output(CLI::App& command, const std::string& names, Path& path, const std::string& what) {
  return names_output(command.add_option(names, path, what)->type_name("FILE"));
}

/// Before anything is written: throws InputError if a file to be written, standard output included, is also
/// read, or written by another option, whatever it is called there (links, the name of a scene, standard
/// input), or if its name is empty. Devices and pipes may stand anywhere.
void check_files(const CLI::App& command);

}  // namespace lorentz::cli
