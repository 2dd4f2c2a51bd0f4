/// What a job says of a Kennedy-O'Hagan calibration (paper 1, steps 2 to 4).
#pragma once

#include "emulator/model.hpp"
#include "emulator/runs.hpp"
#include "posterior/posterior_options.hpp"
#include "study/space.hpp"

#include <string>
#include <vector>

namespace bemcal::posterior {

enum class KohForm { automatic, dense, kronecker };

struct KohOptions {
    emulator::Observations observations;  ///< with the names of x and t
    /// [q] in the order of t. The priors' ranges become the scale 0 to 1.
    std::vector<study::Coordinate> calibrated;
    emulator::ModelOptions model;  ///< its priors of t and its form are not used
    KohForm form = KohForm::automatic;
    std::string output_unit;
    int n_predictive = 1000;  ///< draws that predictions are made of
    ChainOptions chains;
};

}  // namespace bemcal::posterior
