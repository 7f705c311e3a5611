#include "judge/golden/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include <lorentz/line_reader.hpp>
#include <lorentz/scene_check.hpp>
#include "src/exchange/exchange_json.hpp"
#include "src/exchange/exchange_line.hpp"
#include "src/problem/same_answer.hpp"

namespace lorentz::golden {
namespace {

std::string read_text(json::Value value, const std::string& key) {
  if (value.type() != json::Type::string) throw InputError(key + ": needs a string");
  return std::string(value.text());
}

std::int64_t read_count(json::Value value, const std::string& key, std::int64_t most = 1'000'000'000'000) {
  const Integer n = read_integer(value, key.c_str());
  if (!n.fits_int64() || n.int64() < 0 || n.int64() > most) throw InputError(key + ": is out of range");
  return n.int64();
}

int read_index(json::Value value, const std::string& key) {
  return static_cast<int>(read_count(value, key, 1'000'000'000));
}

Header read_header(json::Value value, const OnUnknownKey& on_unknown_key) {
  Header header;
  const std::map<std::string_view, std::string*> texts{{"name", &header.name},
                                                       {"description", &header.description},
                                                       {"generator", &header.generator},
                                                       {"version", &header.version}};
  std::set<std::string> missing{"format", "count", "tags"};
  json::each_member(value, [&](std::string_view name, json::Value member) {
    const std::string key(name);
    missing.erase(key);
    if (const auto text = texts.find(name); text != texts.end()) {
      *text->second = read_text(member, key);
    } else if (key == "format") {
      header.format = read_index(member, key);
      if (header.format < 1 || header.format > kFormat)
        throw InputError("format: only formats 1 and 2 are known here");
    } else if (key == "precision") {
      header.precision = question::format_called(read_text(member, key));
    } else if (key == "count") {
      header.count = static_cast<std::uint64_t>(read_count(member, key));
    } else if (key == "tags") {
      json::each_member(member, [&](std::string_view tag, json::Value note) {
        header.tags.emplace_back(tag, read_text(note, "tags"));
      });
    } else {
      if (on_unknown_key) on_unknown_key(key);
      skip(member);
    }
  });
  if (!missing.empty()) throw InputError("the header needs format, count and tags");
  return header;
}

// The integers of a basis, row by row.
std::vector<std::vector<Integer>> read_basis(json::Value value) {
  std::vector<std::vector<Integer>> rows;
  json::each_element(value, [&](json::Value row) {
    if (rows.size() == 3) throw InputError("basis: has more than 3 vectors");
    rows.emplace_back();
    json::each_element(row, [&](json::Value component) {
      if (rows.back().size() == 3) throw InputError("basis: has more than 3 components");
      rows.back().push_back(read_integer(component, "basis"));
    });
  });
  return rows;
}

// The basis must have as many vectors as the lattice, each with as many components.
oracle::CertificateBasis basis_of(const std::vector<std::vector<Integer>>& rows, int rank) {
  const auto check = [&](std::size_t count, const char* what) {
    if (count != static_cast<std::size_t>(rank))
      throw InputError("basis: has " + std::to_string(count) + " " + what + " where the lattice has " +
                       std::to_string(rank));
  };
  oracle::CertificateBasis basis;
  check(rows.size(), "vectors");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    check(rows[i].size(), "components");
    std::copy(rows[i].begin(), rows[i].end(), basis[i].begin());
  }
  return basis;
}

// A number in the usual forms, but the hexadecimal form is taken exactly.
oracle::WindowEnd read_end(json::Value value, const std::string& key) {
  if (value.type() != json::Type::string) return read_number(value, key);
  const std::string_view text = value.text();
  if (key == "to" && text == "inf") return HUGE_VAL;
  const auto end = oracle::window_end_from(text);
  if (!end) throw InputError(key + ": is neither a number nor a text like \"-0x1f4p-3\"");
  return *end;
}

// A window, or the window's parts that a row has.
oracle::Window read_window(json::Value value, const Components& count, bool is_row) {
  oracle::Window window;
  std::vector<std::vector<Integer>> basis;
  std::set<std::string> missing{"lattice", "atom", "basis"};
  if (!is_row) missing.insert({"from", "to"});
  json::each_member(value, [&](std::string_view name, json::Value member) {
    const std::string key(name);
    missing.erase(key);
    if (key == "lattice")
      window.lattice = read_index(member, key);
    else if (key == "atom")
      window.atom = read_index(member, key);
    else if (key == "from" && !is_row)
      window.from = read_end(member, key);
    else if (key == "to" && !is_row)
      window.to = read_end(member, key);
    else if (key == "basis")
      basis = read_basis(member);
    else
      skip(member);
  });
  if (!missing.empty()) throw InputError("certificate: " + *missing.begin() + " is missing");
  window.basis = basis_of(basis, count.of_cells(window.lattice));
  return window;
}

oracle::Certificate read_certificate(json::Value value, const Components& count) {
  oracle::Certificate certificate;
  bool has_windows = false, has_rows = false;
  json::each_member(value, [&](std::string_view key, json::Value pieces) {
    has_windows |= key == "windows";
    has_rows |= key == "rows";
    if (key == "windows") {
      json::each_element(pieces, [&](json::Value piece) {
        certificate.windows.push_back(read_window(piece, count, false));
      });
    } else if (key == "rows") {
      json::each_element(pieces, [&](json::Value piece) {
        oracle::Window row = read_window(piece, count, true);
        certificate.rows.push_back({row.lattice, row.atom, std::move(row.basis)});
      });
    } else {
      skip(pieces);
    }
  });
  if (!has_windows && !has_rows) throw InputError("certificate: has neither windows nor rows");
  return certificate;
}

// An answer of a record has the members of its outcome, and no id. `expect` has a time, and may have an exit_time;
// acceptable answers have ulps.
void check_members(const std::set<std::string>& keys, const Answer& answer, bool is_expected) {
  const bool named = names_obstacle(answer);
  const std::pair<const char*, bool> members[] = {{"id", false},
                                                  {"lattice", named},
                                                  {"atom", named},
                                                  {"cell", named},
                                                  {"time", is_expected && answer.outcome == Outcome::hit},
                                                  {"ulps", !is_expected}};
  const auto refuse = [&](const char* key, const char* why) {
    throw InputError(fmt::format("{}: {} {}", is_expected ? "expect" : "acceptable", key, why));
  };
  for (const auto& [key, needed] : members)
    if (keys.contains(key) != needed) refuse(key, needed ? "is missing" : "does not belong there");
  if (keys.contains("exit_time") && !(named && is_expected)) refuse("exit_time", "does not belong there");
}

}  // namespace

struct Reader::Impl {
  Impl(const std::string& path, OnUnknownKey on_unknown_key)
      : lines(path), unknown(std::move(on_unknown_key)) {
    exchange.on_unknown_key([this](const std::string& key) { odd.push_back(key); });
  }

