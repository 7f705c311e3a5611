// A query for people to copy, exact to the bit.
#pragma once

#include <string>
#include <vector>

#include <lorentz/query.hpp>
#include <lorentz/scene.hpp>

namespace lorentz::report {

/// The first `dimension` components, as "0x1.8p-1".
std::vector<std::string> hexadecimal(const Vec& a, int dimension);

/// {"x":["0x1.8p-1","0x0p+0"],"v":[..]}, with `from` if the query has it, in the exchange format. A 2D query
/// has two components.
std::string hexadecimal_query(const Query& query, const Components& count);

}  // namespace lorentz::report
