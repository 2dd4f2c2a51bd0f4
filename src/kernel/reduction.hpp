/// A group's sums over the period, chunk by chunk and month by month, and each lane's
/// answer.
#pragma once

#include "kernel/request_plan.hpp"

namespace bemcal::kernel {

class Reduction {
  public:
    Reduction(const RequestPlan& request, const BatchPlan& batch);
    /// Runs the group, warmed up, through the period.
    void run(BatchGroup& group);
    PointAnswer answer(int lane, BatchGroup& group) const;

  private:
    struct Months {
        std::size_t begin, end;
    };
    std::size_t months() const { return static_cast<std::size_t>(batch_.n_months()); }
    void run_span(const Span& span, BatchGroup& group);
    void run_compared(const Span& span, BatchGroup& group);
    void close_month(std::size_t month, BatchGroup& group);
    /// kWh, or the mean in degC.
    double total(physics::Quantity quantity, Months span, int lane,
                 BatchGroup& group) const;
    double total_of_powers(physics::Quantity quantity, Months span, int lane,
                           BatchGroup& group) const;
    ErrorSums errors(std::size_t reading, int lane) const;
    ErrorSums monthly_errors(std::size_t reading, int lane) const;

    const RequestPlan& request_;
    const BatchPlan& batch_;
    LaneArray powers_;             ///< [months x 2] heating, cooling [W steps]
    LaneArray summed_;             ///< [RequestPlan::summed x months]
    LaneArray error_;              ///< [readings x months]
    std::vector<LaneArray> sums_;  ///< [readings] ErrorColumn
};

}  // namespace bemcal::kernel
