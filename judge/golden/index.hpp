// The index of a folder of golden sets: index.json.
#pragma once

#include <string>
#include <vector>

namespace lorentz::golden {

/// The text of index.json: one JSON object about these sets in the folder, with a line for each: name, file,
/// checksum, counts, tags, kinds of scenes, notations. Throws as Reader does.
std::string index_of(const std::string& folder, const std::vector<std::string>& names);

/// Writes this index.json, and SHA256SUMS of the sets, the index and `others`. Throws FileError.
void write_index(const std::string& folder, const std::string& index, const std::vector<std::string>& names,
                 const std::vector<std::string>& others = {});

}  // namespace lorentz::golden
