/// The way back from a meter's form to the plant and the loads: meters.cpp in reverse.
#pragma once

#include "physics/meters.hpp"

namespace bemcal::adjoint {

/// Of the factor between true_meter_form and meter_form: returns the adjoints of the
/// former. \param of_form  those of the latter
physics::MeterForm pull_meter_factor(const physics::Building& building,
                                     const physics::Drive& drive,
                                     physics::Quantity quantity, int step,
                                     const physics::MeterForm& of_form,
                                     physics::Building& of_building);

/// Of true_meter_form at a step: adds to the building's adjoints. \param of_form adjoints
void pull_meter_form(const physics::Building& building, const physics::Drive& drive,
                     physics::Quantity quantity, int step,
                     const physics::MeterForm& of_form, physics::Building& of_building);

}  // namespace bemcal::adjoint
