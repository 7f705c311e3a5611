// Reads the lines of a file or pipe, fast, with bounded length.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lorentz {

class InputFile;  // internal to the formats

/// Reads a stream line by line from a file descriptor. Memory stays bounded: a line longer than kMaxLine is
/// reported as such and skipped.
class LineReader {
 public:
  static constexpr std::size_t kMaxLine = std::size_t{1} << 25;  // 32 MiB: a scene of 10^5 atoms fits
  static constexpr std::size_t kPadding = 64;                    // bytes that may be read beyond a line's end

  struct Line {
    std::string_view
        text;  ///< without the line end; kPadding bytes behind it are readable; valid until the next call
    std::size_t number = 0;  ///< counted from 1
    bool too_long = false;   ///< then `text` is empty
  };

  /// Opens a file, or standard input for "-". Throws FileError if it cannot be read (for example a
  /// directory).
  explicit LineReader(const std::string& path);
  /// Reads the lines of `text`, which messages call `name`.
  LineReader(std::string_view text, std::string name);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// Reads the next line, without the byte order mark that the first may have. Returns false at the end.
  /// Throws FileError if reading fails.
  bool next(Line& line);

  /// Sets a callback that runs before each read that may have to wait, for example to flush the answers so
  /// far.
  void before_waiting(std::function<void()> callback) { before_waiting_ = std::move(callback); }

  const std::string& name() const;
  int descriptor() const;  ///< -1 for a text

 private:
  bool fill();
  void skip_rest_of_line();

  std::unique_ptr<InputFile> file_;  // null for a text
  std::string name_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // unread bytes of the buffer
  bool at_end_ = false;
  std::size_t number_ = 0;
  std::function<void()> before_waiting_;
};

}  // namespace lorentz
