/// What a posterior of buildings predicts, as datasets: every period of every building,
/// before (as described) and after, with intervals.
#pragma once

#include "study/chain_draws.hpp"
#include "study/posterior_density.hpp"

namespace bemcal::study {

struct CalibratedBuildings {
    const PosteriorParts& parts;
    const std::vector<Case>& unseen;
    const PosteriorOptions& options;
};

void add_predictions(const CalibratedBuildings& buildings, const ChainDraws& draws,
                     DatasetBuilder& datasets);

const Period& training_period(const Case& building, const PosteriorOptions& options);

/// The mean size of what the building as described would read. [chosen meters]
std::vector<double> nominal_scales(const BuildingModel& model);

/// The meters that train, and which of their readings do.
MeterChoice training_choice(const Case& building, const Period& period,
                            const PosteriorOptions& options);

}  // namespace bemcal::study
