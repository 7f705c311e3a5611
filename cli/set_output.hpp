// Where a golden set is written: a file, or a folder with what belongs beside it.
#pragma once

#include <optional>
#include <string>

#include "files/whole_file.hpp"

namespace lorentz::cli {

/// Writes index.json, schema.json and SHA256SUMS beside the sets in a folder, and says so. Throws InputError if others
/// wrote such files, and FileError.
void write_beside_sets(const std::string& folder);

/// Help of such an option.
inline constexpr const char* kSetOutputHelp =
    "file to write (- is standard output); FOLDER/ gets the set with its schema, an index and checksums";

/// What an option asks for, or nothing. A path that ends in '/' is a folder, which is made if it is not there: the set
/// is NAME.ndjson in it, and index, schema and checksums stand beside. Opened before the work, as RequestedFile.
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
