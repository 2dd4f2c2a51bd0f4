/// Another program's model of a building: the hours of its meters at a point, with what a
/// description lacks as series at hooks.
#pragma once

#include "physics/parameters.hpp"
#include "study/case.hpp"
#include "study/given_effects.hpp"

#include <span>
#include <string>
#include <vector>

namespace bemcal::study {

/// Hours of the periods that were asked for, one period after the other.
struct SimulatedHours {
    std::vector<std::vector<double>> meters;  ///< [meters][hours] kWh; temperatures degC
    std::vector<std::string> left_out;        ///< effects that it could not take, and why
    std::string failure;                      ///< why there is nothing; "" = there is
};

/// Const means shareable: `hours` is called by many threads at once.
class HourlySimulator {
  public:
    virtual ~HourlySimulator() = default;
    virtual const std::vector<physics::Parameter>& parameters() const = 0;
    virtual const std::vector<std::string>& meters() const = 0;  ///< by the job's names
    /// Whether it may be asked for some of the periods; else it always gives all.
    virtual bool takes_periods() const { return false; }
    /// \param point    [parameters]
    /// \param effects  with values for each hour of those periods
    /// \param periods  that are asked for
    virtual SimulatedHours hours(std::span<const double> point,
                                 std::span<const GivenEffect> effects,
                                 std::span<const Period> periods) const = 0;
};

}  // namespace bemcal::study
