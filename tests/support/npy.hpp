// Files of NumPy's format .npy, byte by byte.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace lorentz::test {

/// A number's bytes, the lowest first.
template <class Number>
std::string bytes_of(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

template <class Number>
Number number_of(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// A file with this dictionary, of a version of the format.
inline std::string npy_file(const std::string& dictionary, const std::string& data, int version = 1) {
  const std::string length = version == 1 ? bytes_of(static_cast<std::uint16_t>(dictionary.size()))
                                          : bytes_of(static_cast<std::uint32_t>(dictionary.size()));
  return std::string("\x93NUMPY") + static_cast<char>(version) + '\0' + length + dictionary + data;
}

inline std::string npy_dictionary(const std::string& description, const std::string& shape) {
  return "{'descr': " + description + ", 'fortran_order': False, 'shape': " + shape + ", }\n";
}

/// Rows of numbers as a file.
inline std::string npy_rows(const std::vector<std::vector<double>>& rows, int version = 1) {
  const std::size_t columns = rows.empty() ? 4 : rows.front().size();
  std::string data;
  for (const auto& row : rows)
    for (const double number : row) data += bytes_of(number);
  return npy_file(
      npy_dictionary("'<f8'", "(" + std::to_string(rows.size()) + ", " + std::to_string(columns) + ")"), data,
      version);
}

/// What stands behind the header of a file of version 1.0.
inline std::string npy_data(const std::string& file) {
  return file.substr(10 + number_of<std::uint16_t>(file.data() + 8));
}

}  // namespace lorentz::test
