// The header of a .npy file: NumPy's formats 1.0, 2.0 and 3.0. Private to the formats.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src/exchange/input_file.hpp"

namespace lorentz {

/// A number, or a small array of numbers, in each row of an array.
struct NpyField {
  std::string name;       ///< empty: the array has no names
  std::string type;       ///< as it is written: "<f8"
  char kind = '\0';       ///< 'f', 'i', 'u'; other letters are other types
  std::size_t bytes = 0;  ///< of one number
  bool big_endian = false;
  std::vector<std::size_t> shape;  ///< of a small array
  std::size_t offset = 0;          ///< in the row

  std::size_t count() const;  ///< the number of its numbers
  /// A number of 1, 2, 4 or 8 bytes.
  bool has_usual_size() const { return std::has_single_bit(bytes) && bytes <= 8; }
  bool is_integer() const { return (kind == 'i' || kind == 'u') && has_usual_size(); }
};

struct NpyHeader {
  std::vector<NpyField> fields;  ///< one without a name, if the array has no fields
  bool structured = false;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
  std::size_t item_bytes = 0;  ///< of one element of the array
  std::string description;     ///< type and shape for messages: "'<f8' of shape (7, 4)"
};

/// Reads the header, and leaves the file at the first element. Throws InputError, with the file's name.
NpyHeader read_npy_header(InputFile& file);

/// Throws InputError for a file that ends before row `done`.
[[noreturn]] void refuse_truncated(const InputFile& file, std::uint64_t done, std::uint64_t promised);

/// The header of a file, padded as in NumPy. `description` and `shape` are literals of Python.
std::string npy_header(std::string_view description, std::string_view shape);

}  // namespace lorentz
