// Invalid queries that a reader of the exchange format must refuse.
#pragma once

#include <string>
#include <vector>

#include "question/cases/case.hpp"

namespace lorentz::cases {

/// A query as JSON text, without the braces and the id: `"x":[0,0],"v":[0,0]`. The text is well-formed JSON;
/// only its content is invalid. It begins with "x" unless x is missing.
struct BadQuery {
  std::string text, tag;
};

/// All invalid queries, each different.
const std::vector<BadQuery>& bad_queries();

const std::vector<Tag>& bad_query_tags();

/// The scene in which they are asked: the square lattice with two discs per cell.
const Scene& bad_query_scene();

}  // namespace lorentz::cases
