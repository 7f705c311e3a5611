#include "report/cell_store.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>
#include "src/exchange/exchange_json.hpp"

namespace lorentz::report {

std::string CellStore::text() const {
  std::string out =
      fmt::format("{{\"bench\":1,\"options\":{},\"scenes\":{},\"program\":{},\"manifest\":{}}}\n",
                  json_quoted(run.options), json_quoted(run.scenes), json_quoted(run.program), manifest);
  for (const Cell& cell : cells) {
    append_cell(out, cell);
    out += '\n';
  }
  return out;
}

namespace {

void read_header(std::string_view line, CellStore& store) {
  const simdjson::padded_string padded(line);
  json::parser parser;
  json::document document = parser.iterate(padded);
  json::object object = document.get_object();
  if (std::uint64_t(object["bench"]) != 1) throw InputError("");
  const auto text = [&](const char* key) { return std::string(std::string_view(object[key])); };
  store.run.options = text("options");
  store.run.scenes = text("scenes");
  store.run.program = text("program");
  store.manifest = std::string(std::string_view(json::object(object["manifest"]).raw_json()));
}

}  // namespace

CellStore CellStore::of(std::string_view text) {
  CellStore store;
  std::size_t number = 0;
  try {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (++number == 1)
        read_header(line, store);
      else
        store.cells.push_back(cell_of(line));
    }
    if (number == 0) throw InputError("");
  } catch (const std::exception&) {  // what simdjson calls it says nothing to who named the file
    throw InputError(fmt::format(
        "line {} is none of a store of cells: the file is of another kind, or was cut off", number));
  }
  return store;
}

void CellStore::check(const Run& other) const {
  if (run.options != other.options)
    throw InputError(
        fmt::format("holds the cells of a run with other options: {}; not {}", run.options, other.options));
  if (run.scenes != other.scenes)
    throw InputError("holds the cells of other scenes: a scene file has changed since");
  if (run.program != other.program)
    throw InputError(fmt::format("holds cells that another program or machine measured: {}; not {}",
                                 run.program, other.program));
}

}  // namespace lorentz::report
