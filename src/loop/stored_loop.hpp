/// What a loop stores of a building, as rows and arrays. Names, dimensions and order of
/// its datasets stand in stored_loop.cpp alone: the loop writes by them, reports read.
#pragma once

#include "base/nan.hpp"
#include "loop/decisions.hpp"
#include "loop/next_measurements.hpp"
#include "loop/power.hpp"
#include "loop/settings.hpp"
#include "physics/calendar.hpp"
#include "study/array.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// A number that is not known is NaN, a text that is not stored empty.
struct StoredLoop {
    // Indices along the dimensions of the arrays.
    enum Model : std::size_t { plain, before, after, n_models };
    enum Resolution : std::size_t { hourly, monthly, n_resolutions };
    enum Metric : std::size_t { n_readings, cv_rmse, nmbe, rmse, n_metrics };

    /// A meter that it learns from.
    struct Channel {
        std::string name, unit, unexplained_where;
        double unexplained = nan;
    };
    struct Parameter {
        std::string name, unit;
        double prior_mean = nan, prior_sd = nan;
    };
    struct Structure {
        std::string name;
        double score = nan;
    };
    /// Of the structure that `after` has.
    struct Refinement {
        std::string name, what;
    };
    struct Step {
        std::string effect;  ///< "" = of the search as a whole
        std::string verdict;
        double gain = nan, threshold = nan, score = nan;
    };
    struct Candidate {
        std::string name;
        double gain = nan;
    };
    /// An effect of the catalogue that these data could show: see Power.
    struct Seen {
        std::string effect, alias, alias_kind, parameter;
        double detectability = nan, visibility = nan, correlation = nan, bias = nan;
    };
    /// An effect that was found: see Found.
    struct Effect {
        std::string name, hook, driver, shape, gate, unit;
        std::string class_in_words;  ///< of its class all names, parted by semicolons
        std::string separates, doubt;
        std::string section;  ///< that declares it in a job (effects/job_section)
        double coefficient = nan, least = nan, most = nan, gain = nan, adequate = nan;
        struct Member {
            std::string name;
            double probability = nan;  ///< that it is the cause
        };
        std::vector<Member> members{};  ///< of its class, one by one, its own first
        bool is_adequate() const { return adequate == 1; }
    };
    /// What an effect brings to a meter, to cost or to emissions: see worth_of_effects.
    struct EffectValue {
        double effect = 0;  ///< index of the effect
        std::string of, unit;
        double value = nan, least = nan, most = nan;
    };
    /// A function of what the building may follow, at a hook: see FoundFunction.
    struct Function {
        std::string name, hook, driver, unit;
        std::string driver_unit;  ///< of an interaction that of what is not the hour
        double size = nan;        ///< root mean square over training [unit]
        double evidence = nan;    ///< log marginal likelihood that it brings [-]
    };
    /// What a function says where its driver, and the other one that it may have, are at
    /// a point.
    struct FunctionPoint {
        double function = 0;  ///< index of the function
        double at = nan, and_at = nan;
        double value = nan, least = nan, most = nan;  ///< [unit of the function]
    };
    /// A schedule whose hours nobody wrote down: see LearnedHours.
    struct Schedule {
        std::string name, use, sentence;
        double evidence = nan;
    };
    /// Its hours on a kind of days [h]; both 0 = off.
    struct DailyHours {
        double schedule = 0;  ///< index of the schedule
        std::string days;
        double from = nan, until = nan, usual_from = nan, usual_until = nan;
        double from_least = nan, from_most = nan, until_least = nan, until_most = nan;
        double probability = nan;
    };
    /// What else of the model a job can have beside the effects: see job_parts.
    struct JobPart {
        std::string of;  ///< "structure", "hours", "functions"
        std::string section;
    };
    using Measurement = Answer;
    struct Decision {
        std::string series, finding, action, kind;
        /// Of effects that are one with parameters, not of data.
        bool is_of_class() const;
    };

    std::vector<Channel> channels;
    std::vector<std::string> models, periods, resolutions, metrics, hooks, drivers;
    std::vector<Parameter> parameters;
    std::vector<Structure> structures;
    std::vector<Refinement> refinements;
    std::vector<Step> steps;
    std::vector<Candidate> candidates;
    std::vector<Effect> effects;
    std::vector<EffectValue> effect_values;
    std::vector<Setting> settings;
    std::vector<Function> functions;
    std::vector<FunctionPoint> function_points;
    std::vector<Schedule> schedules;
    std::vector<DailyHours> hours;
    std::vector<JobPart> job_parts;
    std::vector<Measurement> measurements;
    std::vector<Seen> seen;
    std::vector<Decision> decisions;

    study::Array parameter_value{{"model", "parameter"}};
    study::Array parameter_sd{{"model", "parameter"}};
    study::Array step_error{{"step", "channel"}};
    study::Array localisation{{"hook", "driver"}};
    study::Array localisation_after{{"hook", "driver"}};
    study::Array fit{{"model", "period", "resolution", "channel", "metric"}};
    /// Share of the readings within after's 90 % intervals.
    study::Array coverage{{"period", "resolution", "channel"}};

    double misfit = nan;
    double least_detectability = decisions::least_detectability;
    double same_signature = decisions::same_signature;
    std::string structure_chosen;
};

/// A period hour by hour: written for pictures, and not read here.
struct StoredPeriod {
    struct Channel {
        std::string name;
        std::vector<double> measured;  ///< [hours]; NaN = missing
        study::Array simulated{{"model", "time"}};
        std::vector<double> q05{}, q95{};  ///< [hours] after's interval; NaN = not known
        /// [months] of all hours, read or not: sums, or means of a temperature.
        std::vector<double> month{}, month_q05{}, month_q95{};
        /// Of a meter that is not read by the hour, [readings].
        std::vector<physics::Seconds> reading_begin{}, reading_end{};
        std::vector<double> reading_measured{};
    };
    std::string name;
    std::vector<physics::Seconds> begins;     ///< [hours]
    std::vector<double> outdoor_temperature;  ///< [hours]
    std::vector<Channel> channels;
    std::vector<physics::Seconds> months{};  ///< [months] their first hours here
};

/// \param group  "BUILDING/STUDY"
std::vector<study::Dataset> datasets_of(const std::string& group, const StoredLoop& loop,
                                        const std::vector<StoredPeriod>& periods);
StoredLoop stored_loop(const std::vector<study::Dataset>& datasets,
                       const std::string& group);

/// The datasets, and their dimensions, that stand beside the groups of periods.
std::vector<std::string> stored_names();

}  // namespace bemcal::loop
