/// From zones to what meters show: the plant's conversion, and every load on its carrier.
#pragma once

#include "physics/simulate.hpp"

#include <string>
#include <utility>
#include <vector>

namespace bemcal::physics {

/// Intervals of a meter: each a run of steps of the period.
enum class Interval { step, hourly, daily, monthly, annual };
const char* name_of(Interval interval);

/// Intervals of a meter over all time: the calendar's, or its own, such as those between
/// the reads of a bill. Their kind says what limits and what memory their readings have.
struct Intervals {
    Interval kind = Interval::hourly;
    std::vector<Seconds> bounds;  ///< rising, each the end of one; empty = the calendar's

    Intervals(Interval of_calendar = Interval::hourly) : kind(of_calendar) {}
    Intervals(Interval of_kind, std::vector<Seconds> own)
        : kind(of_kind), bounds(std::move(own)) {}
    operator Interval() const { return kind; }
    bool are_own() const { return !bounds.empty(); }
};

/// First steps of each interval within [0, n), and n as the last entry. Daily, monthly
/// and annual ones are the calendar's unless they are the meter's own; a cut first or
/// last one, and time outside of all bounds, counts as an interval of its own.
std::vector<int> interval_bounds(const TimeAxis& period, const Intervals& intervals);

/// What a meter shows for every step of the period: energy of the step [kWh], or the
/// floor-area-weighted mean air temperature [degC].
std::vector<double> predict(const Building& building, const Drive& drive,
                            const Trajectory& trajectory, Quantity quantity);

/// Sums (or means, for temperature) over intervals. NaN steps make the interval NaN.
std::vector<double> aggregate(const std::vector<double>& steps,
                              const std::vector<int>& bounds, Quantity quantity);

/// Linear form of a meter for one step: W on the meter = per_heating phi_H + per_cooling
/// phi_C
/// + per_fan phi_fan + per_lost_heating lost_H + per_lost_cooling lost_C + source; both
/// `predict` and the fast kernel use it. Air temperature has no such form (zeros).
struct MeterForm {
    double per_heating = 0, per_cooling = 0;            ///< [-]
    double source = 0;                                  ///< [W]
    double per_fan = 0;                                 ///< of air systems [-]
    double per_lost_heating = 0, per_lost_cooling = 0;  ///< by cycling [-]
};
/// Throws CannotSimulate where an efficiency or COP that is needed is not above 0, or
/// the meter's factor is not a number >= 0.
MeterForm meter_form(const Building& building, const Drive& drive, Quantity quantity,
                     int step);
/// The same of a meter that shows what flows through it (Building::meter_factor).
MeterForm true_meter_form(const Building& building, const Drive& drive, Quantity quantity,
                          int step);

}  // namespace bemcal::physics
