/// What a study found, for the stages after it and for a stock: values with intervals,
/// errors, points and findings. The datasets beside it say the same to the readers of a
/// file.
#pragma once

#include "base/matrix.hpp"
#include "base/nan.hpp"
#include "study/decision.hpp"
#include "study/given_effects.hpp"

#include <limits>
#include <string>
#include <vector>

namespace bemcal::study {

/// A parameter or another unknown, with what agrees with the readings nearly as well.
struct FoundValue {
    std::string name;
    double value = 0;  ///< of the best point, the posterior's mean, or the last fit
    double low = 0;    ///< least of the best points, or 5 % quantile
    double high = 0;   ///< largest of the best points, or 95 % quantile
};

/// A meter's errors in a period; NaN where nothing is predicted or read.
struct FoundFit {
    std::size_t period = 0, meter = 0;  ///< of the case
    /// CV(RMSE) where the study began.
    double before = nan;
    /// Where it ended.
    double cv_rmse = nan;
    double nmbe = nan;
};

/// A name that an effect may have, and how probable it is that it is the cause, by its
/// building alone.
struct PossibleName {
    std::string name;
    double probability = nan;
};

/// An effect that comes with the weather, which buildings beside share: its coefficient
/// by this building's readings, whether or not it is believed, and a middling size.
struct PlaceEffect {
    std::string name, unit;
    double typical = nan, coefficient = nan, sd = nan;
};

/// What a description may take up of what was found, as sections of a job.
struct FoundPart {
    std::string effect;   ///< its name; empty: structure, hours, functions
    std::string section;  ///< TOML, which the readers of a description take
    std::string unit;     ///< of the coefficient; empty where there is none
    double coefficient = nan, least = nan, most = nan;  ///< with its 90 % interval
    std::vector<PossibleName> names{};                  ///< of its class; its own first
};

/// Points that agree with the readings: draws, all alike, or best points, best first.
struct FoundPoints {
    std::vector<std::string> parameters;  ///< [columns]; all others are nominal
    Matrix rows;                          ///< [points x columns]
};

/// A study that cannot say one of these leaves it empty.
struct Summary {
    std::string study;     ///< name of the group of its datasets: "office/posterior"
    std::string building;  ///< empty = whatever the study is of, as a whole
    std::vector<FoundValue> values;
    std::vector<FoundFit> fits;
    FoundPoints points;
    /// Of a loop around another program: what its point was given beside the parameters.
    std::vector<GivenEffect> given;
    std::vector<DataDecision> findings;
    std::vector<FoundPart> parts;
    /// Of what was seen, and had no name that was probable enough.
    std::vector<PossibleName> undecided;
    std::vector<PlaceEffect> of_the_place;  ///< of what a stock compares
    /// By which two runs of the same study can be told apart: smaller is better.
    double score = std::numeric_limits<double>::infinity();
    std::string failure;    ///< why nothing was found; empty = something was
    std::string shortfall;  ///< how what was found falls short of a target; empty = none
};

/// The summary of that study, the building's own where there is one; nullptr where
/// there is none.
const Summary* find_summary(const std::vector<Summary>& summaries,
                            const std::string& study, const std::string& building);

/// The value of that name; nullptr where there is none.
const FoundValue* find_value(const Summary& summary, const std::string& name);

}  // namespace bemcal::study
