/// The forward run of a response: stretch by stretch, with the states before each kept
/// for the way back, and readings summed over their intervals.
/// Follows from Batch and the kernel's table; there is no model of its own here. The way
/// back is in response_back, the layout of a run in response_plan.
#include "kernel/response.hpp"

#include "base/error.hpp"
#include "kernel/meter_rows.hpp"
#include "kernel/response_plan.hpp"
#include "physics/derived.hpp"

namespace bemcal::kernel {

namespace {

/// One lane of all meters' rows. Throws CannotSimulate as meter_form does.
void write_meters(int lane, ResponseRun& run) {
    const BatchPlan& batch = run.group->plan;
    const physics::Building& building =
        run.group->buildings[static_cast<std::size_t>(lane)];
    for (std::size_t q = 0; q < n_quantities; ++q)
        if (!run.meters[q].rows.empty())
            write_meter_rows(batch.meters[q], building, batch.drive,
                             static_cast<physics::Quantity>(q), lane, run.meters[q].rows);
}

/// Returns why it failed, empty = it did not.
std::string write_lane(int lane, ResponseRun& run) {
    const physics::Building& building =
        run.group->buildings[static_cast<std::size_t>(lane)];
    for (std::size_t z = 0; z < run.zones.size(); ++z)
        run.floor_share.column(z)[lane] =
            building.zones[z].floor_area / building.floor_area();
    try {
        write_meters(lane, run);
        return {};
    } catch (const CannotSimulate& error) {
        return error.what();
    }
}

void copy_lane(int from, int to, ResponseRun& run) {
    for (ResponseRun::OfMeter& meter : run.meters) meter.rows.copy_lane(from, to);
    run.floor_share.copy_lane(from, to);
}

/// The states before a stretch.
void keep_states(std::size_t stretch, ResponseRun& run) {
    for (std::size_t z = 0; z < run.zones.size(); ++z) {
        const LaneArray& state = run.group->zones[z].state;
        std::copy_n(state.data(), state.size(),
                    run.zones[z].kept.column(stretch * state.columns()));
    }
}

/// W or degC of the steps of a stretch, from its rows.
const double* shown(physics::Quantity quantity, const Span& stretch,
                    const PowerRows& rows, ResponseRun& run) {
    if (const double* power = shown_as_it_is(quantity, run.group->plan, rows))
        return power;
    run.group->plan.table.meter(run.meter_lanes(quantity), rows, stretch.begin,
                                stretch.end, run.shown.data());
    run.group->show_extras(quantity, stretch.begin, stretch.end, run.shown.data());
    return run.shown.data();
}

void run_stretch(const ResponsePlan& plan, const Span& stretch, ResponseRun& run) {
    const auto [begin, end, month] = stretch;
    const Show show = plan.shows_air ? Show::powers_and_air : Show::powers;
    const PowerRows rows = run.group->run(begin, end, show);
    for (std::size_t k = 0; k < plan.channels.size(); ++k)
        plan.shared.table.adjoint.collect(
            plan.of_channels[k].time(),
            shown(plan.channels[k].quantity, stretch, rows, run), begin, end,
            run.channels[k].readings.data());
}

void run_in_one_pass(const ResponsePlan& plan, const Span& stretch, ResponseRun& run) {
    const auto [begin, end, month] = stretch;
    const Table& table = plan.shared.table;
    BatchGroup::Zone& zone = run.group->zones[0];
    table.run_metered(zone.time, zone.lanes(),
                      plan.shared.zones[0].segment_of[static_cast<std::size_t>(begin)],
                      begin, end, run.meter_lanes(plan.channels[0].quantity),
                      run.shown.data());
    table.adjoint.collect(plan.of_channels[0].time(), run.shown.data(), begin, end,
                          run.channels[0].readings.data());
}

void run_all(const ResponsePlan& plan, ResponseRun& run) {
    const bool in_one_pass = plan.in_one_pass();
    for (std::size_t k = 0; k < plan.stretches.size(); ++k) {
        const Span& stretch = plan.stretches[k];
        keep_states(k, run);
        if (!plan.in_period(stretch))
            run.group->run(stretch.begin, stretch.end, Show::sums);
        else if (in_one_pass)
            run_in_one_pass(plan, stretch, run);
        else
            run_stretch(plan, stretch, run);
    }
    for (BatchGroup::Zone& zone : run.group->zones) zone.sums.clear();
}

/// Readings of a building that runs plain: prepare() has simulated it.
void read_plain(const ResponsePlan& plan, ResponseRun& run) {
    const int begin = plan.shared.drive.n_warm_up, end = plan.shared.drive.n_steps();
    for (std::size_t k = 0; k < plan.channels.size(); ++k) {
        LaneArray& rows =
            run.group->plain[static_cast<std::size_t>(plan.channels[k].quantity)];
        if (!rows.empty())
            plan.shared.table.adjoint.collect(plan.of_channels[k].time(), rows.data(),
                                              begin, end,
                                              run.channels[k].readings.data());
    }
}

/// A lane whose state is not finite after the run has failed, too.
void find_failures(const ResponsePlan& plan, ResponseRun& run) {
    for (std::size_t k = 0; k < run.count; ++k)
        if (run.failures[k].empty() && !run.group->is_finite(static_cast<int>(k)))
            run.failures[k] = why_not_finite(run.group->buildings[k], plan.shared.drive);
}

}  // namespace

bool has_derivatives(const physics::Building& building) {
    return !runs_plain(building) && !physics::has_derived(building);
}

Response::Response(const Batch& batch, std::vector<Channel> channels)
    : plan_(new Plan(batch, std::move(channels))) {}

Response::~Response() = default;

const std::vector<Channel>& Response::channels() const {
    return plan_->channels;
}
std::size_t Response::n_readings(std::size_t channel) const {
    return plan_->of_channels[channel].factor.size();
}
int Response::lanes() const {
    return plan_->lanes();
}
bool Response::is_differentiable() const {
    return has_derivatives(plan_->shared.nominal);
}

void Response::DeleteRun::operator()(Run* run) const {
    delete run;
}

Response::RunPointer Response::make_run(Way way) const {
    return RunPointer(new Run(*plan_, way));
}

std::vector<std::string> Response::predict(const Matrix& points, std::size_t first,
                                           std::size_t count, Run& run) const {
    run.failures = plan_->batch.prepare(points, first, count, *run.group);
    run.count = count;
    if (plan_->shared.plain) {
        read_plain(*plan_, run);
        return run.failures;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const std::string failure = write_lane(static_cast<int>(k), run);
        if (run.failures[k].empty()) run.failures[k] = failure;
    }
    for (int lane = static_cast<int>(count); lane < lanes(); ++lane)
        copy_lane(static_cast<int>(count) - 1, lane, run);
    run_all(*plan_, run);
    find_failures(*plan_, run);
    return run.failures;
}

const double* Response::readings(const Run& run, std::size_t channel) const {
    return run.channels[channel].readings.data();
}
double* Response::sensitivities(Run& run, std::size_t channel) const {
    return run.channels[channel].sensitivities.data();
}

}  // namespace bemcal::kernel
