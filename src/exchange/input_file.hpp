// Files and standard input as descriptors: opened, read and waited for. Private to the exchange formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

  /// At most `most` bytes, as many as are there, at least one; 0 at the end. Throws FileError.
  std::size_t read(char* bytes, std::size_t most);

  /// `count` bytes, fewer only at the end. Throws FileError.
  std::size_t read_all(char* bytes, std::size_t count);

  /// The same from a place in the file, which must have one.
  std::size_t read_all_at(std::uint64_t place, char* bytes, std::size_t count) const;

  /// Where the next byte stands; nothing for a pipe or a terminal.
  std::optional<std::uint64_t> place() const;

  /// False if a read would have to wait.
  bool is_ready() const;

  const std::string& name() const { return name_; }  ///< for messages
  int descriptor() const { return descriptor_; }

 private:
  std::string name_;
  int descriptor_ = -1;
};

/// Is there something to be read, or the end?
bool is_ready(int descriptor);

}  // namespace lorentz
