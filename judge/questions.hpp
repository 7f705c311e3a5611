// Sources of questions: drawn flights, golden sets, and the families of hard cases.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/campaign/campaign.hpp"
#include "judge/examination.hpp"
#include "question/starts/free_starts.hpp"

namespace lorentz::judge {

/// A scene and its name: "square, r = 0.1".
struct NamedPlace {
  std::string name;
  std::shared_ptr<Place> place;
};

/// The place in which an engine with this claim is asked: the scene's numbers are rounded to its precision.
std::shared_ptr<Place> place_for(const Scene& scene, const Claim& claim);

/// `count` starts of a kind, a few of each place in turn. Places beyond the engine are left out. The places
/// must outlast the source.
Source drawn(const std::vector<NamedPlace>& places, starts::Kind kind, std::uint64_t seed, std::size_t count);

/// The records of a golden set that consist of numbers of the claim's precision; only the first ones of a
/// scene that is beyond the engine. Throws as golden::Reader does.
Source golden_set(const std::string& path, const Claim& claim = {});

/// What the targets of a campaign get in equal parts: time (a few targets take a hundred times as long as
/// others), or scenes.
enum class Fairness { of_time, of_scenes };

/// Cases of all targets of campaigns in turn, without end; and for one case of each scene the variants that
/// climb to the smallest margin. Only scenes that the scope admits are used, and of these only number `part`
/// modulo `parts`. All cases consist of numbers of the claim's precision.
Source campaign(std::uint64_t seed, const fuzz::Scope& scope, Fairness fairness = Fairness::of_time,
                unsigned part = 0, unsigned parts = 1, const Claim& claim = {});

/// The narrowest scope that contains all the places in which the engine answered (a single ball and a single
/// disc are in one scope); all scenes if it answered nowhere.
fuzz::Scope scope_of(const std::vector<NamedPlace>& places);

}  // namespace lorentz::judge
