// What lies beside the golden sets in their folder: index.json, checksums, and the smoke set.
#pragma once

#include <string>
#include <vector>

#include "judge/golden/record.hpp"

namespace lorentz::golden {

/// The text of index.json: one JSON object about these sets in the folder, with a line for each: name, file,
/// checksum, counts, tags, kinds of scenes, notations. Throws as Reader does.
std::string index_of(const std::string& folder, const std::vector<std::string>& names);

/// Writes this index.json, and SHA256SUMS of all files in the folder (itineraries/ has its own). Throws FileError.
void write_index(const std::string& folder, const std::vector<std::string>& names);

/// A set of at most `count` records of these sets in binary64, in turn one of each tag, none of which needs a judge.
/// `header`: its name, description and generator.
std::string smoke_of(const std::vector<std::string>& files, std::size_t count, Header header);

}  // namespace lorentz::golden