  LineReader lines;
  OnUnknownKey unknown;
  std::vector<std::string> odd;  // keys of the line
  ExchangeReader exchange;
  json::Document document;
  Header header;
  std::optional<Scene> scene;
  std::string scene_line;
  std::size_t scenes = 0;

  // Calls read(key, value) for the members of the object, which must be all of the line.
  template <class Read>
  void each_member_of(std::string_view text, std::size_t allocated, const Read& read) {
    document.open(text, allocated);
    json::each_member(document.object(), read);
    if (!document.ended()) throw NotJson{"more than one value in the line"};
  }
  template <class Read>
  void each_member_of(const LineReader::Line& line, const Read& read) {
    each_member_of(line.text, line.text.size() + LineReader::kPadding, read);
  }

  // The line's keys. The whole line is parsed, because a line that is not JSON is not a line of a set.
  std::vector<std::string> keys_of(const LineReader::Line& line) {
    if (line.too_long) throw InputError("the line is too long");
    std::vector<std::string> keys;
    each_member_of(line, [&](std::string_view key, json::Value value) {
      keys.emplace_back(key);
      skip(value);
    });
    return keys;
  }

  // Calls read(line), and puts the place in front of its error messages.
  template <class Read>
  void at(const LineReader::Line& line, const Read& read) {
    const std::string place = lines.name() + ':' + std::to_string(line.number) + ": ";
    try {
      read();
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
      const auto keys = keys_of(line);
      if (std::find(keys.begin(), keys.end(), "golden") == keys.end())
        throw InputError("a golden set begins with its header, {\"golden\":{...}}");
      each_member_of(line, [&](std::string_view key, json::Value value) {
        if (key == "golden")
          header = read_header(value, unknown);
        else
          skip(value);
      });
    });
  }

