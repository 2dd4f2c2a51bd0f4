/// Groups taken through the period step by step: the rows of a quantity, or sums of a
/// Sobol design that need no rows.
#include "physics/batch_plan.hpp"

namespace bemcal::physics {

namespace {

/// Calls see(rows, their number) for the rows of steps [begin, end) of the drive, in
/// order.
template <class See>
void see_rows(Batch::Group& group, int begin, int end, Quantity quantity, See see) {
    if (group.plan.coupled) {
        LaneArray& rows = group.plain[static_cast<std::size_t>(quantity)];
        const auto first = static_cast<std::size_t>(begin - group.plan.drive.n_warm_up);
        if (!rows.empty()) see(rows.column(first), end - begin);
        return;
    }
    for (int to = begin; begin < end; begin = to) {
        to = std::min(begin + group.most_steps(), end);
        const kernel::PowerRows rows = group.run(begin, to, show_for(quantity));
        see(group.show(quantity, rows, begin, to), to - begin);
    }
}

int segment_at(const Batch::Group& group, int step) {
    return group.plan.zones[0].segment_of[static_cast<std::size_t>(step)];
}

}  // namespace

void Batch::advance(Group& group, int begin, int end, Quantity quantity,
                    double* out) const {
    if (begin >= end) return;
    begin += plan_->drive.n_warm_up;
    end += plan_->drive.n_warm_up;
    if (plan_->is_metered_in_one_pass(quantity))
        return plan_->table.run_metered(group.zones[0].time, group.zones[0].lanes(),
                                        segment_at(group, begin), begin, end,
                                        group.meter(quantity), out);
    see_rows(group, begin, end, quantity, [&](const double* rows, int n) {
        out = std::copy_n(rows, n * lanes(), out);
    });
}

void Batch::advance(Group& group, int begin, int end, Quantity quantity,
                    const Differences& differences) const {
    if (begin >= end) return;
    begin += plan_->drive.n_warm_up;
    end += plan_->drive.n_warm_up;
    kernel::DifferenceLanes to{differences.a, differences.b, differences.sums};
    if (plan_->is_metered_in_one_pass(quantity))
        return plan_->table.run_differences(group.zones[0].time, group.zones[0].lanes(),
                                            segment_at(group, begin), begin, end,
                                            group.meter(quantity), to);
    see_rows(group, begin, end, quantity, [&](const double* rows, int n) {
        plan_->table.add_differences(rows, n, to);
        to.a += n * lanes();
        to.b += n * lanes();
        to.sums += 3 * n * lanes();
    });
}

void Batch::add_base(const double* shift, int n_steps, const double* a, double* b,
                     double* sums) const {
    plan_->table.add_base(shift, n_steps, a, b, sums);
}

}  // namespace bemcal::physics
