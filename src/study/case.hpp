/// A building as a study sees it: description, parameters, weather, schedules, meters,
/// periods.
#pragma once

#include "base/nan.hpp"
#include "effects/declared.hpp"
#include "kernel/batch.hpp"
#include "physics/week_hours.hpp"
#include "stats/prior.hpp"
#include "study/decision.hpp"
#include "study/step_share.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::study {

struct Meter {
    std::string name;
    physics::Quantity quantity = physics::Quantity::heating;
    physics::Intervals interval;
    physics::TimeAxis axis;  ///< steps of the readings (hourly, daily: 3600 s steps are
                             ///< used and a day's reading stands at its first step)
    std::vector<double> values;  ///< [axis.n_steps] kWh or degC; NaN = missing or masked
    std::string unit = "kWh";    ///< that its numbers were read in
    int row_s = 3600;            ///< length of the rows that they were read from
    double tariff = nan;         ///< of a kWh, in any currency; NaN = not said
    double co2 = nan;            ///< [kg/kWh]
};

/// What is believed of a parameter beforehand; a discrete one takes one of `values`, all
/// alike, and has no prior.
struct ParameterPrior {
    stats::Prior prior;
    std::vector<double> values;
    /// The prior is of the quotient by this parameter, which stands before.
    std::optional<std::size_t> in = std::nullopt;
    /// It follows from two parameters and has no prior.
    std::optional<StepShare> step = std::nullopt;
};

struct Period {
    std::string name;               ///< "training", "held_out"
    physics::Seconds from{}, to{};  ///< [from, to)
};

/// Calendar years that any of the periods touches.
struct YearSpan {
    int first, last;
};
YearSpan years_of(const std::vector<Period>& periods);

/// A series that an effect may follow: rain, carbon dioxide, a tariff.
struct Column {
    std::string name;  ///< of a profile of the case
    std::string unit;  ///< "" = not said
};

/// A schedule whose hours nobody wrote down. It has the usual ones of a use until a loop
/// has learned others.
struct UnknownHours {
    std::size_t profile;  ///< of the case
    std::string use;
    physics::WeekHours usual;
};

struct Case {
    std::string name;
    physics::Building building;  ///< nominal, with its structure and declared effects
    std::vector<std::size_t> structure{};  ///< of effects::refinements(), as declared
    /// Null without any. Profiles from its first_row on are theirs.
    std::shared_ptr<const effects::DeclaredEffects> declared_effects;
    std::vector<physics::Parameter> parameters;
    std::vector<ParameterPrior> priors;  ///< [parameters]; empty = uniform in the ranges
    physics::Weather weather;
    std::vector<physics::Profile> profiles;
    std::vector<Column> columns;  ///< the profiles that are series
    std::vector<UnknownHours> unknown_hours;
    std::vector<Meter> meters;
    std::vector<Period> periods;                      ///< the first is for training
    std::vector<physics::DateRange> school_holidays;  ///< no schedule follows them
    std::vector<DataDecision> decisions;
    int step_s = 3600;
    int warm_up_hours = 1008;
    physics::SkyModel sky = physics::SkyModel::perez;
    std::shared_ptr<physics::PlaneSource> planes;  ///< of the weather; may be empty
};

/// Of each parameter.
std::vector<ParameterPrior> priors_of(const Case& building);

/// The simulated steps of a period, without its warm-up.
physics::TimeAxis axis_of(const Case& building, const Period& period);

/// Where the intervals of the steps begin.
std::vector<physics::Seconds> begins_of(const physics::TimeAxis& axis,
                                        const physics::Intervals& intervals);

/// Whether data before a period, or the room's temperature at its begin, tell what state
/// the building was in; else its warm-up repeats the first days.
bool knows_state_before(const Case& building, const Period& period);

/// Whether one of the values is not missing.
bool has_reading(const std::vector<double>& values);

double hours_of(const Period& period);

/// The period of that name; without one the first.
const Period& period_of(const Case& building, const std::string& name);

/// The drive of a period, and the readings that fall into it. A reading whose interval
/// reaches beyond the period is missing. Throws std::invalid_argument where a meter is
/// read at another step than the simulation's.
physics::Drive drive_of(const Case& building, const Period& period);
/// The same of a variant of the case's building.
physics::Drive drive_of(const Case& building, const physics::Building& variant,
                        const Period& period);
std::vector<kernel::Readings> readings_of(const Case& building, const Period& period);

}  // namespace bemcal::study
