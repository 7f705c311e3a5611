// Any bytes as the store of a campaign. The harness checks that errors are of the documented types, and that
// the findings that are read have no flaw and come back unchanged from another store.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <lorentz/errors.hpp>
#include "fuzz/campaign/store.hpp"
#include "fuzz/harness/harness.hpp"
#include "fuzz/harness/input_file.hpp"

namespace lorentz::harness {
namespace {

// SQLite does not take a file in memory for a file.
class FileOnDisk {
 public:
  FileOnDisk() {
    char name[] = "/tmp/lorentz-harness-XXXXXX";
    if (!mkdtemp(name)) fail("a folder can be made", name);
    folder_ = name;
  }
  ~FileOnDisk() { std::filesystem::remove_all(folder_); }
  FileOnDisk(const FileOnDisk&) = delete;
  FileOnDisk& operator=(const FileOnDisk&) = delete;

  void set(std::string_view content) const { std::ofstream(path(), std::ios::binary) << content; }
  std::string path() const { return folder_ / "store"; }

 private:
  std::filesystem::path folder_;
};

void copy(const fuzz::Store& from, fuzz::Store& into) {
  for (const fuzz::Campaign& campaign : from.campaigns()) into.open_campaign(campaign.manifest);
  for (const fuzz::Stored& one : from.findings()) {
    require(flaw_of(one.finding).empty(), "a finding that is read has no flaw", one.label());
    (void)from.tally(one.campaign, one.finding.target);
    into.put(one.campaign, one.finding);
  }
  into.commit();
}

}  // namespace
}  // namespace lorentz::harness

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lorentz;
  using namespace lorentz::harness;
  static const FileOnDisk file;
  file.set(text_of(data, size));
  try {
    const fuzz::Store store(file.path(), fuzz::Store::Access::read);
    fuzz::Store other(":memory:", fuzz::Store::Access::write);
    copy(store, other);
    const auto findings = store.findings(), again = other.findings();
    require(again.size() <= findings.size(), "a store gives back what was put there", file.path());
    for (const fuzz::Stored& one : again)
      require(flaw_of(one.finding).empty(), "a finding that is given back has no flaw", one.label());
  } catch (const FileError&) {
  } catch (const InputError&) {
  }
  return 0;
}
