#include "report/manifest.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <thread>

#include <lorentz/batch.hpp>
#include "report/commit.inc"  // made with each build: kCommit
#include "src/exchange/json_writer.hpp"

namespace lorentz::report {
namespace {

// The name that Linux gives. On another system only the field `system` describes the machine.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown processor";
}

std::string system_text() {
  utsname names{};
  return uname(&names) == 0 ? fmt::format("{} {} {}", names.sysname, names.release, names.machine)
                            : "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  gmtime_r(&now, &date);
  return fmt::format("{:04}-{:02}-{:02}", date.tm_year + 1900, date.tm_mon + 1, date.tm_mday);
}

}  // namespace

Manifest manifest_of(std::uint64_t seed, std::string command) {
  Manifest manifest;
  manifest.version = LORENTZ_VERSION;
  manifest.commit = kCommit;
  manifest.compiler = LORENTZ_COMPILER;
  manifest.flags = LORENTZ_FLAGS;
  manifest.machine = fmt::format("{}, {} threads", processor(), std::thread::hardware_concurrency());
  manifest.instructions = Batch::instruction_sets().front();
  manifest.system = system_text();
  manifest.date = today();
  manifest.seed = seed;
  manifest.command = std::move(command);
  return manifest;
}

void append_json(std::string& out, const Manifest& manifest) {
  json::append(out, [&](json::Members& object) {
    object.add("version", manifest.version, "commit", manifest.commit, "compiler", manifest.compiler, "flags",
               manifest.flags, "machine", manifest.machine, "instructions", manifest.instructions, "system",
               manifest.system, "date", manifest.date, "seed", manifest.seed, "command", manifest.command);
  });
}

}  // namespace lorentz::report
