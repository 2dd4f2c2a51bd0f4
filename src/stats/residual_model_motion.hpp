/// How the state of a residual moves over a gap: AR(1) plus Matern-3/2 as (a, m, d),
/// where z = a + m, a has the variance 1 - share, and m and d, the derivative of m
/// divided by sqrt(3) / timescale, have the variance share (Hartikainen and Sarkka 2010).
/// Internal to the residual model.
///
/// With u = sqrt(3) gap / timescale, (m, d) moves by exp(-u) [[1 + u, u], [-u, 1 - u]].
#pragma once

#include "stats/residual_model_parameters.hpp"

namespace bemcal::stats::residual {

/// a' = rho a, (m, d)' = [[mm, md], [dm, dd]] (m, d).
struct Transition {
    Lanes rho, mm, md, dm, dd;
};

/// Covariance of what is new.
struct Noise {
    Lanes aa, mm, md, dd;
};

struct Motion {
    Transition transition;
    Noise noise;
};
Motion no_motion();  ///< all of it 0

/// \param gap  [intervals]; 0 = the stationary start, which remembers nothing
Motion motion_over(const ParameterLanes& parameters, std::size_t gap);

/// Adds to the derivative by phi, share and timescale.
/// \param slope  derivative by the motion over this gap; that by the noise's md is half
/// of it, as by an entry of the whole symmetric matrix
void pull_back_motion(const ParameterLanes& parameters, std::size_t gap,
                      const Motion& slope, ParameterLanes& derivative);

}  // namespace bemcal::stats::residual
