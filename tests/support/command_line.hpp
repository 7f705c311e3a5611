// Runs the program as its users call it, in a folder of its own.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

namespace lorentz::test {

namespace fs = std::filesystem;

struct Run {
  int status;
  std::string out, err;
};

// A folder of its own for each test case, gone at its end.
class Folder {
 public:
  Folder() {
    char name[] = "/tmp/lorentz-test-XXXXXX";
    path_ = mkdtemp(name);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string file(const std::string& name) const { return path_ / name; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path_ / name).rdbuf();
    return text.str();
  }
  Run lorentz(const std::string& arguments) const { return run(LORENTZ_PROGRAM " " + arguments); }
  Run run(const std::string& command) const {
    const int status = std::system((command + " >" + file("out") + " 2>" + file("err")).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out"), read("err")};
  }
  /// An engine that answers `never`, as an argument; first it writes the line of introduction, if there is one.
  std::string never(const std::string& introduction = "") const {
    const std::string said = introduction.empty() ? "" : "echo '" + introduction + "'; ";
    return "'cmd:sh " +
           write("never.sh", said + R"(exec sed -un 's/.*"id":\([^,}]*\).*/{"id":\1,"outcome":"never"}/p')") +
           "'";
  }

 private:
  fs::path path_;
};

// Does a process go on running? One that was killed may take a moment to die, and may stay a zombie, which a
// signal would reach.
inline bool goes_on_running(const std::string& pid_file) {
  int pid = 0;
  std::ifstream(pid_file) >> pid;
  if (pid <= 0) return true;  // it was not written
  for (int i = 0; i < 100; ++i) {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string number, name, state;
    if (!(stat >> number >> name >> state) || state == "Z") return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// The first place of `old` replaced; the text must hold it.
inline std::string replaced(std::string text, const std::string& old, const std::string& fresh) {
  const auto place = text.find(old);
  if (place == std::string::npos) throw std::logic_error("the text does not hold " + old);
  return text.replace(place, old.size(), fresh);
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// How often a text has a part.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

inline std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

inline const std::string kScene =
    R"({"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.25}]}]}})"
    "\n";
inline const std::string kGood = R"({"id":"good","x":[0.5,0],"v":[1,0]})"
                                 "\n";
inline const std::string kGoodAnswer =
    R"({"id":"good","outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":0.25})"
    "\n";

}  // namespace lorentz::test
