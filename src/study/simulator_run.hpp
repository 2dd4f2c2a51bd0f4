/// A run of another program's model of a building, as an item of a stage: where it was
/// made, and the hours that it gave.
#pragma once

#include "study/datasets.hpp"
#include "study/hourly_simulator.hpp"
#include "study/simulated_hours.hpp"
#include "study/stage.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

/// A run at a point, with effects at a scale each.
struct SimulatorRun {
    std::vector<double> point;   ///< [parameters] on the scale 0 to 1
    std::vector<double> scales;  ///< [effects]; none before effects are known
    AskedPeriods asked;          ///< periods that it is of
    /// [meters][hours of all periods]; NaN in periods that were not asked for.
    std::vector<std::vector<double>> hours;
    std::vector<std::string> left_out;  ///< what the program could not take
    std::string failure;                ///< then there are no hours
};

/// The program's numbers at a point on the scale 0 to 1. [parameters]
std::vector<double> values_at(std::span<const double> point,
                              const std::vector<physics::Parameter>& parameters);

/// And back: the nominal numbers on that scale. [parameters]
std::vector<double> nominal_on_scale(const std::vector<physics::Parameter>& parameters);

/// Which of the program's meters has the name. Throws std::invalid_argument where none
/// has.
std::size_t column_of(const HourlySimulator& simulator, const std::string& meter);

/// What a run costs, in years of hours that are simulated.
double years_of_run(const std::vector<Period>& periods, const SimulatorRun& run);

/// Runs the program at the numbers for the periods asked for. Its hours are those of all
/// periods, NaN in the others.
/// \param effects  with values for each hour of all periods
SimulatedHours hours_of_run(const HourlySimulator& simulator,
                            std::span<const double> values,
                            std::vector<GivenEffect> effects,
                            const std::vector<Period>& periods,
                            const AskedPeriods& asked);

/// Runs the program at the numbers; the answer holds the run with its hours, or a
/// failure.
/// \param run      its point, scales and the periods asked for
/// \param effects  with values for each hour of all periods
/// \param columns  of the program's meters, whose hours are kept
ItemAnswer simulate(const HourlySimulator& simulator, SimulatorRun run,
                    std::span<const double> values, std::vector<GivenEffect> effects,
                    std::span<const std::size_t> columns,
                    const std::vector<Period>& periods);

/// Runs as a result tells them.
struct MadeRuns {
    std::vector<std::string> of, failures;  ///< [runs] "" = it did not fail
    std::vector<double> values;             ///< [runs x parameters]
};
void add_made_runs(const std::vector<physics::Parameter>& parameters, MadeRuns runs,
                   DatasetBuilder& datasets);

/// The run that an answer holds. One that was not made has a point of NaN.
SimulatorRun run_in(const ItemAnswer& answer, std::size_t n_parameters);

/// A run as numbers, and back.
std::vector<double> pack(const SimulatorRun& run);
SimulatorRun unpack_run(std::span<const double> packed);

}  // namespace bemcal::study
