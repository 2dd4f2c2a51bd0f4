/// [[study.target]]: numbers that a building or another program is held against, in grids
/// and optimisations. What the meters show joins them when the building is known.
#pragma once

#include "calibration/grid.hpp"
#include "calibration/target_simulator.hpp"
#include "job/kind.hpp"
#include "job/names.hpp"
#include "schema/section.hpp"
#include "schema/words.hpp"
#include "study/case.hpp"
#include "study/simulator.hpp"

#include <string>
#include <vector>

namespace bemcal::job {

inline constexpr schema::SectionInfo target_sections[] = {
    {"study.target", "[[study.target]]", "",
     "A number that the building is held against; of a grid by default the electricity "
     "and the gas of the period."},
};

inline constexpr schema::Key target_keys[] = {
    {"study.target", "quantity", schema::Type::choice, schema::quantities, nullptr, 0, 0,
     ""},
    {"study.target", "statistic", schema::Type::choice, "period|months|peak", "period", 0,
     0,
     "Total over the period (of a temperature its mean), the same of each calendar "
     "month, or the highest hour."},
    {"study.target", "measured", schema::Type::number, "", "", -1e300, 1e300,
     "Default: what the meter shows."},
    {"study.target", "measured_months", schema::Type::numbers, "", "", -1e300, 1e300,
     "The same where the statistic is months, one for each."},
    {"study.target", "unit", schema::Type::text, "", "", 0, 0,
     "Of measured; default: kWh, of a peak kW, of a temperature degC."},
    {"study.target", "meter", schema::Type::text, "", "", 0, 0,
     "Name of the meter; default: the first of the quantity with readings."},
    {"study.target", "output", schema::Type::text, "", "", 0, 0,
     "In place of a quantity where the job has a [simulator]: one of its outputs."},
    {"study.target", "scale", schema::Type::number, "%", "", 1e-9, 1e9,
     "With distance = \"scaled\": the error that counts as 1; default: the standard "
     "deviation over the first grid."},
};

struct TargetSpec {
    calibration::OutputSpec output;  ///< of a building
    std::string simulator_output;    ///< of a [simulator], in place of it
    std::string meter;               ///< its name; "" = the first with the quantity
    std::vector<double> measured;    ///< in the output's unit; empty = from the meter
    double scale = 0;                ///< [%]; 0 = by rule
};
using TargetSpecs = std::vector<TargetSpec>;  ///< empty = annual electricity and gas

/// Throws UserError.
TargetSpecs read_targets(const schema::Section& study);

/// The outputs that the targets are held against.
std::vector<calibration::OutputSpec> outputs_of(const TargetSpecs& specs);

/// Throw std::invalid_argument where a measured value is missing or zero, or an output or
/// meter is not there.
std::vector<calibration::GridTarget> targets_of(const TargetSpecs& specs,
                                                const study::Case& building,
                                                const study::Period& period);
std::vector<calibration::GridTarget> targets_of(const TargetSpecs& specs,
                                                const study::Simulator& simulator);

/// The building over the period as a simulator of those outputs.
std::shared_ptr<const study::Simulator> target_simulator(const TargetSpecs& specs,
                                                         const study::Case& building,
                                                         const study::Period& period);

/// The meters that targets are taken from; none where the job gives all numbers.
std::vector<Fitted> fitted_by(const TargetSpecs& specs, const std::string& period,
                              const study::Case& building);

/// Throws UserError where a target names a meter that is none.
void check_target_meters(const schema::Section& study, const BuildingNames& names);

/// Throw UserError where a target has no measured value.
void check_targets(const schema::Section& study, const TargetSpecs& specs,
                   const std::string& period, const std::vector<study::Case>& buildings);
void check_targets(const schema::Section& study, const TargetSpecs& specs,
                   const study::Simulator& simulator);

}  // namespace bemcal::job
