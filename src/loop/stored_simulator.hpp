/// What a loop around another program stores beside what every loop does: the program's
/// parameters, its runs, and the effects as they were given to it.
#pragma once

#include "base/nan.hpp"
#include "study/array.hpp"
#include "study/hourly_simulator.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::loop {

/// A number that is not known is NaN.
struct StoredSimulator {
    /// Of the program, at the runs that are plain, before and after.
    struct Parameter {
        std::string name, unit;
        double least = nan, most = nan, plain = nan, before = nan, after = nan;
    };
    /// An effect, times what the program's runs speak for.
    struct Given {
        std::string name;
        std::string hooks;  ///< that it changes: "infiltration, heating set-point"
        double scale = nan;
    };
    /// What effects change in the run that is after, as effect_files hands it over.
    struct Series {
        double of = 0;  ///< index of the given
        std::string hook, unit, enters, facade, meter;
        double opens_above = nan;  ///< [degC] of venting
    };
    struct LeftOut {
        std::string why;  ///< as the program says it
    };
    /// A run, in their order.
    struct Run {
        std::string of;         ///< "design", "calibration", "effects", "held out"
        std::string failure;    ///< "" = none
        double distance = nan;  ///< from the readings: deviance less that of the best run
        double years = nan;     ///< that it simulated
    };
    /// A meter that is learned from.
    struct Channel {
        std::string name;
        double emulator_error = nan;  ///< CV(RMSE) of its readings in unseen runs [%]
    };

    std::vector<Parameter> parameters;
    std::vector<Given> given;
    std::vector<Series> series;
    /// Hours of all periods, one period after the other.
    study::Array series_value{{"simulator_series", "simulator_hour"}};
    std::vector<LeftOut> left_out;
    std::vector<Run> runs;
    std::vector<Channel> channels;
};

/// Fills given, and the series of those whose scale is not 0. \param scales  [effects]
void add_given(const std::vector<study::GivenEffect>& effects,
               std::span<const double> scales, StoredSimulator& simulator);
/// The effects that have been filled in, times their scales.
std::vector<study::GivenEffect> given_in(const StoredSimulator& simulator);

/// \param group  "BUILDING/STUDY"
std::vector<study::Dataset> datasets_of(const std::string& group,
                                        const StoredSimulator& simulator);
/// Without parameters where the study is of no other program.
StoredSimulator stored_simulator(const std::vector<study::Dataset>& datasets,
                                 const std::string& group);

}  // namespace bemcal::loop
