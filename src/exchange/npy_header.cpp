#include "src/exchange/npy_header.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include <lorentz/errors.hpp>
#include "src/exchange/npy_literal.hpp"

namespace lorentz {

std::size_t NpyField::count() const {
  std::size_t numbers = 1;
  for (const std::size_t n : shape) numbers *= n;
  return numbers;
}

namespace {

using Kind = PythonValue::Kind;

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kLongestHeader = 1 << 20, kLargestItem = 1 << 20;

[[noreturn]] void refuse_type(const std::string& what) {
  throw InputError("the type " + what + " of the array is not understood");
}

// a b. Throws InputError if that is larger than a row may be.
std::size_t product(std::size_t a, std::size_t b) {
  if (b != 0 && a > kLargestItem / b) throw InputError("its rows are longer than 1 MiB");
  return a * b;
}

std::vector<std::size_t> small_shape(const PythonValue& value) {
  std::vector<PythonValue> numbers = value.items;
  if (value.is(Kind::integer)) numbers = {value};
  std::vector<std::size_t> shape;
  for (const PythonValue& number : numbers) {
    if (!number.is(Kind::integer) || number.number < 0) refuse_type("of a field with another shape");
    shape.push_back(product(static_cast<std::size_t>(number.number), 1));
  }
  return shape;
}

// "<f8": the order of bytes, a letter, a size, perhaps more.
void read_type(const std::string& type, NpyField& field) {
  field.type = type;
  std::string_view text = type;
  field.big_endian =
      text.starts_with('>') || (text.starts_with('=') && std::endian::native == std::endian::big);
  if (!text.empty() && std::string_view("<>=|").find(text.front()) != text.npos) text.remove_prefix(1);
  if (text.empty()) refuse_type("'" + type + "'");
  field.kind = text.front();
  text.remove_prefix(1);
  const auto status = std::from_chars(text.data(), text.data() + text.size(), field.bytes).ec;
  if (field.kind == 'O' || status != std::errc{}) refuse_type("'" + type + "'");
  field.bytes = product(field.bytes, field.kind == 'U' ? 4 : 1);
}

std::size_t read_fields(const PythonValue& description, std::vector<NpyField>& fields);

// (name, type) or (name, type, shape); a name may be (title, name). Returns its length.
std::size_t read_field(const PythonValue& entry, NpyField& field) {
  const bool good = entry.is(Kind::tuple) && (entry.items.size() == 2 || entry.items.size() == 3);
  if (!good) refuse_type("of a field");
  const PythonValue& name = entry.items[0];
  const bool titled = name.is(Kind::tuple) && name.items.size() == 2;
  field.name = titled ? name.items[1].text : name.text;
  if (entry.items.size() == 3) field.shape = small_shape(entry.items[2]);
  if (entry.items[1].is(Kind::list)) {  // fields inside a field: not a number of a query
    std::vector<NpyField> inside;
    field.type = "of fields", field.kind = 'V';
    field.bytes = read_fields(entry.items[1], inside);
  } else {
    read_type(entry.items[1].text, field);
  }
  std::size_t length = field.bytes;
  for (const std::size_t n : field.shape) length = product(length, n);
  return length;
}

std::size_t read_fields(const PythonValue& description, std::vector<NpyField>& fields) {
  std::size_t length = 0;
  for (const PythonValue& entry : description.items) {
    NpyField field;
    field.offset = length;
    length = product(length + read_field(entry, field), 1);
    fields.push_back(field);
  }
  return length;
}

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

std::string type_text(const NpyHeader& header) {
  if (!header.structured) return "'" + header.fields[0].type + "'";
  std::string text = "fields";
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const NpyField& field = header.fields[i];
    if (field.name.empty()) continue;
    if (i == 8) return text + ", ..";
    text += (i == 0 ? " " : ", ") + field.name + " '" + field.type + "'";
    for (const std::size_t n : field.shape) text += " x " + std::to_string(n);
  }
  return text;
}

NpyHeader header_of(const PythonValue& value) {
  const PythonValue *description = value.at("descr"), *order = value.at("fortran_order"),
                    *shape = value.at("shape");
  if (!value.is(Kind::dictionary) || !description || !order || !shape)
    throw InputError("the header needs descr, fortran_order and shape");
  NpyHeader header;
  header.structured = description->is(Kind::list);
  if (header.structured) {
    header.item_bytes = read_fields(*description, header.fields);
  } else if (description->is(Kind::string)) {
    read_type(description->text, header.fields.emplace_back());
    header.item_bytes = header.fields[0].bytes;
  } else {
    refuse_type("that the header describes");
  }
  if (!order->is(Kind::boolean)) throw InputError("fortran_order in the header is neither True nor False");
  header.fortran_order = order->number == 1;
  if (!shape->is(Kind::tuple)) throw InputError("the shape in the header is not a tuple");
  for (const PythonValue& n : shape->items) {
    if (!n.is(Kind::integer) || n.number < 0) throw InputError("the shape in the header has no numbers");
    header.shape.push_back(static_cast<std::uint64_t>(n.number));
  }
  header.description = type_text(header) + " of shape " + shape_text(header.shape);
  return header;
}

// Before version 3.0 a header is in Latin-1, whose characters have the same numbers in Unicode.
std::string utf8_of_latin1(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80)
      out += c;
    else
      (out += static_cast<char>(0xc0 | code >> 6)) += static_cast<char>(0x80 | (code & 0x3f));
  }
  return out;
}

