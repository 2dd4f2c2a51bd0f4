/// The parts of a report, one for each kind of study; text with a heading, empty where
/// there is nothing to say.
#pragma once

#include "report/lookup.hpp"

#include <string>

namespace bemcal::report {

/// Parameters by total-order index, with intervals, for each output; indices are
/// estimated again from the stored design.
std::string sensitivity_section(const Group& study);

/// Parameters by the total-order index of a whole series.
std::string hourly_section(const Group& study);

/// Nominal against best for each meter and period, computed again from the stored series;
/// how many points meet ASHRAE Guideline 14; the best point.
std::string screening_section(const Group& study);
/// Its tables of errors and parameters, which an optimisation has too.
std::string candidate_tables(const Group& study);

/// Nominal against best; of several objectives the front; parameters at their bounds.
std::string optimisation_section(const Group& study);

/// Whether the chains have converged, first of all; each unknown before and after;
/// how well the description and the posterior's mean predict every meter, and how many
/// readings lie within its intervals. Convergence is computed again from the draws.
std::string posterior_section(const Group& study);

/// Errors before and after at every interval, with ASHRAE Guideline 14, in training, in
/// what was held out of it, and in the other periods; coverage of the 90 % intervals.
std::string validation_tables(const Group& study);

/// Measured against predicted at the field points of a Kennedy-O'Hagan calibration.
std::string field_tables(const Group& study);

/// What a loop found: errors of the plain model, before and after; the effects with their
/// evidence; the steps of the search; the parameters; what the data can show and still
/// hold.
std::string loop_section(const Group& study);

/// What each scenario would save, with its spread over the points it was applied to.
std::string retrofit_section(const Group& study);

/// Stages of a grid: how near each came, its k nearest, what became of each parameter.
std::string grid_section(const Group& study);

/// Stages of a calibration: each one's parameters before and after, errors on its periods
/// and on those that none has seen, computed again from the stored series.
std::string staged_section(const Group& study);

/// Any study as it is stored: for kinds without a section of their own.
std::string plain_section(const Group& study);

/// What was found in a building's data, and what was done about it.
std::string decision_section(const Group& data);

/// How many simulations of a study failed, and why.
std::string failure_lines(const Group& study);

}  // namespace bemcal::report
