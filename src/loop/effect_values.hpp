/// What each effect that was found is worth: the energy that the meters would not have
/// shown without it.
#pragma once

#include "base/nan.hpp"
#include "loop/baseline.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bemcal::loop {

/// What is counted: a meter's energy, or what it costs and emits. Of a training period of
/// about a year or more it is of a year, else of the period.
struct Account {
    std::string of;                   ///< "gas", "cost", "CO2"
    std::string unit;                 ///< "kWh/a"
    std::vector<double> per_reading;  ///< [channels] of a channel's sum
};
/// What makes a year's of a sum over so many days; nothing of days that show no year.
std::optional<double> per_year(double days);

/// Of meters that are read as energy, in their order; cost and CO2 where meters have a
/// tariff, or emissions.
std::vector<Account> accounts_of(const LoopData& data);

/// A difference with its 90 % interval.
struct Worth {
    double mean = nan, least = nan, most = nan;
};

/// With the effect less without it, all else as it is; nothing of hours that are told
/// with those of another schedule. [effects found][accounts]
/// \param deviations  of last's unknowns, in their units
std::vector<std::vector<Worth>> worth_of_effects(const LoopData& data, const Place& place,
                                                 const Standing& last,
                                                 const std::vector<double>& deviations,
                                                 double misfit,
                                                 const std::vector<Account>& accounts);

}  // namespace bemcal::loop
