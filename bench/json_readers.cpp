// A comparison of JSON readers. Three of them read the same million query lines in alternating rounds:
// simdjson On-Demand reading every value (as src/exchange/exchange_read.cpp does), simdjson's DOM, RapidJSON
// (full precision, iterative). Each sums all components of x and v, so that none can skip its work.
#include <rapidjson/document.h>
#include <simdjson.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <lorentz/exchange.hpp>

namespace {

constexpr int kLines = 1'000'000, kRounds = 7;

struct Lines {
  std::string text;
  std::vector<std::size_t> ends;
};

Lines drawn_lines() {
  Lines lines;
  std::mt19937_64 bits(1);
  const auto uniform = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  for (int i = 0; i < kLines; ++i) {
    lorentz::append_query_line(lines.text, std::to_string(i),
                               {{uniform(), uniform()}, {uniform(), uniform()}, {}}, 2);
    lines.ends.push_back(lines.text.size() - 1);
  }
  lines.text.append(lorentz::LineReader::kPadding, ' ');
  return lines;
}

template <class OnLine>
void each(const Lines& lines, OnLine on_line) {
  std::size_t begin = 0;
  for (const std::size_t end : lines.ends) {
    on_line(lines.text.data() + begin, end - begin);
    begin = end + 1;
  }
}

double ours(const Lines& lines) {
  const lorentz::Scene scene = lorentz::unit_scene(2, 0.1);
  lorentz::ExchangeReader reader;
  lorentz::StreamItem item;
  double sum = 0;
  each(lines, [&](const char* text, std::size_t size) {
    reader.read_query_line({{text, size}, 1, false}, &scene, item);
    sum += item.query.x[0] + item.query.x[1] + item.query.v[0] + item.query.v[1];
  });
  return sum;
}

double simdjson_dom(const Lines& lines) {
  simdjson::dom::parser parser;
  double sum = 0;
  each(lines, [&](const char* text, std::size_t size) {
    const simdjson::dom::element line = parser.parse(text, size, false);
    for (const char* key : {"x", "v"})
      for (const double component : line[key].get_array()) sum += component;
  });
  return sum;
}

double rapidjson_dom(const Lines& lines) {
  constexpr unsigned kFlags = rapidjson::kParseFullPrecisionFlag | rapidjson::kParseIterativeFlag |
                              rapidjson::kParseValidateEncodingFlag;
  double sum = 0;
  each(lines, [&](const char* text, std::size_t size) {
    rapidjson::Document line;
    line.Parse<kFlags>(text, size);
    for (const char* key : {"x", "v"})
      for (const auto& component : line[key].GetArray()) sum += component.GetDouble();
  });
  return sum;
}

}  // namespace

int main() {
  const Lines lines = drawn_lines();
  struct Contender {
    const char* name;
    double (*run)(const Lines&);
    std::vector<double> seconds;
    double sum = 0;
  };
  Contender contenders[] = {{"simdjson On-Demand, as lorentz reads", ours, {}},
                            {"simdjson DOM", simdjson_dom, {}},
                            {"RapidJSON", rapidjson_dom, {}}};
  for (int round = 0; round < kRounds; ++round)
    for (Contender& one : contenders) {
      const auto start = std::chrono::steady_clock::now();
      one.sum = one.run(lines);
      one.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
  for (Contender& one : contenders) {
    std::sort(one.seconds.begin(), one.seconds.end());
    std::printf("%-38s %5.0f ns a line (median of %d; %.0f to %.0f)  sum %.17g\n", one.name,
                one.seconds[kRounds / 2] * 1e9 / kLines, kRounds, one.seconds.front() * 1e9 / kLines,
                one.seconds.back() * 1e9 / kLines, one.sum);
  }
}
