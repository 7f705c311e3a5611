#include "golden/reader.hpp"

#include <set>

#include <lorentz/line_reader.hpp>
#include <lorentz/scene_check.hpp>
#include "src/exchange/exchange_json.hpp"

namespace lorentz::golden {
namespace {

std::string read_text(json::value value, const std::string& key) {
  if (value.type() != json::json_type::string) throw InputError(key + ": needs a string");
  return std::string(value.get_string().value());
}

std::int64_t read_count(json::value value, const std::string& key, std::int64_t most = 1'000'000'000'000) {
  const Integer n = read_integer(value, key.c_str());
  if (!n.fits_int64() || n.int64() < 0 || n.int64() > most) throw InputError(key + ": is out of range");
  return n.int64();
}

int read_index(json::value value, const std::string& key) {
  return static_cast<int>(read_count(value, key, 1'000'000'000));
}

Header read_header(json::value value) {
  Header header;
  bool has_format = false, has_count = false, has_tags = false;
  for (auto field : value.get_object()) {
    const std::string key(std::string_view(field.unescaped_key()));
    if (key == "format") {
      if (read_count(field.value(), key) != 1) throw InputError("format: only format 1 is known here");
      has_format = true;
    } else if (key == "name") {
      header.name = read_text(field.value(), key);
    } else if (key == "description") {
      header.description = read_text(field.value(), key);
    } else if (key == "generator") {
      header.generator = read_text(field.value(), key);
    } else if (key == "version") {
      header.version = read_text(field.value(), key);
    } else if (key == "count") {
      header.count = static_cast<std::uint64_t>(read_count(field.value(), key));
      has_count = true;
    } else if (key == "tags") {
      has_tags = true;
      header.tags.clear();
      for (auto tag : field.value().get_object()) {
        std::string name(std::string_view(tag.unescaped_key()));
        header.tags.emplace_back(std::move(name), read_text(tag.value(), "tags"));
      }
    } else {
      skip(field.value());
    }
  }
  if (!has_format || !has_count || !has_tags) throw InputError("the header needs format, count and tags");
  return header;
}

// A basis has as many vectors as the scene dimensions, and these as many components.
void check_size(std::size_t count, int dimension) {
  if (count != static_cast<std::size_t>(dimension))
    throw InputError("basis: has " +
                     std::string(count < static_cast<std::size_t>(dimension) ? "less" : "more") + " than " +
                     std::to_string(dimension) + " vectors or components");
}

oracle::CertificateBasis read_basis(json::value value, int dimension) {
  oracle::CertificateBasis basis;
  std::size_t i = 0;
  for (json::value row : value.get_array()) {
    if (i == basis.size()) check_size(i + 1, dimension);
    std::size_t k = 0;
    for (json::value component : row.get_array()) {
      if (k == basis[i].size()) check_size(k + 1, dimension);
      basis[i][k++] = read_integer(component, "basis");
    }
    check_size(k, dimension);
    ++i;
  }
  check_size(i, dimension);
  return basis;
}

// A number as elsewhere, but its hexadecimal form is taken exactly.
oracle::WindowEnd read_end(json::value value, const std::string& key) {
  if (value.type() != json::json_type::string) return read_number(value, key);
  const auto end = oracle::window_end_from(value.get_string().value());
  if (!end) throw InputError(key + ": is no number and no text like \"-0x1f4p-3\"");
  return *end;
}

// A window, or of a row what it has of one.
oracle::Window read_window(json::value value, int dimension, bool is_row) {
  oracle::Window window;
  std::set<std::string> missing{"lattice", "atom", "basis"};
  if (!is_row) missing.insert({"from", "to"});
  for (auto field : value.get_object()) {
    const std::string key(std::string_view(field.unescaped_key()));
    missing.erase(key);
    if (key == "lattice")
      window.lattice = read_index(field.value(), key);
    else if (key == "atom")
      window.atom = read_index(field.value(), key);
    else if (key == "from" && !is_row)
      window.from = read_end(field.value(), key);
    else if (key == "to" && !is_row)
      window.to = read_end(field.value(), key);
    else if (key == "basis")
      window.basis = read_basis(field.value(), dimension);
    else
      skip(field.value());
  }
  if (!missing.empty()) throw InputError("certificate: " + *missing.begin() + " is missing");
  return window;
}

oracle::Certificate read_certificate(json::value value, int dimension) {
  oracle::Certificate certificate;
  bool has_windows = false, has_rows = false;
  for (auto field : value.get_object()) {
    const std::string key(std::string_view(field.unescaped_key()));
    if (key != "windows" && key != "rows") {
      skip(field.value());
      continue;
    }
    (key == "windows" ? has_windows : has_rows) = true;
    // Of a key that comes twice the last counts.
    certificate = {};
    for (json::value one : field.value().get_array()) {
      const oracle::Window window = read_window(one, dimension, key == "rows");
      if (key == "windows")
        certificate.windows.push_back(window);
      else
        certificate.rows.push_back({window.lattice, window.atom, window.basis});
    }
  }
  if (has_windows == has_rows) throw InputError("certificate: has either windows or rows");
  return certificate;
}

double read_size(json::value value, const std::string& key) {
  if (value.type() == json::json_type::string && value.get_string().value() == "inf")
    return std::numeric_limits<double>::infinity();
  return read_number(value, key);
}

// The id is made from the text between, so there all of the question must be.
constexpr const char* kOrder = "the keys of a record stand in the order id, tags, x, v, from, expect, ...";

// A record's question is the text from behind the first `],` to before the first `,"expect"`: simple to find
// for any program. Here the keys are seen one after the other, to be sure that the text is what it should be.
class QuestionPlace {
 public:
  explicit QuestionPlace(std::string_view line) : line_(line) {
    const auto tags_end = line.find("],\""), end = line.find(",\"expect\"");
    if (tags_end == line.npos || end == line.npos || end < tags_end + 2) return;
    begin_ = tags_end + 2;
    end_ = end;
  }

  /// The record's keys in order, with their places in the line.
  void see(const std::string& key, std::size_t place) {
    if (keys_ < 2) in_order_ &= key == (keys_ == 0 ? "id" : "tags");
    if (keys_ == 2) in_order_ &= place == begin_;
    if (key == "expect" && !ended_) {
      in_order_ &= place == end_ + 1;
      ended_ = true;
    }
    if (ended_) in_order_ &= key != "x" && key != "v" && key != "from";
    ++keys_;
  }

  std::string text() const {
    if (!in_order_) throw InputError(kOrder);
    return std::string(line_.substr(begin_, end_ - begin_));
  }

 private:
  std::string_view line_;
  std::size_t begin_ = 0, end_ = 0, keys_ = 0;
  bool ended_ = false, in_order_ = true;
};

// Brackets open at the same time. Deeper than anything here needs no reader should have to go.
void check_nesting(std::string_view line) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') in_string = !in_string;
    if (in_string)
      i += line[i] == '\\' ? 1 : 0;
    else if (line[i] == '[' || line[i] == '{')
      check_depth(++depth);
    else if (line[i] == ']' || line[i] == '}')
      --depth;
  }
}

// An expectation has what its outcome has, and no id.
void check_members(const std::set<std::string>& keys, Outcome outcome) {
  const bool named = outcome == Outcome::hit || outcome == Outcome::inside;
  const std::pair<const char*, bool> members[] = {
      {"id", false}, {"lattice", named}, {"atom", named}, {"cell", named}, {"time", outcome == Outcome::hit}};
  for (const auto& [key, needed] : members)
    if (keys.contains(key) != needed)
      throw InputError(std::string("expect: ") + key + (needed ? " is missing" : " does not belong there"));
}

}  // namespace

struct Reader::Impl {
  explicit Impl(const std::string& path) : lines(path) {}

