// Judges answers with a golden set alone (docs/golden.md).
//   runner SET ANSWERS [ULPS]: a line for each record, its id and a verdict; the counts on stderr.
//   ULPS is above 0 and at most 16. Status 1: an answer is wrong, missing, or an error; 2: a file is unfit.
//   c++ -std=c++17 runner.cpp -o runner    # nlohmann-json3-dev
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

using Json = nlohmann::json;

// An integer as text; it is a decimal string beyond 2^53. Empty for anything else.
static std::string integer(const Json& n) {
  if (n.is_string()) return n.get<std::string>();
  const double number = n.is_number() ? n.get<double>() : 0.5;
  return number == std::floor(number) ? std::to_string(n.get<long long>()) : "";
}

static bool same(const Json& a, const Json& b) {
  for (const char* key : {"outcome", "lattice", "atom"})
    if (a.value(key, Json()) != b.value(key, Json())) return false;
  const Json one = a.value("cell", Json::array()), other = b.value("cell", Json::array());
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const Json& m, const Json& n) { return integer(m) == integer(n); });
}

static double ulp(double t, bool binary32) {
  const int exponent = t > 0 ? std::ilogb(t) : -1074;
  return binary32 ? std::ldexp(1, std::max(exponent, -126) - 23)
                  : std::ldexp(1, std::max(exponent - 52, -1074));
}

static bool is_wrong_time(const Json& record, const Json& answer, double ulps, bool binary32) {
  const Json& expect = record["expect"];
  if (!expect.contains("time") || !answer.contains("time")) return false;
  constexpr double kLargest = 3.4028235677973366e38;  // from here on a binary32 is infinite
  const bool says_infinite = answer["time"] == "inf";
  if (expect["time"] == "inf" || (says_infinite && binary32 && expect["time"] > kLargest))
    return !says_infinite;
  const double t = expect["time"];
  const double given = answer["time"].is_number() ? answer["time"].get<double>() : INFINITY;
  return !(std::fabs(given - t) <= ulps * std::max(record.value("time_change", 0.0), ulp(t, binary32)));
}

static const char* verdict(const Json& record, const Json& answer, double ulps, bool binary32) {
  if (answer.is_null()) return "missing";
  const std::string outcome = answer.value("outcome", "");
  if (outcome == "undecided" || outcome == "later") return "undecided";
  if (outcome == "error" && record["expect"]["outcome"] != "error")
    return answer.value("reason", "") == "unsupported" ? "unsupported" : "error";
  if (same(answer, record["expect"]))
    return is_wrong_time(record, answer, ulps, binary32) ? "wrong-time" : "agree";
  for (const Json& other : record.value("acceptable", Json::array()))
    if (same(answer, other) && other["ulps"] <= ulps) return "ill-posed";
  for (const Json& tag : record["tags"])
    if (tag == "needs-judge") return "needs-judge";
  return "wrong";
}

static void refuse(const std::string& why) {
  std::cerr << why << '\n';
  std::exit(2);
}

// All lines that are not blank.
static void read(const std::string& name, const std::function<void(const Json&)>& use) {
  std::ifstream file(name);
  int number = 0;
  for (std::string line; ++number, std::getline(file, line);) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      use(Json::parse(line));
    } catch (const Json::exception& why) {
      refuse(name + ':' + std::to_string(number) + ": " + why.what());
    }
  }
  if (!file.is_open() || file.bad()) refuse(name + ": cannot be read");
}

int main(int count, char** arguments) {
  const double ulps = count > 3 ? std::strtod(arguments[3], nullptr) : 4;
  if (count < 3 || !(ulps > 0 && ulps <= 16))
    refuse("usage: runner SET ANSWERS [ULPS]; ULPS is above 0 and at most 16");
  std::map<std::string, Json> answers;
  read(arguments[2], [&](const Json& answer) {
    if (!answer.contains("id") || !answer["id"].is_string()) return;
    const std::string id = answer["id"];
    if (!answers.emplace(id, answer).second) refuse(arguments[2] + (": the id " + id) + " comes twice");
  });
  std::map<std::string, int> counts;
  Json header;
  int records = 0;
  read(arguments[1], [&](const Json& record) {
    if (header.is_null()) header = record.value("golden", Json::object());
    if (!record.contains("expect")) return;
    const std::string id = record["id"];
    const auto answer = answers.find(id);
    const bool binary32 = header.value("precision", "") == "binary32";
    const char* found = verdict(record, answer == answers.end() ? Json() : answer->second, ulps, binary32);
    ++counts[found], ++records;
    std::cout << id << ' ' << found << '\n';
  });
  if (!header.is_object() || header.value("count", Json()) != records)
    refuse(arguments[1] +
           std::string(": needs a first line with `golden`, and as many records as its `count`"));
  for (const auto& [name, number] : counts) std::cerr << name << ' ' << number << '\n';
  return counts.count("wrong") || counts.count("missing") || counts.count("error") ? 1 : 0;
}
