/// What a job says of a search for effects that its description lacks.
#pragma once

#include "loop/decisions.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::loop {

struct LoopOptions {
    std::string period;                   ///< for training; empty = the case's first
    std::vector<std::string> parameters;  ///< that are calibrated; empty = all
    std::vector<std::string> meters;      ///< empty = all with readings in the period
    int most_effects =
        decisions::most_effects;  ///< that are accepted; then the search ends
    bool try_structures = true;   ///< whether the baseline's structure is chosen first
    double block_days =
        decisions::block_days;  ///< of the training period's interleaved blocks [d]
    double least_gain =
        decisions::least_gain;  ///< fall of the held-out error in training blocks, as
                                ///< a mean over channels [%]
    double most_loss =
        decisions::most_loss;  ///< rise of it that every channel may show [%]
    double alpha =
        decisions::alpha;  ///< level of what noise alone shows among those refitted
    std::uint64_t seed = 0;
    /// Values of parameters where the first fit starts; those left out start at their
    /// prior's mean.
    std::map<std::string, double> start{};
    std::vector<std::string> exclude;  ///< names of effects that are not tried
    bool functions = true;             ///< whether functions are sought in what is left
    /// Standard deviation of an energy meter's level in another period than training, as
    /// a share; nothing: usual_level_change.
    std::optional<double> level_change{};
    int simulator_runs =
        decisions::simulator_runs;  ///< of another program, where it is what is searched
    bool compares_place = false;    ///< whether effects of the place are told to a stock
    bool generic = true;            ///< whether the grammar's effects are tried, too
    std::vector<std::string> columns;  ///< names of the case's columns that may drive one
};

}  // namespace bemcal::loop
