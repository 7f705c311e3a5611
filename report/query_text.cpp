#include "report/query_text.hpp"

#include <fmt/format.h>

#include <lorentz/exchange.hpp>

namespace lorentz::report {
namespace {

std::string vector_text(const Vec& a, int dimension) {
  std::string text;
  for (int i = 0; i < dimension; ++i) text += fmt::format("{}\"{:a}\"", i ? "," : "[", a[i]);
  return text + ']';
}

}  // namespace

std::string hexadecimal_query(const Query& query, int dimension) {
  std::string text =
      fmt::format("{{\"x\":{},\"v\":{}", vector_text(query.x, dimension), vector_text(query.v, dimension));
  if (query.from) {
    text += fmt::format(",\"from\":{{\"lattice\":{},\"atom\":{},\"cell\":", query.from->lattice,
                        query.from->atom);
    for (int i = 0; i < dimension; ++i) append_integer(text += i ? ',' : '[', query.from->cell[i]);
    text += "]}";
  }
  return text + '}';
}

}  // namespace lorentz::report
