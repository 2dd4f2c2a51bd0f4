/// What a meter's residuals are made of, and the parameters that this needs.
#pragma once

#include <string>
#include <vector>

namespace bemcal::stats {

struct ResidualOptions {
    bool autocorrelated = true;  ///< AR(1) in place of white
    bool discrepancy = false;    ///< and a share of Matern-3/2
    /// With discrepancy: the filter's gain is held once it has settled (again after each
    /// gap).
    bool steady_state = true;
    /// Whether the proportional part is unknown, or 0: where the model is wrong in shape,
    /// a scale that follows the prediction rewards predicting too little.
    bool proportional = true;
};

/// Names in the order of the parameters: constant (a multiple of the meter's scale),
/// proportional, then phi (0 to below 1), then share (0 to 1) and timescale (above 0;
/// readings' intervals; covariance (1 + r) exp(-r) with r = sqrt(3) distance /
/// timescale), as the options have them.
std::vector<std::string> residual_parameters(const ResidualOptions& options);

}  // namespace bemcal::stats
