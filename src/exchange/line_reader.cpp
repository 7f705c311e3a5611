#include <lorentz/line_reader.hpp>

#include <cstring>

#include "src/exchange/input_file.hpp"

namespace lorentz {

LineReader::LineReader(const std::string& path)
    : file_(std::make_unique<InputFile>(path)), buffer_(1 << 16) {}

LineReader::LineReader(std::string_view text, std::string name)
    : name_(std::move(name)), buffer_(text.begin(), text.end()), end_(text.size()), at_end_(true) {
  buffer_.resize(text.size() + kPadding);
}

LineReader::~LineReader() = default;

const std::string& LineReader::name() const {
  return file_ ? file_->name() : name_;
}

int LineReader::descriptor() const {
  return file_ ? file_->descriptor() : -1;
}

// Reads more behind the unread bytes, making room for it; false at the end of the stream.
bool LineReader::fill() {
  if (at_end_) return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ + kPadding >= buffer_.size()) buffer_.resize(2 * buffer_.size());
  if (before_waiting_) before_waiting_();
  const std::size_t count = file_->read(buffer_.data() + end_, buffer_.size() - kPadding - end_);
  at_end_ = count == 0;
  end_ += count;
  return count > 0;
}

void LineReader::skip_rest_of_line() {
  for (;;) {
    if (const void* newline = std::memchr(buffer_.data() + begin_, '\n', end_ - begin_)) {
      begin_ = static_cast<const char*>(newline) - buffer_.data() + 1;
      return;
    }
    begin_ = end_;
    if (!fill()) return;
  }
}

bool LineReader::next(Line& line) {
  std::size_t searched = 0;
  for (;;) {
    const char* start = buffer_.data() + begin_;
    const void* newline = std::memchr(start + searched, '\n', end_ - begin_ - searched);
    const std::size_t length = newline ? static_cast<const char*>(newline) - start : end_ - begin_;
    if (length > kMaxLine) {
      skip_rest_of_line();
      line = {{}, ++number_, true};
      return true;
    }
    if (newline || (at_end_ && length > 0)) {
      line = {std::string_view(start, length), ++number_, false};
      constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
      if (number_ == 1 && line.text.starts_with(kByteOrderMark))
        line.text.remove_prefix(kByteOrderMark.size());
      begin_ += length + (newline ? 1 : 0);
      return true;
    }
    if (at_end_) return false;
    searched = length;
    fill();
  }
}

}  // namespace lorentz
