// The libraries that the program is linked with.
#include <fmt/format.h>

#include <CLI/Version.hpp>

#include <lorentz/batch.hpp>
#include <lorentz/exchange.hpp>
#include <lorentz/itinerary.hpp>
#include <lorentz/oracle.hpp>
#include <lorentz/walk.hpp>
#include "cli/app.hpp"
#include "fuzz/campaign/store.hpp"

namespace lorentz::cli {

std::vector<std::string> library_versions() {
  std::vector<std::string> versions;
  // One entry may name several libraries, separated by commas or lines.
  for (std::string names :
       {oracle::oracle_libraries(), oracle::walk_libraries(), oracle::itinerary_libraries(),
        batch_libraries(), exchange_libraries(), fuzz::store_libraries()}) {
    for (std::size_t end; (end = names.find_first_of(",\n")) != std::string::npos;) {
      versions.push_back(names.substr(0, end));
      names.erase(0, names.find_first_not_of(",\n ", end));
    }
    versions.push_back(names);
  }
  versions.push_back(std::string("CLI11 ") + CLI11_VERSION);
  versions.push_back(
      fmt::format("fmt {}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100));
  return versions;
}

}  // namespace lorentz::cli