// The text of the header, which follows the magic bytes, the version and its length.
std::string header_text(InputFile& file) {
  char front[12] = {};
  const std::size_t there = file.read_all(front, 8);
  if (there == 0) throw InputError("is empty");
  if (!kMagic.starts_with(std::string_view(front, std::min(there, kMagic.size())))) {
    const bool json = front[0] == '{';
    throw InputError(
        std::string("is no .npy file: it does not begin with \\x93NUMPY") +
        (json ? "; it looks like a stream in JSON: --format ndjson reads it" : " (--format csv reads CSV)"));
  }
  const int major = front[6], minor = front[7];
  if (there == 8 && (major < 1 || major > 3 || minor != 0))
    throw InputError("is of version " + std::to_string(major) + "." + std::to_string(minor) +
                     " of the format .npy; 1.0, 2.0 and 3.0 are read");
  const std::size_t width = major == 1 ? 2 : 4;
  if (there < 8 || file.read_all(front + 8, width) < width) throw InputError("ends in its header");
  std::size_t length = 0;
  for (std::size_t i = width; i-- > 0;) length = 256 * length + static_cast<unsigned char>(front[8 + i]);
  if (length > kLongestHeader) throw InputError("has a header longer than 1 MiB");
  std::string text(length, '\0');
  if (file.read_all(text.data(), length) < length) throw InputError("ends in its header");
  return major < 3 ? utf8_of_latin1(text) : text;
}

}  // namespace

NpyHeader read_npy_header(InputFile& file) {
  try {
    return header_of(read_python_literal(header_text(file)));
  } catch (const InputError& error) {
    throw InputError(file.name() + ": " + error.what());
  }
}

void refuse_truncated(const InputFile& file, std::uint64_t done, std::uint64_t promised) {
  throw InputError(file.name() + ": ends too early: " + std::to_string(promised - done) + " of " +
                   std::to_string(promised) + " rows are missing");
}

std::string npy_header(std::string_view description, std::string_view shape) {
  std::string text = "{'descr': ";
  text.append(description).append(", 'fortran_order': False, 'shape': ").append(shape).append(", }");
  constexpr std::size_t kFront = 10, kAligned = 64;
  text.append(kAligned - 1 - (kFront + text.size()) % kAligned, ' ');
  text += '\n';
  std::string out(kMagic);
  out += {'\1', '\0', static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return out + text;
}

}  // namespace lorentz
