// Reads the lines of a query stream as this project writes them: the keys in their order, and no white space.
// The readers of the formats take any JSON, by a library that need not be where this program runs.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::question {

/// A line as far as it is not read yet. Throws std::runtime_error where something else stands.
class Scan {
 public:
  explicit Scan(std::string_view line) : left_(line) {}

  bool skip(std::string_view text) {
    if (!left_.starts_with(text)) return false;
    left_.remove_prefix(text.size());
    return true;
  }
  /// The name of a member, behind the brace or the comma in front of it.
  bool skip_key(std::string_view name) {
    const std::string_view before = left_;
    if ((skip("{") || skip(",")) && skip("\"") && skip(name) && skip("\":")) return true;
    left_ = before;
    return false;
  }
  void expect_key(std::string_view name) {
    if (!skip_key(name)) throw std::runtime_error("expected the key " + std::string(name));
  }
  void expect(std::string_view text) {
    if (!skip(text)) throw std::runtime_error("expected " + std::string(text) + " at " + std::string(left_));
  }

  std::string_view whole_number() {
    const std::string_view digits = left_.substr(0, left_.find_first_not_of("-0123456789"));
    left_.remove_prefix(digits.size());
    return digits;
  }

  /// A whole number, in quotes if it is large; nothing if 64 bits do not hold it.
  std::optional<std::int64_t> integer() {
    const bool quoted = skip("\"");
    const std::string_view digits = whole_number();
    if (quoted) expect("\"");
    std::int64_t value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return read.ec == std::errc() ? std::optional(value) : std::nullopt;
  }

  double number() {
    double value = 0;
    const auto read = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    if (read.ec != std::errc()) expect("a number");
    left_.remove_prefix(static_cast<std::size_t>(read.ptr - left_.data()));
    return value;
  }

  /// Calls read(i) for each element of an array, and returns their number.
  template <class Read>
  int each(const Read& read) {
    expect("[");
    int count = 0;
    for (; !skip("]"); ++count) {
      if (count > 0) expect(",");
      read(count);
    }
    return count;
  }

  Vec vector() {
    Vec vector{};
    each([&](int k) { vector.at(static_cast<std::size_t>(k)) = number(); });
    return vector;
  }

 private:
  std::string_view left_;
};

inline Atom scan_atom(Scan& line) {
  Atom atom;
  line.expect_key("position");
  atom.position = line.vector();
  if (line.skip_key("radius")) {
    atom.radius = line.number();
  } else {
    line.expect_key("semiaxes");
    line.each([&](int) { atom.semiaxes.push_back(line.vector()); });
  }
  line.expect("}");
  return atom;
}

/// The scene, behind its key.
inline Scene scan_scene(Scan& line) {
  Scene scene;
  line.expect_key("dimension");
  scene.dimension = static_cast<int>(line.integer().value());
  line.expect_key("lattices");
  line.each([&](int) {
    Lattice& lattice = scene.lattices.emplace_back();
    line.expect_key("vectors");
    const auto read = [&](int k) { lattice.vectors.at(static_cast<std::size_t>(k)) = line.vector(); };
    lattice.rank = line.each(read);
    line.expect_key("atoms");
    line.each([&](int) { lattice.atoms.push_back(scan_atom(line)); });
    line.expect("}");
  });
  return scene;
}

/// A query whose cell fits into columns, or not.
struct ScannedQuery {
  std::string_view id;
  Vec x, v;
  int from_lattice = -1, from_atom = -1;
  std::int64_t from_cell[3]{};
  bool fits = true;
};

inline ScannedQuery scan_query(Scan& line) {
  ScannedQuery query;
  line.expect_key("id");
  query.id = line.whole_number();
  line.expect_key("x");
  query.x = line.vector();
  line.expect_key("v");
  query.v = line.vector();
  if (!line.skip_key("from")) return query;
  line.expect_key("lattice");
  query.from_lattice = static_cast<int>(line.integer().value());
  line.expect_key("atom");
  query.from_atom = static_cast<int>(line.integer().value());
  line.expect_key("cell");
  line.each([&](int k) {
    const auto component = line.integer();
    query.fits = query.fits && component;
    query.from_cell[k] = component.value_or(0);
  });
  return query;
}

}  // namespace lorentz::question
