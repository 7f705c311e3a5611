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
  std::optional<double> radius;  ///< of all balls, where several places were asked for, by radius
  FlightsPlan plan;
  Account account;
  std::optional<double> seconds;  ///< of this run

  /// False: stopped early, or a shard's.
  bool is_whole() const { return account.done.size() == plan.blocks(); }

  std::string table() const;
  std::string json() const;  ///< one object, in a line
};

/// The bins, with what theory expects in them. Rows of several scenes begin with scene and radius, rows of one
/// scene at several radii with the radius.
std::string csv_of(const std::vector<FlightsReport>& reports);

/// The report of a page (docs/page.md), of kind "flights".
std::string page_json(const std::vector<FlightsReport>& reports, const std::string& command);

struct PictureStyle {
  std::optional<std::string> title;  ///< instead of scene and starts
  double width = 800, height = 600;  ///< in pixels
};

/// Pictures of one or several scenes and radii: P(free path > t) on logarithmic axes, and the density on
/// linear ones. Throw InputError if nothing was hit.
std::string survival_svg(const std::vector<FlightsReport>& reports, const PictureStyle& style);
std::string density_svg(const std::vector<FlightsReport>& reports, const PictureStyle& style);

/// Whether all are of one scene, at whatever radii.
bool are_of_one_scene(const std::vector<FlightsReport>& reports);

}  // namespace lorentz::flights
