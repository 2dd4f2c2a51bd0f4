/// What is odd about a meter's readings: long runs of zeros, the same value for many
/// hours, steps by a factor that one unit has to another.
///
/// Findings only; what is done about them the job says. Leaves out what needs weather or
/// a model: a heating meter's summer is a long run of zeros and rightly so.
#pragma once

#include <string>
#include <vector>

namespace bemcal::job {

struct Run {
    int first = 0, n = 0;  ///< readings
    double value = 0;
};

/// Runs of at least `least` readings with the same value; NaN ends a run. Zeros when
/// `zeros`, other values when not.
std::vector<Run> constant_runs(const std::vector<double>& readings, int least,
                               bool zeros);

struct UnitStep {
    int at = 0;             ///< first reading after the step
    double ratio = 1;       ///< level after / level before
    double unit_ratio = 1;  ///< the known ratio that it is near
    std::string units;      ///< "m3 to kWh"
};

/// Change points at which the level of the non-zero readings changes by the ratio of two
/// units (within 20 %) from one day to the next and stays so for three weeks.
/// \param readings_per_day  24 for hourly ones
std::vector<UnitStep> unit_steps(const std::vector<double>& readings,
                                 int readings_per_day);

}  // namespace bemcal::job
