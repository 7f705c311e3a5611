// What another program says of itself, and of the time that its own calls took (docs/command_engines.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lorentz/claim.hpp>

namespace lorentz::question {

/// `{"engine":{"name":..,"version":..,"precision":..,"time_tolerance":..,"dimensions":[..]}}`: each may be left out.
struct Introduction {
  std::string name = {}, version = {};
  std::optional<NumberFormat> precision = {};
  std::optional<double> time_tolerance = {};  ///< as Claim::time_tolerance
  std::vector<int> dimensions = {};           ///< empty: not said
};

/// Nothing if the line does not begin with an object whose first key is "engine". Throws InputError for one that
/// says something impossible.
std::optional<Introduction> introduction_in(std::string_view line);

/// What the program says when its input is empty. Nothing if it says nothing, fails, or does not end in ten seconds.
std::optional<Introduction> introduction_of_command(const std::string& command);

/// The time of an engine's own calls, without pipes and text.
struct OwnTime {
  double seconds = 0;
  double queries = 0;

  std::optional<double> ns_per_query() const;  ///< nothing without queries
};

/// `{"engine_time":{"seconds":..,"queries":..}}`. Nothing if the line is another; throws InputError for numbers that
/// cannot be.
std::optional<OwnTime> own_time_in(std::string_view line);

}  // namespace lorentz::question
