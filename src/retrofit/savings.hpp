/// What is stored of retrofits, whoever simulated them: before, after and the difference
/// at each point, with quantiles.
#pragma once

#include "retrofit/setting.hpp"
#include "study/case.hpp"
#include "study/datasets.hpp"
#include "study/simulator.hpp"

#include <string>
#include <vector>

namespace bemcal::retrofit {

/// What hours outside the limits of comfort are called [h].
inline constexpr const char* comfort_outputs[] = {"too_cold", "too_warm"};

/// The building before, then after each scenario, as described and at every point.
struct Savings {
    std::vector<std::string> scenarios;
    std::vector<study::Output> outputs;
    /// [1 + points][variants x outputs], the description first; NaN = failed
    Matrix rows;
    std::vector<physics::Parameter> parameters;
    Matrix points;  ///< [points x parameters]
    physics::TimeAxis period;
};

/// Adds what the outputs cost and emit, "cost" and "CO2", where a meter says it of a kWh;
/// "cost of gas alone" where others that are used say nothing.
/// \param output_of  what a meter reads, by its name among the outputs
void add_accounts(const std::vector<study::Meter>& meters,
                  std::string (*output_of)(const study::Meter&), Savings& savings);

/// The scenarios that could be simulated at no point, in a sentence; "" = none.
std::string lost_scenarios(const Savings& savings);

/// All datasets but failures.
void add_savings(const Setting& setting, Savings savings,
                 study::DatasetBuilder& datasets);

}  // namespace bemcal::retrofit