  LineReader lines;
  ExchangeReader exchange;
  json::parser parser;
  Header header;
  std::optional<Scene> scene;
  std::string scene_line;
  std::size_t scenes = 0;

  json::document open(const LineReader::Line& line) {
    if (line.too_long) throw InputError("the line is too long");
    check_nesting(line.text);
    return parser.iterate(line.text.data(), line.text.size(), line.text.size() + LineReader::kPadding);
  }

  // Calls read(line), and puts the place in front of what it complains of.
  template <class Read>
  void at(const LineReader::Line& line, const Read& read) {
    const std::string place = lines.name() + ':' + std::to_string(line.number) + ": ";
    try {
      read();
    } catch (const simdjson::simdjson_error& error) {
      throw InputError(place + "not JSON as it should be: " + error.what());
    } catch (const NotJson& error) {
      throw InputError(place + "not JSON: " + error.what());
    } catch (const InputError& error) {
      throw InputError(place + error.what());
    }
  }

  void read_first_line() {
    LineReader::Line line;
    if (!lines.next(line)) throw InputError(lines.name() + ": is empty; a golden set begins with its header");
    at(line, [&] {
      bool found = false;
      json::document document = open(line);
      for (auto field : document.get_object()) {
        if (field.unescaped_key().value() == "golden") {
          header = read_header(field.value());
          found = true;
        } else {
          skip(field.value());
        }
      }
      if (!found) throw InputError("a golden set begins with its header, {\"golden\":{...}}");
    });
  }

