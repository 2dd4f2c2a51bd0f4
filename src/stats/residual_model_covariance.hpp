/// The filter's covariances of the state (a, m, d), which is seen as a + m without noise,
/// and the way back through each step. Internal to the residual model.
///
/// A derivative by a symmetric matrix is written as a whole symmetric matrix M: the value
/// changes by the sum of M_ij dP_ij over all i and j.
#pragma once

#include "stats/residual_model_motion.hpp"

namespace bemcal::stats::residual {

struct State {
    Lanes a, m, d;
};
inline State no_state() {
    return {all(0), all(0), all(0)};
}

struct Covariance {
    Lanes aa, am, ad, mm, md, dd;
};
inline Covariance no_covariance() {
    return {all(0), all(0), all(0), all(0), all(0), all(0)};
}
Covariance operator+(const Covariance& p, const Covariance& q);
Covariance choose(const Eigen::Array<bool, width, 1>& where, const Covariance& yes,
                  const Covariance& no);

/// What a reading moves the state by, and how far it was expected to stray.
struct Gain {
    State k;
    Lanes variance, precision;
};
struct GainSlope {
    State k;
    Lanes variance;
};
GainSlope choose(const Eigen::Array<bool, width, 1>& where, const GainSlope& yes,
                 const GainSlope& no);

/// Before a reading, from after the reading before.
Covariance predicted(const Motion& motion, const Covariance& filtered);
Covariance predicted_back(const Transition& transition, const Covariance& slope);
/// Adds the derivative by the motion.
void add_motion_slope(const Transition& transition, const Covariance& filtered,
                      const Covariance& slope, Motion& sum);

Gain gain_of(const Covariance& predicted);
Covariance gain_back(const Gain& gain, const GainSlope& slope);

/// After the reading.
Covariance filtered(const Covariance& predicted, const Gain& gain);
Covariance filtered_back(const Gain& gain, const Covariance& slope);

}  // namespace bemcal::stats::residual