  // The text between the first `],` and the first `,"expect"`, which is simple to find for any program. The
  // id is made from it, so it must contain all keys between the tags and `expect`, and the whole question.
  std::string question_in(std::string_view line, const std::vector<std::string>& keys) {
    constexpr const char* kOrder =
        "the keys of a record stand in the order id, tags, x, v, from, expect, ...";
    const auto tags_end = line.find("],\""), end = line.find(",\"expect\"");
    // If one of these is missing, or they are in the other order, this is not a text of such members.
    const std::string question(line.substr(tags_end + 2, end - tags_end - 2));
    std::vector<std::string> asked{"id", "tags"};
    std::string object = '{' + question + '}';
    object.resize(object.size() + LineReader::kPadding);
    try {
      each_member_of({object.data(), question.size() + 2}, object.size(),
                     [&](std::string_view key, json::Value value) {
                       asked.emplace_back(key);
                       skip(value);
                     });
    } catch (const NotJson&) {
      throw InputError(kOrder);
    }
    const auto expect = std::find(keys.begin(), keys.end(), "expect");
    const auto asks = [](const std::string& key) { return key == "x" || key == "v" || key == "from"; };
    if (!std::equal(keys.begin(), expect, asked.begin(), asked.end()) ||
        std::any_of(expect, keys.end(), asks))
      throw InputError(kOrder);
    return question;
  }

  // Reads `expect`; or, if `ulps` is not null, an acceptable answer.
  Answer read_answer_in(json::Value object, double* ulps) {
    const char* key = ulps ? "acceptable" : "expect";
    std::set<std::string> keys;
    Id id;
    std::size_t components = 0;
    Answer answer;
    if (!read_answer(object, id, answer, components, unknown, &keys, ulps))
      throw InputError(fmt::format("{}: is not an answer", key));
    check_members(keys, answer, !ulps);
    if (names_obstacle(answer) &&
        static_cast<int>(components) != Components(*scene).of_cells(answer.obstacle.lattice))
      throw InputError(fmt::format("{}.cell: has {} components", key, components));
    return answer;
  }

  void read_field(const std::string& key, json::Value value, Record& record) {
    if (key == "id") {
      record.id = read_text(value, key);
    } else if (key == "tags") {
      json::each_element(value, [&](json::Value tag) { record.tags.push_back(read_text(tag, key)); });
    } else if (key == "expect") {
      Answer answer = read_answer_in(value, nullptr);
      answer.time_decimal = std::move(record.expect.time_decimal);  // a key of the record, wherever it stands
      record.expect = std::move(answer);
    } else if (key == "time_decimal") {
      record.expect.time_decimal = read_text(value, key);
      if (record.expect.time_decimal.empty()) throw InputError(key + ": is empty");
    } else if (key == "margin" || key == "condition" || key == "time_change") {
      (key == "margin"      ? record.margin
       : key == "condition" ? record.condition
                            : record.time_change) = read_number_or_infinity(value, key);
    } else if (key == "acceptable") {
      json::each_element(value, [&](json::Value one) {
        oracle::ExcusedAnswer& excused = record.acceptable.emplace_back();
        excused.answer = read_answer_in(one, &excused.ulps);
      });
    } else if (key == "comment") {
      record.comment = read_text(value, key);
    } else if (key == "source_id") {
      record.source_id = read_id(value);
    } else if (key == "certificate") {
      record.certificate = read_certificate(value, Components(*scene));
    } else {
      skip(value);
    }
  }

