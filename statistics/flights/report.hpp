// The results of many flights as text, JSON, CSV, pictures and pages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "statistics/flights/account.hpp"

namespace lorentz::flights {

struct FlightsReport {
  std::string scene_name;        ///< as given by the user
  std::optional<double> radius;  ///< of all balls, if several radii were given
  FlightsPlan plan;
  Account account;
  std::optional<double> seconds;  ///< of this run

  /// False if the run was stopped early or is one shard.
  bool is_whole() const { return account.done.size() == plan.blocks(); }

  std::string table() const;
  std::string json() const;  ///< one object on one line
};

/// The bins, with the expectation of theory. With several scenes, rows begin with scene and radius; with one
/// scene at several radii, they begin with the radius.
std::string csv_of(const std::vector<FlightsReport>& reports);

/// The report of a page (docs/page.md), of kind "flights".
std::string page_json(const std::vector<FlightsReport>& reports, const std::string& command);

struct PictureStyle {
  std::optional<std::string> title;  ///< replaces the default of scene and starts
  double width = 800, height = 600;  ///< in pixels
};

/// Pictures of one or several scenes and radii: P(free path > t) on logarithmic axes, and the density on
/// linear axes. Throw InputError if nothing was hit.
std::string survival_svg(const std::vector<FlightsReport>& reports, const PictureStyle& style);
std::string density_svg(const std::vector<FlightsReport>& reports, const PictureStyle& style);

/// Whether all reports have the same scene; radii may differ.
bool are_of_one_scene(const std::vector<FlightsReport>& reports);

}  // namespace lorentz::flights
