#include "question/introduction.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "src/exchange/exchange_json.hpp"

namespace lorentz::question {
namespace {

constexpr double kToIntroduce = 10, kLongest = 1e6;  // seconds
constexpr std::chrono::milliseconds kToEnd{1000};

// Reads the object with this key in the object that the line is. Returns false if there is none, or the line has an id,
// as answers have, which may have members of any name; a value of another kind is meant only in the first place.
template <class Read>
bool read_member(std::string_view line, std::string_view key, const Read& read) {
  if (line.find('"' + std::string(key) + '"') == line.npos)
    return false;  // as the lines of a million answers
  std::optional<std::string> member;
  bool has_id = false, is_first = true;
  try {
    json::Document document;
    document.open(line);
    json::each_member(document.object(), [&](std::string_view name, json::Value value) {
      has_id |= name == "id";
      const bool is_meant = std::exchange(is_first, false) || value.type() == json::Type::object;
      if (name == key && is_meant)
        member = value.raw();
      else
        skip(value);
    });
    if (!member || has_id) return false;
    document.open(*member);
    json::each_member(document.object(), read);
    return true;
  } catch (const NotJson& error) {
    throw InputError(fmt::format("{}: {}", key, error.what()));
  }
}

double not_negative(json::Value value, const char* what, bool is_finite = false) {
  const double number = is_finite ? read_number(value, what) : read_number_or_infinity(value, what);
  if (std::isnan(number) || number < 0) throw InputError(fmt::format("{} is below zero", what));
  return number;
}

std::vector<int> dimensions_in(json::Value value) {
  std::vector<int> dimensions;
  json::each_element(value, [&](json::Value one) {
    const std::int64_t dimension = one.integer();
    if (dimension != 2 && dimension != 3) throw InputError("dimensions are 2 and 3");
    dimensions.push_back(static_cast<int>(dimension));
  });
  return dimensions;
}

Domain::Range range_in(json::Value value, std::string_view key) {
  const std::string name = "domain: " + std::string(key);
  std::vector<double> ends;
  json::each_element(value, [&](json::Value end) { ends.push_back(not_negative(end, name.c_str())); });
  if (ends.size() != 2 || ends[0] > ends[1]) throw InputError(name + " needs two numbers, the smaller first");
  return {ends[0], ends[1]};
}

void read_shapes(json::Value value, Domain& domain) {
  domain.balls = domain.ellipsoids = false;
  json::each_element(value, [&](json::Value shape) {
    const std::string_view name = shape.text();
    if (name != "ball" && name != "ellipsoid") throw InputError("domain: shapes are ball and ellipsoid");
    (name == "ball" ? domain.balls : domain.ellipsoids) = true;
  });
}

void note(std::vector<std::string>& unknown, std::string_view key,
          std::initializer_list<std::string_view> known) {
  if (std::ranges::find(known, key) == known.end()) unknown.emplace_back(key);
}

Domain domain_in(json::Value value, std::vector<std::string>& unknown) {
  Domain domain;
  json::each_member(value, [&](std::string_view key, json::Value its) {
    for (const NamedRange& named : kDomainRanges)
      if (key == named.name) domain.*named.range = range_in(its, key);
    if (key == "shapes") read_shapes(its, domain);
    if (key == "limits") domain.limits = its.boolean();
    note(unknown, key, {"speed", "coordinates", "radius", "flight", "shapes", "limits"});
  });
  return domain;
}

StartInside rule_called(std::string_view name) {
  if (const auto rule = start_inside_named(name)) return *rule;
  throw InputError("inside is inside, miss, zero, exit or unsupported, not " + json_quoted(name));
}

}  // namespace

NumberFormat format_called(std::string_view name) {
  for (const NumberFormat format : {NumberFormat::binary64, NumberFormat::binary32})
    if (name == name_of(format)) return format;
  throw InputError("precision is binary64 or binary32, not " + json_quoted(std::string(name)));
}

std::optional<Introduction> introduction_in(std::string_view line) {
  Introduction made;
  if (line.starts_with('{') && line.find('}') == line.npos)
    throw InputError("its introduction does not stand in one line");
  const bool is_there = read_member(line, "engine", [&](std::string_view key, json::Value value) {
    if (key == "name") made.name = value.text();
    if (key == "version") made.version = value.text();
    if (key == "precision") made.precision = format_called(value.text());
    if (key == "time_tolerance" && !value.is_null())
      made.time_tolerance = not_negative(value, "time_tolerance");
    if (key == "dimensions") made.dimensions = dimensions_in(value);
    if (key == "domain") made.domain = domain_in(value, made.unknown);
    if (key == "inside") made.inside = rule_called(value.text());
    note(made.unknown, key,
         {"name", "version", "precision", "time_tolerance", "dimensions", "domain", "inside"});
  });
  if (!made.dimensions.empty()) {
    Domain& domain = made.domain ? *made.domain : made.domain.emplace();
    const auto has = [&](int dimension) {
      return std::ranges::find(made.dimensions, dimension) != made.dimensions.end();
    };
    domain.dimension_2 = has(2), domain.dimension_3 = has(3);
  }
  return is_there ? std::optional(made) : std::nullopt;
}

FirstWords first_words_of(const Executable& program, double seconds) {
  using Clock = std::chrono::steady_clock;
  Process process(program);
  process.hide_errors();  // its complaints are shown when it is asked queries
  process.close_input();
  LineBuffer lines;
  LineReader::Line line;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(std::min(seconds, kLongest)));
  for (;;) {
    if (lines.next(line)) return {std::string(line.text)};
    if (lines.is_too_long()) return {{}, "wrote a line beyond 1 MiB"};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return {{}, fmt::format("gave no answer within {:.4g} s", seconds)};
    pollfd pipes[2] = {{process.output(), POLLIN, 0}, {process.errors(), POLLIN, 0}};
    ::poll(pipes, 2, static_cast<int>(left.count()));
    process.pass_on_errors();
    if (lines.read_from(process.output()) != LineBuffer::Read::end) continue;
    if (lines.next(line)) return {std::string(line.text)};
    return {{}, fmt::format("died ({})", process.end(kToEnd).text())};
  }
}

std::optional<Introduction> introduction_of_command(const std::string& command, double seconds) {
  // Its complaints are shown when it is asked queries.
  Executable silent = shell_command(command);
  silent.arguments.back() = "{ " + command + "\n} 2>/dev/null";
  const FirstWords said = first_words_of(silent, std::min(seconds, kToIntroduce));
  return said.line ? introduction_in(*said.line) : std::nullopt;
}

std::optional<OwnTime> own_time_in(std::string_view line, const OnUnknownKey& on_unknown_key) {
  OwnTime time;
  const bool is_there = read_member(line, "engine_time", [&](std::string_view key, json::Value value) {
    if (key == "seconds")
      time.seconds = not_negative(value, "engine_time: seconds", true);
    else if (key == "queries")
      time.queries = static_cast<double>(value.natural());
    else if (on_unknown_key)
      on_unknown_key("engine_time." + std::string(key));
  });
  return is_there ? std::optional(time) : std::nullopt;
}

std::optional<std::string> doing_in(std::string_view line) {
  std::string doing;
  const bool is_there = read_member(line, "library", [&](std::string_view key, json::Value value) {
    if (key == "does") doing = value.text();
  });
  return is_there ? std::optional(doing) : std::nullopt;
}

}  // namespace lorentz::question
