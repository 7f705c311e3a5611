#include "report/query_text.hpp"

#include <fmt/format.h>

#include "src/exchange/exchange_write.hpp"

namespace lorentz::report {

std::vector<std::string> hexadecimal(const Vec& a, int dimension) {
  std::vector<std::string> texts;
  for (const double x : components(a, dimension)) texts.push_back(fmt::format("{:a}", x));
  return texts;
}

std::string hexadecimal_query(const Query& query, const Components& count) {
  return json::text_of([&](json::Members& object) {
    object.add("x", hexadecimal(query.x, count.of_vectors()), "v", hexadecimal(query.v, count.of_vectors()));
    if (query.from) object.add("from", [&](json::Members& from) { add_obstacle(from, *query.from, count); });
  });
}

}  // namespace lorentz::report
