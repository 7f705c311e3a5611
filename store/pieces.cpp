#include "store/pieces.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_json.hpp"
#include "src/exchange/json_writer.hpp"
#include "store/check.hpp"

namespace lorentz::store {
namespace {

constexpr std::string_view kCheck = ",\"check\":\"";

// The check of a line begins with the line before it: none can be left out, moved, or taken from another run.
std::string with_check(const std::string& line, std::uint64_t begin) {
  return fmt::format("{}{}{:016x}\"}}", line, kCheck, check_of(line, begin));
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(what + kRemedy);
}

// A line without its check. Throws InputError if it has none, or another one.
std::string_view checked(std::string_view line, std::uint64_t begin) {
  const std::size_t at = line.rfind(kCheck);
  if (at == std::string_view::npos)
    refuse("has no checksum: the file is of another kind or version, or was cut off");
  if (with_check(std::string(line.substr(0, at)), begin) != line)
    refuse("is damaged: it is not what its checksum was made of");
  return line.substr(0, at);
}

std::string header_of(std::string_view kind, const Plan& plan) {
  std::string line = json::text_of([&](json::Members& header) {
    header.add("store", kind, "format", 2, "plan", [&](json::Members& words) {
      for (const auto& [name, value] : plan) words.add_named(name, value);
    });
  });
  line.pop_back();  // the check is a member, too
  return line;
}

// What is different in a header that is not the one of this kind and plan.
std::string difference(std::string_view line, std::string_view kind, const Plan& plan) {
  json::Document document;
  document.open(line);
  json::Object header = document.object();
  if (const std::string_view other = header["store"].text(); other != kind)
    return fmt::format("is a store of `lorentz {}`", other);
  std::size_t same = 0;
  bool another_version = false;
  std::string other_value;
  json::each_member(header["plan"].object(), [&](std::string_view name, json::Value value) {
    another_version |= same == plan.size() || name != plan[same].first;
    if (another_version || !other_value.empty()) return;
    if (const std::string_view text = value.text(); text != plan[same].second)
      other_value = fmt::format("is of another run: its {} is {}, not {}", name, json_quoted(text),
                                json_quoted(plan[same].second));
    ++same;
  });
  if (!other_value.empty()) return other_value;
  return "is of another version of this program";
}

void check_header(std::string_view line, std::string_view kind, const Plan& plan) {
  checked(line, kCheckOfNothing);
  if (line == with_check(header_of(kind, plan), kCheckOfNothing)) return;
  try {
    throw InputError(difference(line, kind, plan) + "; give what it was begun with, or name another file");
  } catch (const json::Error&) {
    refuse("is of another kind");
  }
}

constexpr std::string_view kPiece = "{\"piece\":";

std::string piece_in(std::string_view line, std::uint64_t begin) {
  std::string_view piece = checked(line, begin);
  try {
    if (!piece.starts_with(kPiece)) refuse("is not a piece of a run");
    piece.remove_prefix(kPiece.size());
    json::Document document;
    document.open(piece);
    skip(document.value());
    if (!document.ended()) refuse("is more than one piece");
  } catch (const NotJson& error) {
    refuse(std::string("is not JSON: ") + error.what());
  } catch (const json::Error& error) {
    refuse(std::string("is not JSON: ") + error.what());
  }
  return std::string(piece);
}

}  // namespace

std::string text_of(std::string_view kind, const Plan& plan, const std::vector<std::string>& pieces) {
  std::string line = with_check(header_of(kind, plan), kCheckOfNothing), text = line + '\n';
  for (const std::string& piece : pieces) {
    line = with_check(std::string(kPiece) + piece, check_of(line));
    text += line + '\n';
  }
  return text;
}

std::vector<std::string> pieces_in(std::string_view text, std::string_view kind, const Plan& plan) {
  std::vector<std::string> pieces;
  std::size_t number = 0;
  std::uint64_t begin = kCheckOfNothing;
  if (text.empty()) refuse("line 1 is missing");
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    ++number;
    try {
      if (end == text.size()) refuse("has no end: the file was cut off");
      if (number == 1)
        check_header(line, kind, plan);
      else
        pieces.push_back(piece_in(line, begin));
      begin = check_of(line);
    } catch (const InputError& error) {
      throw InputError(fmt::format("line {} {}", number, error.what()));
    }
    text.remove_prefix(end + 1);
  }
  return pieces;
}

}  // namespace lorentz::store
