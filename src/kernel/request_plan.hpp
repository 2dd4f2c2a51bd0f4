/// What is wanted of every point, laid on the steps of the drive once for all groups.
#pragma once

#include "kernel/batch_plan.hpp"
#include "kernel/request.hpp"

namespace bemcal::kernel {

double kWh_per_W(const physics::Drive& drive);

/// A meter's readings laid on the drive's steps.
struct ReadingPlan {
    physics::Quantity quantity = physics::Quantity::heating;
    bool every_step = true;  ///< each interval is one step
    bool by_month = false;
    std::vector<int> closes;  ///< [n_steps] interval that ends there, or -1
    std::vector<double> measured, inverse,
        factor;                     ///< [n_intervals], see ReadingTime
    std::vector<ErrorSums> months;  ///< [n_months] of the readings alone: n, n_relative,
                                    ///< their sum in `simulated`, squares in `product`
    ReadingTime time() const {
        return {closes.data(), measured.data(), inverse.data(), factor.data()};
    }
};

struct RequestPlan {
    const Request& request;
    std::vector<ReadingPlan> readings;
    std::vector<physics::Quantity> summed;  ///< totals that need the quantity shown
    /// Of the other totals: steps of each month in each row of the meter
    /// [n_months][n_rows].
    std::array<std::vector<std::vector<double>>, n_quantities> row_counts;
    Show show = Show::sums;
    bool compared = false;  ///< one meter, read while the powers are made

    RequestPlan(const Request& wanted, const BatchPlan& batch);

  private:
    void need(Show more);
    void add_total(physics::Quantity quantity, const BatchPlan& batch);
};

}  // namespace bemcal::kernel
