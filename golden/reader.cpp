#include "reader.hpp"

#include "exchange_json.hpp"
#include "line_reader.hpp"
#include "scene_check.hpp"

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
  for (auto field : value.get_object()) {
    const std::string key(std::string_view(field.unescaped_key()));
    if (key == "format") {
      if (read_count(field.value(), key) != 1) throw InputError("format: only format 1 is known here");
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
    } else if (key == "tags") {
      for (auto tag : field.value().get_object()) {
        std::string name(std::string_view(tag.unescaped_key()));
        header.tags.emplace_back(std::move(name), read_text(tag.value(), "tags"));
      }
    } else {
      skip(field.value());
    }
  }
  return header;
}

oracle::CertificateBasis read_basis(json::value value, int dimension) {
  oracle::CertificateBasis basis;
  const auto size = static_cast<std::size_t>(dimension);
  std::size_t i = 0;
  for (json::value row : value.get_array()) {
    std::size_t k = 0;
    for (json::value component : row.get_array()) {
      if (i >= size || k >= size)
        throw InputError("basis: has more than " + std::to_string(size) + " vectors or components");
      basis[i][k++] = read_integer(component, "basis");
    }
    ++i;
  }
  return basis;
}

oracle::WindowEnd read_end(json::value value, const std::string& key) {
  if (value.type() != json::json_type::string) return read_number(value, key);
  const auto end = oracle::window_end_from(value.get_string().value());
  if (!end) throw InputError(key + ": is no number and no text like \"-0x1f4p-3\"");
  return *end;
}

oracle::Window read_window(json::value value, int dimension) {
  oracle::Window window;
  for (auto field : value.get_object()) {
    const std::string key(std::string_view(field.unescaped_key()));
    if (key == "lattice")
      window.lattice = read_index(field.value(), key);
    else if (key == "atom")
      window.atom = read_index(field.value(), key);
    else if (key == "from")
      window.from = read_end(field.value(), key);
    else if (key == "to")
      window.to = read_end(field.value(), key);
    else if (key == "basis")
      window.basis = read_basis(field.value(), dimension);
    else
      skip(field.value());
  }
  return window;
}

oracle::Certificate read_certificate(json::value value, int dimension) {
  oracle::Certificate certificate;
  for (auto field : value.get_object()) {
    const std::string key(std::string_view(field.unescaped_key()));
    if (key != "windows" && key != "rows") {
      skip(field.value());
      continue;
    }
    // Of a key that comes twice the last counts.
    if (key == "windows")
      certificate.windows.clear();
    else
      certificate.rows.clear();
    for (json::value one : field.value().get_array()) {
      const oracle::Window window = read_window(one, dimension);
      if (key == "windows")
        certificate.windows.push_back(window);
      else
        certificate.rows.push_back({window.lattice, window.atom, window.basis});
    }
  }
  return certificate;
}

double read_size(json::value value, const std::string& key) {
  if (value.type() == json::json_type::string && value.get_string().value() == "inf")
    return std::numeric_limits<double>::infinity();
  return read_number(value, key);
}

// The id is made from the text between, so there all of the question must be.
constexpr const char* kOrder = "the keys of a record stand in the order id, tags, x, v, from, expect, ...";

// Where the members of a record begin in its line that its question lies between. Found by the reader and not
// in the text, which may hold the same words elsewhere.
struct QuestionPlace {
  std::optional<std::size_t> after_tags, expect;

  void see(const std::string& key, std::size_t place) {
    if (after_tags == 0U) after_tags = place;
    if (key == "tags") after_tags = 0;  // what comes next
    if (key == "expect" && !expect) expect = place;
  }

  // The text from after `],` to before `,"expect"`.
  std::string in(std::string_view line) const {
    if (!after_tags || !expect || *after_tags < 2 || *expect <= *after_tags) throw InputError(kOrder);
    if (line.substr(*after_tags - 2, 2) != "]," || line.substr(*expect - 1, 10) != ",\"expect\":")
      throw InputError(kOrder);
    return std::string(line.substr(*after_tags, *expect - 1 - *after_tags));
  }
};

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
      throw InputError(place + "not JSON: " + error.why);
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
    Id id;
    std::size_t components = 0;
    Answer answer;
    if (!read_answer(object, id, answer, components)) throw InputError("expect: is no answer");
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

  // A record, or nothing if the line is a scene or blank.
  bool read(const LineReader::Line& line, ReadRecord& read) {
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
      if (const auto flaw = oracle::dependence_in(item.scene)) throw InputError(*flaw);
      scene = std::move(item.scene);
      scene_line = line.text;
      ++scenes;
      return false;
    }
    read = {};
    read.line = line.number;
    read.text = line.text;
    if (item.kind == StreamItem::Kind::query)
      read.query = std::move(item.query);
    else
      read.flaw = item.message;
    bool has_tags = false, has_expect = false;
    json::document document = open(line);
    QuestionPlace question;
    for (auto field : document.get_object()) {
      const char* place = field.key().raw() - 1;
      const std::string key(std::string_view(field.unescaped_key()));
      question.see(key, static_cast<std::size_t>(place - line.text.data()));
      has_tags |= key == "tags";
      has_expect |= key == "expect";
      if ((!has_tags || has_expect) && (key == "x" || key == "v" || key == "from")) throw InputError(kOrder);
      read_field(key, field.value(), read.record);
    }
    if (!has_expect || read.record.id.empty()) throw InputError("a golden record has an id and `expect`");
    read.record.question = question.in(line.text);
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
    bool found = false;
    impl_->at(line, [&] { found = impl_->read(line, record); });
    if (found) return true;
  }
  return false;
}

}  // namespace lorentz::golden
