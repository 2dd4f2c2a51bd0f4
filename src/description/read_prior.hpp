/// What is believed of a parameter before the data, from its section.
#pragma once

#include "schema/section.hpp"
#include "study/case.hpp"

#include <vector>

namespace bemcal::description {

/// What is believed of a parameter: uniform in its range where its section does not say.
study::ParameterPrior read_prior(const schema::Section& section,
                                 const physics::Parameter& parameter);
/// A prior on the parameter's range, from the keys of a prior's section.
stats::Prior read_distribution(const schema::Section& section,
                               const physics::Parameter& parameter);
/// Of a discrete parameter, rising.
std::vector<double> read_values(const schema::Section& section);

}  // namespace bemcal::description
