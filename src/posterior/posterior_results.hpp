/// What a posterior of buildings predicts, as datasets: every period of every building,
/// before (as described) and after, with intervals.
#pragma once

#include "posterior/chain_draws.hpp"
#include "posterior/posterior_density.hpp"

namespace bemcal::posterior {

struct CalibratedBuildings {
    const PosteriorParts& parts;
    const std::vector<study::Case>& unseen;
    const PosteriorOptions& options;
};

struct PredictedFits {
    /// Of a building that is alone: each period and meter of its case, of the readings
    /// that train where some do.
    std::vector<study::FoundFit> fits;
    std::string bias;  ///< beyond Guideline 14 in a training period; empty = none
};
PredictedFits add_predictions(const CalibratedBuildings& buildings,
                              const ChainDraws& draws, study::DatasetBuilder& datasets);

const study::Period& training_period(const study::Case& building,
                                     const PosteriorOptions& options);

/// The mean size of what the building as described would read. [chosen meters]
std::vector<double> nominal_scales(const BuildingModel& model);

/// The meters that train, and which of their readings do.
MeterChoice training_choice(const study::Case& building, const study::Period& period,
                            const PosteriorOptions& options);

}  // namespace bemcal::posterior
