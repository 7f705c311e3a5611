// What is in a folder of golden sets: index.json.
#pragma once

#include <string>
#include <vector>

namespace lorentz::golden {

/// The SHA-256 of a file's bytes, in hexadecimal.
std::string sum_of(const std::string& file);

/// Of these files in the folder one JSON object, a line for each: name, file, checksum, counts, tags, kinds of scenes, notations. Throws as
/// Reader does.
std::string index_of(const std::string& folder, const std::vector<std::string>& names);

}  // namespace lorentz::golden
