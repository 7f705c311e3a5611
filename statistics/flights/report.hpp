// The results of many flights, beside the predictions of theory, as text, JSON, CSV and pages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "statistics/flights/account.hpp"
#include "statistics/theory/fit.hpp"
#include "statistics/theory/laws.hpp"

namespace lorentz::flights {

struct FlightsReport {
  std::string scene_name;        ///< as given by the user
  std::optional<double> radius;  ///< of all balls, if several radii were given
  FlightsPlan plan;
  Account account;
  std::optional<double> seconds;  ///< of this run

  /// False if the run was stopped early.
  bool is_whole() const { return account.done.size() == plan.blocks(); }

  std::string table() const;
  std::string json() const;  ///< one object on one line
};

/// The predictions of theory for a run, and how well the counts fit them.
/// Flights that the engine answers with `undecided` are in no bin.
struct FlightsFindings {
  explicit FlightsFindings(const FlightsReport& report);

  std::vector<double> edges;                  ///< edges of the logarithmic bins
  std::vector<std::uint64_t> counts, beyond;  ///< beyond[i]: longer than edges[i], or endless
  std::uint64_t total = 0;
  std::optional<Law> law;
  std::string no_law;           ///< why no law is known
  ChiSquared fit, fit_of_more;  ///< of the law; of 1.02 times its survival, for the power of the test
  std::optional<double> exponent_of_law;  ///< of its density, from where `exponent` begins
  std::vector<Tail> tails;                ///< the tail of long paths is the last
  std::optional<TailExponent> exponent;
  MeanFreePath mean;  ///< between collisions

  /// The measured constant of a tail that is approached so slowly that its constant must be extrapolated.
  std::optional<TailConstant> measured_constant_of(const Tail& tail) const;

 private:
  ChiSquared fit_of(const std::function<double(double)>& survival) const;
};

/// The bins, with the expectation of theory. With several scenes, rows begin with scene and radius; with one
/// scene at several radii, they begin with the radius.
std::string csv_of(const std::vector<FlightsReport>& reports);

/// The report of a page (docs/page.md), of kind "flights".
std::string page_json(const std::vector<FlightsReport>& reports, const std::string& command);

}  // namespace lorentz::flights
