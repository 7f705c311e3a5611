// Files and standard input as descriptors: opened, read and waited for. Private to the exchange formats.
#pragma once

#include <cstddef>
#include <string>

namespace lorentz {

/// A file, or standard input for "-", open for reading.
class InputFile {
 public:
  /// Throws FileError if it cannot be read (a directory, say).
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads the bytes that are available, at least one and at most `most`; returns 0 at the end. Throws
  /// FileError.
  std::size_t read(char* bytes, std::size_t most);

  /// Reads `count` bytes, fewer only at the end. Throws FileError.
  std::size_t read_all(char* bytes, std::size_t count);

  /// False if a read would have to wait.
  bool is_ready() const;

  const std::string& name() const { return name_; }  ///< for messages
  int descriptor() const { return descriptor_; }

 private:
  std::string name_;
  int descriptor_ = -1;
};

/// Is there something to read, or the end?
bool is_ready(int descriptor);

}  // namespace lorentz
