/// A function that a building's readings speak for.
#pragma once

#include "effects/driver_functions.hpp"
#include "functions/basis.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// A function of a driver at a hook.
struct FoundFunction {
    effects::Effect at;  ///< the hook, its meter, its typical size
    functions::Basis basis;
    std::vector<double> mean;  ///< [columns] of its coefficients, in typical sizes
    double size = 0;           ///< root mean square in training [the hook's unit]
    double evidence = 0;       ///< log marginal likelihood that it brings
    double variance = 0;       ///< of its coefficients' prior
    double scatter = 1;        ///< of its scores (functions/joint)
    std::vector<double> deviations{};  ///< [basis' points] standard deviation of its
                                       ///< values there, in typical sizes

    /// Its value where its drivers are at each of the basis' points. [the hook's unit]
    std::vector<double> values() const;
    /// Root mean square of their standard deviations; 0 where no posterior can sample
    /// them: of the constant, and where effects do not add up. [the hook's unit]
    double spread() const;
};

/// All functions at a hook, which bring their sum.
struct FunctionsAtHook {
    effects::Effect at;
    std::vector<effects::DriverFunction> functions;
};
/// In the order in which hooks first come.
std::vector<FunctionsAtHook> by_hook(const std::vector<FoundFunction>& found);

/// "gains by hour of the week", "gains by hour of the week from 2021-06-03 on"
/// \param from  the first step of training
std::string name_of(const FoundFunction& function, physics::Seconds from);

}  // namespace bemcal::loop
