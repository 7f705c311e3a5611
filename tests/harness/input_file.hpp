// Bytes as a file, for readers that want a path; and lines that expose every read beyond their end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <lorentz/line_reader.hpp>

namespace lorentz::harness {

/// A file in memory, whose content changes with each input. Its path can be opened any number of times.
class BytesAsFile {
 public:
  BytesAsFile();
  ~BytesAsFile();
  BytesAsFile(const BytesAsFile&) = delete;
  BytesAsFile& operator=(const BytesAsFile&) = delete;

  void set(std::string_view content);
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A line of text in memory of its own that ends where the promised padding ends. In a LineReader's buffer a
/// read beyond that would go unnoticed.
class LoneLine {
 public:
  explicit LoneLine(std::string_view text, std::size_t number = 1);
  const LineReader::Line& line() const { return line_; }

 private:
  std::unique_ptr<char[]> bytes_;
  LineReader::Line line_;
};

}  // namespace lorentz::harness
