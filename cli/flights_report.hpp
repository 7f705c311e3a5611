// Private to cli/flights*.cpp: what many flights came to, for people and for programs.
#pragma once

#include <optional>
#include <string>

#include "flights/account.hpp"
#include "flights/plan.hpp"

namespace lorentz::cli {

struct FlightsReport {
  std::string scene_name;  ///< as it was asked for
  flights::Plan plan;
  flights::Account account;
  std::optional<double> seconds;  ///< of this run

  /// False: stopped early, or a shard's.
  bool is_whole() const { return account.done.size() == plan.blocks(); }

  /// The scene's name, and the radius if all obstacles have the same.
  std::string name_with_radius() const;

  std::string table() const;
  std::string json() const;  ///< one object
  std::string csv() const;   ///< the bins, with what theory expects in them
  std::string svg() const;
};

}  // namespace lorentz::cli
