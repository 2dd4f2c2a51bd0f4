/// Before any fit: whether the model of a building can reach what its meters show, over
/// the ranges of its parameters; and where it cannot, which unit would mend that.
#pragma once

#include "job/job.hpp"
#include "study/range.hpp"
#include "study/stage.hpp"

#include <string>
#include <vector>

namespace bemcal::job {

/// A meter that a study fits.
struct FittedRange {
    study::MeterRange range;
    std::string beyond;  ///< how far it lies outside, in a sentence; empty = it does not
};

/// Of the meters of energy that the job's studies fit, in the periods in which they do,
/// in the order of the building. Throws as study::ranges_of.
std::vector<FittedRange> fitted_ranges(const Job& job, const study::Case& building);

/// For the result: BUILDING/data/range_*, and a shortfall where a meter lies outside.
std::vector<study::Dataset> range_datasets(const study::Case& building,
                                           const std::vector<FittedRange>& ranges);

/// How far the model is from a meter, in a sentence; empty = it reaches it.
std::string words_of_range(const study::Case& building, const study::MeterRange& range);

}  // namespace bemcal::job
