/// Takes prepared groups through the period: rows of a quantity, or the sums of a Sobol
/// design that need no rows. One pass of the kernel where the meter can be read in it,
/// else rows shown chunk by chunk.
/// Source of the sums: Saltelli et al. 2010 (kernel_differences). Totals by month and
/// errors against readings are left to reduction.
#include "kernel/batch.hpp"
#include "kernel/batch_plan.hpp"

namespace bemcal::kernel {

namespace {

/// Calls see(rows, their number) for the rows of steps [begin, end) of the drive, in
/// order.
template <class See>
void see_rows(BatchGroup& group, int begin, int end, physics::Quantity quantity,
              See see) {
    if (group.plan.plain) {
        LaneArray& rows = group.plain[static_cast<std::size_t>(quantity)];
        const auto first = static_cast<std::size_t>(begin - group.plan.drive.n_warm_up);
        if (!rows.empty()) see(rows.column(first), end - begin);
        return;
    }
    for (int to = begin; begin < end; begin = to) {
        to = std::min(begin + group.most_steps(), end);
        const PowerRows rows = group.run(begin, to, show_for(quantity));
        see(group.show(quantity, rows, begin, to), to - begin);
    }
}

int segment_at(const BatchGroup& group, int step) {
    return group.plan.zones[0].segment_of[static_cast<std::size_t>(step)];
}

void run_differences(std::span<const Batch::Mixed> groups, int begin, int end,
                     physics::Quantity quantity, double* sums) {
    const BatchGroup& first = *groups.front().group;
    ZoneTime time = first.zones[0].time;
    time.row_offset = first.plan.meter(quantity).mixed_offset.data();
    std::vector<MixedLanes> lanes;
    lanes.reserve(groups.size());
    for (const Batch::Mixed& mixed : groups)
        lanes.push_back({mixed.group->mixed(quantity), mixed.a, mixed.b});
    first.plan.table.run_differences(time, segment_at(first, begin), begin, end,
                                     lanes.data(), static_cast<int>(lanes.size()), sums);
}

}  // namespace

void Batch::advance(Group& group, int begin, int end, physics::Quantity quantity,
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

void Batch::sum_differences(std::span<const Mixed> groups, int begin, int end,
                            physics::Quantity quantity, double* sums) const {
    if (begin >= end || groups.empty()) return;
    begin += plan_->drive.n_warm_up;
    end += plan_->drive.n_warm_up;
    if (plan_->is_metered_in_one_pass(quantity))
        return run_differences(groups, begin, end, quantity, sums);
    std::fill_n(sums, 3 * (end - begin) * lanes(), 0.0);
    for (const Mixed& mixed : groups) {
        DifferenceLanes to{mixed.a, mixed.b, sums};
        see_rows(*mixed.group, begin, end, quantity, [&](const double* rows, int n) {
            plan_->table.add_differences(rows, n, to);
            to.a += n * lanes();
            to.b += n * lanes();
            to.sums += 3 * n * lanes();
        });
    }
}

void Batch::add_base(const double* shift, int n_steps, const double* a, double* b,
                     double* sums) const {
    plan_->table.add_base(shift, n_steps, a, b, sums);
}

}  // namespace bemcal::kernel
