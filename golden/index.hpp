// The index of a folder of golden sets: index.json.
#pragma once

#include <string>
#include <vector>

namespace lorentz::golden {

/// Writes index.json, one JSON object about these sets in the folder, with a line for each: name, file,
/// checksum, counts, tags, kinds of scenes, notations. Also writes SHA256SUMS of the sets, the index and
/// `others`. Throws as Reader does, and FileError.
void write_index(const std::string& folder, const std::vector<std::string>& names,
                 const std::vector<std::string>& others = {});

}  // namespace lorentz::golden
