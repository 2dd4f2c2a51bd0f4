/// A building to calibrate, and chains short enough for a test.
#pragma once

#include "posterior/posterior.hpp"
#include "study/small_case.hpp"
#include "support/simulated_fit.hpp"

namespace bemcal::test {

/// A fortnight of hourly heat and air temperature, without readings.
inline study::Case fortnight() {
    study::Case made = small_case();
    made.periods = {{"training", day(7), day(21)}};
    made.meters = {empty_meter(made, physics::Quantity::heating),
                   empty_meter(made, physics::Quantity::air_temperature)};
    return made;
}

inline posterior::PosteriorOptions quick_options() {
    posterior::PosteriorOptions options;
    options.chains.n_chains = 4;
    options.chains.chains_per_item = 4;
    options.chains.sampler.n_warm_up = 200;
    options.chains.draws_per_round = 100;
    options.chains.target_rhat = 1.05;
    options.chains.target_ess = 100;
    options.chains.seed = 4;
    options.n_predictive = 50;
    return options;
}

}  // namespace bemcal::test
