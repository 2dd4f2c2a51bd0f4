/// Functions of what a building may follow: the series of their drivers in a period, and
/// what functions at a hook sum to.
#pragma once

#include "effects/surroundings.hpp"
#include "functions/points.hpp"

#include <map>
#include <string>
#include <vector>

namespace bemcal::effects {

/// A function with its values at points of its driver.
struct DriverFunction {
    std::string driver;  ///< "hour of the week": of function_driver_names()
    functions::Points points{};
    std::vector<double> values{};  ///< [points.size()] [the hook's unit]
    double spread = 0;             ///< of its values in a posterior; 0 = they are known

    bool is_sampled() const { return spread > 0; }
};

/// By the name of a driver: one series, or two of an interaction, of all steps of a
/// drive. [drivers][steps]
using FunctionDrivers = std::map<std::string, std::vector<std::vector<double>>>;

/// Those that the weather and the model know.
FunctionDrivers function_drivers(const Surroundings& around);

std::vector<std::string> function_driver_names();
/// Time is counted in years of so many seconds.
inline constexpr double seconds_of_year = 365.25 * 86400;
/// Whether a driver is the model's own heating or cooling load.
bool follows_loads(const std::string& driver);

/// What kind of points a function of it has.
functions::Points::Kind points_of_driver(const std::string& name);

/// Of what a driver is measured in, of an interaction that of what is not the hour; "" =
/// none, of the constant.
std::string unit_of_driver(const std::string& name);

/// What functions sum to. [steps]
std::vector<double> sum_of(const std::vector<DriverFunction>& all,
                           const FunctionDrivers& drivers);
/// The same at a hook, within what that can take.
std::vector<double> column_of(Hook hook, const std::vector<DriverFunction>& all,
                              const FunctionDrivers& drivers);

}  // namespace bemcal::effects
