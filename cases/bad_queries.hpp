// Invalid queries: what a reader of the exchange format must refuse.
#pragma once

#include <string>
#include <vector>

#include "cases/case.hpp"

namespace lorentz::cases {

/// A query as JSON text, without the braces and the id: `"x":[0,0],"v":[0,0]`. It is well-formed JSON (only
/// what it says is wrong), and begins with "x" unless x is what is missing.
struct BadQuery {
  std::string text, tag;
};

/// All there are, each different.
const std::vector<BadQuery>& bad_queries();

const std::vector<Tag>& bad_query_tags();

/// The scene that they are asked in: the square lattice with two discs a cell.
const Scene& bad_query_scene();

}  // namespace lorentz::cases