  void read_expectation(json::object object, Answer& expect) {
    std::set<std::string> keys;
    for (auto field : object) keys.emplace(std::string_view(field.unescaped_key()));
    object.reset();
    Id id;
    std::size_t components = 0;
    Answer answer;
    if (!read_answer(object, id, answer, components)) throw InputError("expect: is no answer");
    check_members(keys, answer.outcome);
    if (components != 0 && components != static_cast<std::size_t>(scene->dimension))
      throw InputError("expect.cell: has " + std::to_string(components) + " components");
    answer.time_decimal = std::move(expect.time_decimal);  // a key of the record's, wherever it stands
    expect = std::move(answer);
  }

  void read_field(const std::string& key, json::value value, Record& record) {
    if (key == "id") {
      record.id = read_text(value, key);
    } else if (key == "tags") {
      record.tags.clear();
      for (json::value tag : value.get_array()) record.tags.push_back(read_text(tag, key));
    } else if (key == "expect") {
      read_expectation(value.get_object(), record.expect);
    } else if (key == "time_decimal") {
      record.expect.time_decimal = read_text(value, key);
      if (record.expect.time_decimal.empty()) throw InputError(key + ": is empty");
    } else if (key == "margin") {
      record.margin = read_size(value, key);
    } else if (key == "condition") {
      record.condition = read_size(value, key);
    } else if (key == "certificate") {
      record.certificate = read_certificate(value, scene->dimension);
    } else {
      skip(value);
    }
  }

  // Its first keys are looked at only to refuse what would be read as something else.
  void read_scene(const LineReader::Line& line, Scene&& read) {
    json::document document = open(line);
    for (auto field : document.get_object()) {
      const std::string key(std::string_view(field.unescaped_key()));
      for (const char* other : {"golden", "id", "x", "v", "from"})
        if (key == other) throw InputError("a scene's line has no " + key);
      skip(field.value());
    }
    if (const auto flaw = oracle::dependence_in(read)) throw InputError(*flaw);
    scene = std::move(read);
    scene_line = line.text;
    ++scenes;
  }

  void read_record(const LineReader::Line& line, ReadRecord& read) {
    bool has_tags = false, has_expect = false;
    json::document document = open(line);
    QuestionPlace question(line.text);
    for (auto field : document.get_object()) {
      const char* place = field.key().raw() - 1;
      const std::string key(std::string_view(field.unescaped_key()));
      if (key == "golden") throw InputError("a golden set has one header, its first line");
      question.see(key, static_cast<std::size_t>(place - line.text.data()));
      has_tags |= key == "tags";
      has_expect |= key == "expect";
      read_field(key, field.value(), read.record);
    }
    if (!has_tags || !has_expect || read.record.id.empty())
      throw InputError("a golden record has an id, tags and `expect`");
    read.record.question = question.text();
  }

  // A record, or nothing if the line is a scene or blank.
  bool read(const LineReader::Line& line, ReadRecord& read) {
    if (!line.too_long) check_nesting(line.text);
    StreamItem item;
    exchange.read_query_line(line, scene ? &*scene : nullptr, item);
    if (item.kind == StreamItem::Kind::nothing) {
      if (line.text.find_first_not_of(" \t\r") != std::string_view::npos)
        throw InputError("a golden set has one header, its first line");
      return false;
    }
    if (item.kind == StreamItem::Kind::bad && (item.bad_scene || item.no_scene))
      throw InputError(item.message);
    // A query that is bad for another reason does not say that it has no scene besides.
    if (item.kind == StreamItem::Kind::bad && !scene) throw InputError("no scene before this record");
    if (item.kind == StreamItem::Kind::scene) {
      read_scene(line, std::move(item.scene));
      return false;
    }
    read = {};
    read.line = line.number;
    read.text = line.text;
    if (item.kind == StreamItem::Kind::query)
      read.query = std::move(item.query);
    else
      read.flaw = item.message;
    read_record(line, read);
    return true;
  }
};

Reader::Reader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  impl_->read_first_line();
}
Reader::~Reader() = default;

const std::string& Reader::path() const {
  return impl_->lines.name();
}
const Header& Reader::header() const {
  return impl_->header;
}
const Scene& Reader::scene() const {
  return *impl_->scene;
}
const std::string& Reader::scene_line() const {
  return impl_->scene_line;
}
std::size_t Reader::scene_number() const {
  return impl_->scenes;
}

bool Reader::next(ReadRecord& record) {
  for (LineReader::Line line; impl_->lines.next(line);) {
    while (line.text.ends_with('\r')) line.text.remove_suffix(1);
    bool found = false;
    impl_->at(line, [&] { found = impl_->read(line, record); });
    if (found) return true;
  }
  return false;
}

}  // namespace lorentz::golden
