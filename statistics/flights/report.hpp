// What many flights came to, for people and for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "statistics/flights/account.hpp"
#include "statistics/flights/plan.hpp"

namespace lorentz::flights {

struct FlightsReport {
  std::string scene_name;        ///< as it was asked for
  std::optional<double> radius;  ///< of all balls, where several were asked for
  FlightsPlan plan;
  Account account;
  std::optional<double> seconds;  ///< of this run

  /// False: stopped early, or a shard's.
  bool is_whole() const { return account.done.size() == plan.blocks(); }

  std::string table() const;
  std::string json() const;  ///< one object, in a line
};

/// The bins, with what theory expects in them; of several radii with the radius before each row.
std::string csv_of(const std::vector<FlightsReport>& reports);

/// The report of a page (docs/page.md), of kind "flights".
std::string page_json(const std::vector<FlightsReport>& reports, const std::string& command);

/// Pictures of one scene at one or several radii: P(free path > t) on logarithmic axes, and the density on
/// linear ones. Throw InputError if nothing was hit.
std::string survival_svg(const std::vector<FlightsReport>& reports);
std::string density_svg(const std::vector<FlightsReport>& reports);

}  // namespace lorentz::flights
