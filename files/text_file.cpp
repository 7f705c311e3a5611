#include "files/text_file.hpp"

#include <lorentz/line_reader.hpp>

namespace lorentz {

std::string text_of_file(const std::string& path) {
  std::string text;
  LineReader lines(path);
  for (LineReader::Line line; lines.next(line);) text.append(line.text) += '\n';
  return text;
}

}  // namespace lorentz
