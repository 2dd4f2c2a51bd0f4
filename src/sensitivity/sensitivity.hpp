/// Sobol sensitivity of a simulator's outputs, and of a meter for every hour of a year.
#pragma once

#include "study/simulator.hpp"
#include "study/stage.hpp"

#include <cstdint>
#include <memory>

namespace bemcal::sensitivity {

struct SensitivityOptions {
    std::size_t n_base = 1024;  ///< base points; a power of two is best
    bool scramble = true;
    int n_bootstrap = 1000;
    double threshold = 0.05;  ///< above it an input counts as sensitive (paper 1)
    std::uint64_t seed = 0;
    const char* kind = "sensitivity";  ///< of study, as the result says it
};

/// Indices with bootstrap intervals of every scalar output.
std::unique_ptr<study::Stage> make_sensitivity(
    std::string name, std::shared_ptr<const study::Simulator> simulator,
    const SensitivityOptions& options);

/// Indices of a quantity in every step of a period. Accumulators in place of outputs:
/// memory does not depend on n_base. Intervals from 32 fixed blocks of base points.
std::unique_ptr<study::Stage> make_hourly_sensitivity(std::string name,
                                                      const study::Case& building,
                                                      const study::Period& period,
                                                      physics::Quantity quantity,
                                                      const SensitivityOptions& options);

}  // namespace bemcal::sensitivity
