/// Errors that last for weeks. A likelihood of residuals without a slow part knows none,
/// but means over months need them: predictions of other periods than the training one
/// draw residuals of the same size, of which a share is slow. The share is what the
/// training period's residuals show: the variance of their means over blocks of weeks,
/// less what independent ones would have.
#pragma once

#include "posterior/building_model.hpp"

namespace bemcal::posterior {

/// Of the variance of residuals, for each meter of the model; 0 where there are fewer
/// than 6 blocks with half of their readings.
/// \param points  draws of the posterior, on the model's own period
std::vector<double> lasting_shares(const BuildingModel& trained,
                                   const BuildingModel::Points& points, double weeks);

/// The same points for a model of the same meters whose residuals have a slow part.
BuildingModel::Points with_lasting_errors(const BuildingModel& trained,
                                          const BuildingModel::Points& points,
                                          const BuildingModel& model,
                                          const std::vector<double>& shares,
                                          double weeks);

}  // namespace bemcal::posterior
