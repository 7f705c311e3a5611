// The output of a golden set: a file, or a folder with the accompanying files.
#pragma once

#include <optional>
#include <string>

#include "report/files/whole_file.hpp"

namespace lorentz::cli {

/// Writes index.json, schema.json and SHA256SUMS beside the sets in a folder, and reports it. Throws
/// InputError if the folder has such files of other programs. Throws FileError.
void write_beside_sets(const std::string& folder);

/// Throws InputError if the folder has an index or checksums of other programs.
void check_folder(const std::string& folder);

/// The help of an option for such an output.
inline constexpr const char* kSetOutputHelp =
    "file to write (- is standard output); FOLDER/ gets the set with its schema, an index and checksums";

/// The output that an option requests, if any. A path that ends in '/' is a folder, which is created if it
/// does not exist. It gets the set as NAME.ndjson, with index, schema and checksums beside it. The file is
/// opened before the work, like a RequestedFile.
class SetOutput {
 public:
  SetOutput(const std::optional<std::string>& path, const std::string& name);

  template <class MakeText>
  void write(const MakeText& make_text) {
    file_.write(make_text);
    if (folder_) write_beside_sets(*folder_);
  }

 private:
  std::optional<std::string> folder_;
  RequestedFile file_;
};

}  // namespace lorentz::cli
