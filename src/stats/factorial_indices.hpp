/// Total-order Sobol indices of a function that is known on a full grid.
///
/// Between the grid's points the function is taken as multilinear, and every argument as
/// uniform over the range of its values; all integrals are then exact, and no further
/// runs are needed. S_T,i = 1 - Var(E[f | all but x_i]) / Var(f) (Saltelli et al. 2010,
/// doi:10.1016/j.cpc.2009.09.018, eq. 4). What the function does between the points
/// remains unseen.
#pragma once

#include <span>
#include <vector>

namespace bemcal::stats {

/// \param axes     rising values of each argument; one value = held there, index 0
/// \param outputs  [product of the axes' sizes], the last argument running fastest
/// \return [axes]; NaN where the function does not vary, or an output is no number.
/// Throws std::invalid_argument where the sizes do not fit.
std::vector<double> total_order_on_grid(const std::vector<std::vector<double>>& axes,
                                        std::span<const double> outputs);

}  // namespace bemcal::stats
