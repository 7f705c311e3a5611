// The engines `batch` and `certified-batch` as subjects of campaigns.
#pragma once

#include <lorentz/batch.hpp>
#include "fuzz/examine/subject.hpp"

namespace lorentz::fuzz {

/// Queries are flown together, and each besides alone: what a batch and a single flight do not both say, to
/// the bit, is an error. Single flights are the engine's, or as they are told here.
using FlyAlone = std::function<Flight(const Batch&, const Query&, double max_time, Batch::Time)>;
std::unique_ptr<Subject> make_batch_subject(FlyAlone fly_alone = {});

/// Queries are flown together, and what the batch is not certain of is asked alone.
std::unique_ptr<Subject> make_certified_batch_subject();

}  // namespace lorentz::fuzz
