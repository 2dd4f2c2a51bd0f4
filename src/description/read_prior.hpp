/// What is believed of a parameter before the data, from its section.
#pragma once

#include "schema/section.hpp"
#include "study/case.hpp"

#include <vector>

namespace bemcal::description {

/// What a parameter's section says is believed of it, its range aside.
study::ParameterPrior read_prior(const schema::Section& section);
/// The same within the parameter's range, all of it where the section does not say.
void place_prior(const schema::Section& section, const physics::Parameter& parameter,
                 study::ParameterPrior& prior);
/// A prior on the parameter's range, from the keys of a prior's section.
stats::Prior read_distribution(const schema::Section& section,
                               const physics::Parameter& parameter);
/// Of a discrete parameter, rising.
std::vector<double> read_values(const schema::Section& section);

}  // namespace bemcal::description
