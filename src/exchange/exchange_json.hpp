// JSON values as the exchange formats have them, on simdjson's On-Demand interface. Private to the libraries
// that read these.
#pragma once

#include <simdjson.h>

#include <stdexcept>
#include <string>

#include <lorentz/problem.hpp>
#include "src/exchange/exchange_scene.hpp"

namespace lorentz {

namespace json = simdjson::ondemand;

/// A text that is no JSON (besides what simdjson::simdjson_error says). Not an InputError: behind a bad value
/// a reader goes on, behind what is no JSON it cannot.
struct NotJson : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws InputError beyond 64 levels, far more than any format here has. Recursion is bounded by this.
void check_depth(int depth);

/// Passes over a value. On-Demand checks only what is looked at, so everything is looked at.
void skip(json::value value, int depth = 0);

/// A number or a hexadecimal string; throws InputError, naming `place`.
double read_number(json::value value, const std::string& place);

/// An integer, or a decimal string with one; throws InputError, naming `key`.
Integer read_integer(json::value value, const char* key);

/// An answer's members into a fresh answer; `components` becomes the number of its cell's coordinates. Throws
/// InputError. False for a `golden` header.
bool read_answer(json::object object, std::string& id, Answer& answer, std::size_t& components,
                 const OnUnknownKey& on_unknown_key = {});

/// A value of a scene.
SceneNode read_node(json::value value, const std::string& place = "scene", int depth = 0);

/// True if nothing but white space follows the value that was read.
bool ended(json::document& document);

}  // namespace lorentz
