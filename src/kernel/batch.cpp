/// Makes the plan that all points of a batch share, and prepares groups of points: each
/// lane's coefficients, or the whole run where the building runs plain.
/// Follows from plan_zone and plan_meter; there is no model of its own here. A point that
/// is impossible gives its reason and leaves its lane finite. Steps are left to
/// batch_advance, totals and errors to evaluate.
#include "kernel/batch.hpp"

#include "base/error.hpp"
#include "kernel/batch_plan.hpp"
#include "kernel/input_profiles.hpp"
#include "kernel/plain_answer.hpp"

#include <stdexcept>

namespace bemcal::kernel {

namespace {

const Table& table_of(InstructionSet set) {
    switch (set) {
#if defined(__x86_64__)
        case InstructionSet::v3:
            return v3_table();
        case InstructionSet::v4:
            return v4_table();
#endif
        default:
            return scalar_table();
    }
}

void plan_all(BatchPlan& plan) {
    const Nominal nominal{plan.nominal, plan.parameters, plan.drive, plan.table.lanes};
    ProfileClasses classes(plan.drive);
    if (!plan.plain)
        for (std::size_t zone = 0; zone < plan.nominal.zones.size(); ++zone)
            plan.zones.push_back(plan_zone(nominal, zone, classes));
    for (std::size_t q = 0; q < n_quantities; ++q) {
        const auto quantity = static_cast<physics::Quantity>(q);
        plan.meters[q] = plan_meter(nominal, quantity, classes);
        if (plan.is_metered_in_one_pass(quantity))
            plan_mixed(plan.zones[0], plan.table.lanes, plan.meters[q]);
    }
}

/// A lane of a building that runs plain: the whole period at once.
void run_plain(BatchGroup& group, int lane) {
    const physics::Building& building = group.buildings[static_cast<std::size_t>(lane)];
    const physics::Drive& drive = group.plan.drive;
    const physics::Trajectory trajectory = physics::simulate(building, drive);
    for (std::size_t q = 0; q < n_quantities; ++q) {
        const auto quantity = static_cast<physics::Quantity>(q);
        const std::vector<double> values =
            physics::predict(building, drive, trajectory, quantity);
        const double unit = quantity == physics::Quantity::air_temperature
                                ? 1
                                : 3.6e6 / drive.axis.step_s;
        if (group.plain[q].empty())
            group.plain[q] = LaneArray(values.size(), group.plan.table.lanes);
        for (std::size_t step = 0; step < values.size(); ++step)
            group.plain[q].column(step)[lane] = values[step] * unit;
    }
}

/// Buildings that run plain, one after the other; of one that cannot, why. Lanes beyond
/// them are as the last.
void run_plain(BatchGroup& group, std::vector<std::string>& failures) {
    const int count = static_cast<int>(failures.size());
    for (int lane = 0; lane < count; ++lane) {
        std::string& failure = failures[static_cast<std::size_t>(lane)];
        try {
            if (failure.empty()) run_plain(group, lane);
        } catch (const CannotSimulate& error) {
            failure = error.what();
        }
        if (failure.empty()) continue;
        for (LaneArray& rows : group.plain) rows.clear_lane(lane);
    }
    for (LaneArray& rows : group.plain)
        for (int lane = count; lane < group.plan.table.lanes && !rows.empty(); ++lane)
            rows.copy_lane(count - 1, lane);
}

/// Whether more than a form stands between zones and meters.
bool is_supplied(const BatchPlan& plan) {
    bool is = plan.nominal.has_air_systems();
    at_range_ends(plan.nominal, plan.parameters, [&](const physics::Building& building) {
        is |= building.plant.cycles();
    });
    return is;
}

}  // namespace

bool runs_plain(const physics::Building& building) {
    return std::any_of(building.zones.begin(), building.zones.end(),
                       [](const physics::Zone& zone) {
                           return !zone.couplings.empty() || zone.radiator.has_value();
                       });
}

Batch::Batch(const physics::Building& nominal, std::vector<physics::Parameter> parameters,
             const physics::Drive& drive, InstructionSet set)
    : plan_(new Plan{nominal,
                     std::move(parameters),
                     drive,
                     table_of(set),
                     runs_plain(nominal),
                     false,
                     plan_months(drive),
                     {},
                     {},
                     {},
                     {}}) {
    if (!is_supported(set))
        throw std::invalid_argument(std::string("this processor cannot run the kernel ") +
                                    name_of(set));
    plan_->supplied = is_supplied(*plan_);
    plan_->chunks = cut_chunks(plan_->months);
    plan_all(*plan_);
    for (std::size_t k = 0; k < n_intervals; ++k)
        plan_->bounds[k] =
            physics::interval_bounds(drive.period(), static_cast<physics::Interval>(k));
}

std::vector<int> BatchPlan::bounds_of(const physics::Intervals& intervals) const {
    if (!intervals.are_own()) return bounds[static_cast<std::size_t>(intervals.kind)];
    return physics::interval_bounds(drive.period(), intervals);
}

Batch::~Batch() = default;

const std::vector<physics::Parameter>& Batch::parameters() const {
    return plan_->parameters;
}
int Batch::lanes() const {
    return plan_->table.lanes;
}
int Batch::n_months() const {
    return plan_->n_months();
}

void Batch::DeleteGroup::operator()(Group* group) const {
    delete group;
}

Batch::GroupPointer Batch::make_group() const {
    return GroupPointer(new Group(*plan_));
}

std::vector<Batch::GroupPointer> Batch::make_groups(std::size_t n,
                                                    physics::Quantity quantity) const {
    const auto buildings = std::make_shared<Group::Written>(*plan_);
    std::vector<GroupPointer> groups;
    groups.reserve(n);
    for (std::size_t k = 0; k < n; ++k)
        groups.emplace_back(new Group(*plan_, buildings, quantity));
    return groups;
}

std::vector<std::string> Batch::prepare(const Matrix& points, std::size_t first,
                                        std::size_t count, Group& group) const {
    std::vector<std::string> failures = group.write(points, first, count);
    if (plan_->plain) run_plain(group, failures);
    if (group.meter_at_once) group.meter(*group.meter_at_once);
    return failures;
}

void Batch::warm_up(Group& group) const {
    if (plan_->drive.n_warm_up > 0) group.run(0, plan_->drive.n_warm_up, Show::sums);
    for (Group::Zone& zone : group.zones) zone.sums.clear();
}

}  // namespace bemcal::kernel