  void take_scene(const LineReader::Line& line, const std::vector<std::string>& keys, Scene&& read) {
    for (const char* other : {"golden", "id", "x", "v", "from"})
      if (std::find(keys.begin(), keys.end(), other) != keys.end())
        throw InputError(std::string("a scene's line has no ") + other);
    if (const auto flaw = oracle::dependence_in(read)) throw InputError(*flaw);
    scene = std::move(read);
    scene_line = line.text;
    ++scenes;
  }

  void read_record(const LineReader::Line& line, const std::vector<std::string>& keys, Record& record) {
    record.question = question_in(line.text, keys);
    bool has_expect = false;
    each_member_of(line, [&](std::string_view key, json::Value value) {
      has_expect |= key == "expect";
      read_field(std::string(key), value, record);
    });
    if (!has_expect || record.id.empty()) throw InputError("a golden record has an id, tags and `expect`");
  }

  // A record, or nothing if the line is a scene or blank.
  bool read(const LineReader::Line& line, ReadRecord& read) {
    if (!line.too_long && line.text.find_first_not_of(" \t\r") == line.text.npos) return false;
    const auto keys = keys_of(line);
    if (std::find(keys.begin(), keys.end(), "golden") != keys.end())
      throw InputError("a golden set has one header, its first line");
    StreamItem item;
    odd.clear();
    exchange.read_query_line(line, scene ? &*scene : nullptr, item);
    if (unknown && item.kind != StreamItem::Kind::bad)  // those of an invalid question are odd on purpose
      for (const std::string& key : odd) unknown(key);
    if (item.kind == StreamItem::Kind::bad && item.bad_scene) throw InputError(item.message);
    // A query that is invalid for another reason does not report a missing scene.
    if (item.kind == StreamItem::Kind::bad && !scene) throw InputError("no scene before this record");
    if (item.kind == StreamItem::Kind::scene) {
      take_scene(line, keys, std::move(item.scene));
      return false;
    }
    read = {};
    read.line = line.number;
    read.text = line.text;
    if (item.kind == StreamItem::Kind::query)
      read.query = std::move(item.query);
    else
      read.flaw = item.message;
    read_record(line, keys, read.record);
    return true;
  }
};

Reader::Reader(const std::string& path, OnUnknownKey on_unknown_key)
    : impl_(std::make_unique<Impl>(path, std::move(on_unknown_key))) {
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

question::Source questions_of(Reader& reader, const Claim& claim) {
  return [&reader, claim, scene = std::size_t{0},
          place = std::shared_ptr<question::Place>()]() mutable -> std::optional<question::Question> {
    ReadRecord read;
    if (!reader.next(read)) return std::nullopt;
    if (scene != reader.scene_number()) place = std::make_shared<question::Place>(reader.scene(), claim);
    scene = reader.scene_number();
    Record& record = read.record;
    if (names_obstacle(record.expect) &&
        !(read.query && names_obstacle(record.expect, *read.query, reader.scene())))
      throw InputError(fmt::format("{}:{}: expect: cannot be right; lorentz golden verify says more",
                                   reader.path(), read.line));
    if (claim.inside != StartInside::inside && record.expect.outcome == Outcome::inside && read.query)
      record.expect = place->exact(*read.query);
    return question::Question{
        .place = place,
        .query = read.query.value_or(Query()),
        .exact = std::move(record.expect),
        .where = record.id,
        .text = read.query ? "" : std::move(record.question),
        .id = json_quoted(record.id),
        .tags = std::move(record.tags),
        .margin = claim.precision == reader.header().precision ? record.margin : std::nullopt};
  };
}

}  // namespace lorentz::golden
