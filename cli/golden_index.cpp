// lorentz golden index: writes the files beside sets: index.json, schema.json, SHA256SUMS.
#include <memory>

#include "cli/exit_status.hpp"
#include "cli/golden.hpp"
#include "cli/set_output.hpp"

namespace lorentz::cli {

Command golden_index_command() {
  auto folder = std::make_shared<std::string>();
  return {"index",
          "Writes index.json, schema.json and SHA256SUMS beside the sets in a folder.",
          {{"folder", folder.get(), "FOLDER", "with sets, *.ndjson", kRequired}},
          "Example:\n  mkdir mine; lorentz golden sample --count 20 ties > mine/ties.ndjson; lorentz golden "
          "index "
          "mine",
          [folder] {
            write_beside_sets(*folder);
            return kDone;
          }};
}

}  // namespace lorentz::cli
