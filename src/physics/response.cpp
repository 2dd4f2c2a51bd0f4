/// The forward run: stretch by stretch, with the states before each kept for the way
/// back.
#include "physics/response.hpp"

#include "physics/plain_answer.hpp"
#include "physics/request_plan.hpp"
#include "physics/response_plan.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

namespace bemcal::physics {

namespace {

ChannelPlan plan_channel(const Channel& channel, const Batch::Plan& batch) {
    const Drive& drive = batch.drive;
    const std::vector<int>& bounds =
        batch.bounds[static_cast<std::size_t>(channel.interval)];
    ChannelPlan plan;
    plan.quantity = channel.quantity;
    plan.interval.assign(static_cast<std::size_t>(drive.n_warm_up), -1);
    plan.interval.reserve(static_cast<std::size_t>(drive.n_steps()));
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
        const int n = bounds[k + 1] - bounds[k];
        plan.interval.insert(plan.interval.end(), static_cast<std::size_t>(n),
                             static_cast<int>(k));
        plan.factor.push_back(
            channel.quantity == Quantity::air_temperature ? 1.0 / n : kWh_per_W(drive));
    }
    return plan;
}

std::vector<Span> plan_stretches(const Batch::Plan& batch) {
    std::vector<Span> stretches = cut_chunks({{0, batch.drive.n_warm_up, 0}});
    stretches.insert(stretches.end(), batch.chunks.begin(), batch.chunks.end());
    return stretches;
}

double per_value(double nominal, Effect effect) {
    return effect == Effect::factor ? nominal : 1;
}

/// Every number that a parameter writes to, once: of two parameters the last one holds.
std::vector<Written> plan_written(const Batch::Plan& batch) {
    Building building = batch.nominal;
    std::map<const double*, std::size_t> known;
    std::vector<Written> written;
    for (std::size_t p = 0; p < batch.parameters.size(); ++p)
        for (const Target& target : batch.parameters[p].targets) {
            const double& number = number_at(building, target);
            const Written entry{p, target, per_value(number, batch.parameters[p].effect)};
            const auto [place, is_new] = known.try_emplace(&number, written.size());
            if (is_new)
                written.push_back(entry);
            else
                written[place->second] = entry;
        }
    return written;
}

/// As many parts as the building has, without words.
Building parts_of(const Building& building) {
    Building parts;
    parts.constructions.resize(building.constructions.size());
    parts.glazings.resize(building.glazings.size());
    parts.boundaries.resize(building.boundaries.size());
    parts.zones.resize(building.zones.size());
    for (std::size_t z = 0; z < parts.zones.size(); ++z) {
        parts.zones[z].surfaces.resize(building.zones[z].surfaces.size());
        parts.zones[z].windows.resize(building.zones[z].windows.size());
        parts.zones[z].flows.resize(building.zones[z].flows.size());
        parts.zones[z].loads.resize(building.zones[z].loads.size());
    }
    return parts;
}

std::size_t count_in(const Zone& zone, Part part) {
    switch (part) {
        case Part::surface:
            return zone.surfaces.size();
        case Part::window:
            return zone.windows.size();
        case Part::flow:
            return zone.flows.size();
        case Part::load:
            return zone.loads.size();
        default:
            return part == Part::zone ? 1 : 0;
    }
}

/// How many parts of a kind stand in the building itself, or have such parts.
std::size_t count_in(const Building& building, Part part) {
    switch (part) {
        case Part::construction:
            return building.constructions.size();
        case Part::glazing:
            return building.glazings.size();
        case Part::boundary:
            return building.boundaries.size();
        case Part::plant:
            return 1;
        default:
            return building.zones.size();
    }
}

bool is_of_zone(Part part) {
    return part != Part::construction && part != Part::glazing &&
           part != Part::boundary && part != Part::plant;
}

/// The building's parts with all of their numbers 0.
Building zeros_like(const Building& building) {
    Building zeros = parts_of(building);
    for (std::size_t field = 0; field < fields().size(); ++field) {
        const Part part = fields()[field].part;
        for (std::size_t k = 0; k < count_in(zeros, part); ++k) {
            const std::size_t n = is_of_zone(part) ? count_in(zeros.zones[k], part) : 1;
            for (std::size_t inner = 0; inner < n; ++inner)
                for (bool low : {false, true})
                    number_at(zeros, {part, static_cast<int>(k), static_cast<int>(inner),
                                      static_cast<int>(field), low}) = 0;
        }
    }
    return zeros;
}

bool is_metered(Quantity quantity) {
    return quantity != Quantity::air_temperature;
}

LaneArray like(const Partition& classes, int columns, int lanes) {
    return {static_cast<std::size_t>(classes.size() * columns), lanes};
}

Batch::Group::Rows make_rows(std::size_t steps, int lanes) {
    return {LaneArray(steps, lanes), LaneArray(steps, lanes), LaneArray(steps, lanes)};
}

int tape_columns(const ZonePlan& zone) {
    return zone.is_standard()
               ? static_cast<int>(kernel::StandardTape::count)
               : kernel::general_tape_columns(static_cast<int>(zone.states.size()));
}

Response::Run::OfZone make_zone(const Response::Plan& plan, const ZonePlan& zone,
                                std::size_t n_steps) {
    const int lanes = plan.lanes();
    const std::size_t n_states = zone.is_standard() ? 1 : zone.states.size();
    return {LaneArray(plan.stretches.size() * n_states, lanes),
            LaneArray(n_states, lanes),
            LaneArray(n_steps * static_cast<std::size_t>(tape_columns(zone)), lanes),
            make_rows(n_steps, lanes),
            like(zone.regimes, zone.of_regime_columns(), lanes),
            like(zone.rows, zone.row_columns(), lanes),
            LaneArray(n_states, lanes),
            LaneArray(n_steps, lanes)};
}

/// One lane of a meter's rows. Throws std::domain_error as meter_form does.
void write_meter(Quantity quantity, int lane, Response::Run& run) {
    const Batch::Plan& batch = run.group->plan;
    const Building& building = run.group->buildings[static_cast<std::size_t>(lane)];
    const std::vector<int>& first = batch.meter(quantity).rows.first;
    LaneArray& rows = run.meter(quantity).rows;
    for (std::size_t row = 0; row < first.size(); ++row) {
        const MeterForm form = meter_form(building, batch.drive, quantity, first[row]);
        rows.column(3 * row)[lane] = form.source;
        rows.column(3 * row + 1)[lane] = form.per_heating;
        rows.column(3 * row + 2)[lane] = form.per_cooling;
    }
}

void write_meters(int lane, Response::Run& run) {
    for (std::size_t q = 0; q < n_quantities; ++q)
        if (!run.meters[q].rows.empty()) write_meter(static_cast<Quantity>(q), lane, run);
}

/// Returns why it failed, empty = it did not.
std::string write_lane(int lane, Response::Run& run) {
    const Building& building = run.group->buildings[static_cast<std::size_t>(lane)];
    for (std::size_t z = 0; z < run.zones.size(); ++z)
        run.floor_share.column(z)[lane] =
            building.zones[z].floor_area / building.floor_area();
    try {
        write_meters(lane, run);
        return {};
    } catch (const std::domain_error& error) {
        return error.what();
    }
}

/// The states before a stretch.
void keep_states(std::size_t stretch, Response::Run& run) {
    for (std::size_t z = 0; z < run.zones.size(); ++z) {
        const LaneArray& state = run.group->zones[z].state;
        std::copy_n(state.data(), state.size(),
                    run.zones[z].kept.column(stretch * state.columns()));
    }
}

/// W or degC of the steps of a stretch, from its rows.
const double* shown(Quantity quantity, const Span& stretch, const kernel::PowerRows& rows,
                    Response::Run& run) {
    if (quantity == Quantity::air_temperature) return rows.air;
    if (quantity == Quantity::heating) return rows.heating;
    if (quantity == Quantity::cooling) return rows.cooling;
    run.group->plan.table.meter(run.meter_lanes(quantity), rows, stretch.begin,
                                stretch.end, run.shown.data());
    return run.shown.data();
}

void run_stretch(const Response::Plan& plan, const Span& stretch, Response::Run& run) {
    const auto [begin, end, month] = stretch;
    const kernel::Show show =
        plan.shows_air ? kernel::Show::powers_and_air : kernel::Show::powers;
    const kernel::PowerRows rows = run.group->run(begin, end, show);
    for (std::size_t k = 0; k < plan.channels.size(); ++k)
        plan.shared.table.adjoint.collect(
            plan.of_channels[k].time(),
            shown(plan.channels[k].quantity, stretch, rows, run), begin, end,
            run.channels[k].readings.data());
}

void run_in_one_pass(const Response::Plan& plan, const Span& stretch,
                     Response::Run& run) {
    const auto [begin, end, month] = stretch;
    const kernel::Table& table = plan.shared.table;
    Batch::Group::Zone& zone = run.group->zones[0];
    table.run_metered(zone.time, zone.lanes(),
                      plan.shared.zones[0].segment_of[static_cast<std::size_t>(begin)],
                      begin, end, run.meter_lanes(plan.channels[0].quantity),
                      run.shown.data());
    table.adjoint.collect(plan.of_channels[0].time(), run.shown.data(), begin, end,
                          run.channels[0].readings.data());
}

void run_all(const Response::Plan& plan, Response::Run& run) {
    const bool in_one_pass = plan.in_one_pass();
    for (std::size_t k = 0; k < plan.stretches.size(); ++k) {
        const Span& stretch = plan.stretches[k];
        keep_states(k, run);
        if (!plan.in_period(stretch))
            run.group->run(stretch.begin, stretch.end, kernel::Show::sums);
        else if (in_one_pass)
            run_in_one_pass(plan, stretch, run);
        else
            run_stretch(plan, stretch, run);
    }
    for (Batch::Group::Zone& zone : run.group->zones) zone.sums.clear();
}

/// Readings of a building whose zones are coupled: prepare() has simulated it.
void read_plain(const Response::Plan& plan, Response::Run& run) {
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
void find_failures(const Response::Plan& plan, Response::Run& run) {
    for (std::size_t k = 0; k < run.count; ++k)
        if (run.failures[k].empty() && !run.group->is_finite(static_cast<int>(k)))
            run.failures[k] = why_not_finite(run.group->buildings[k], plan.shared.drive);
}

}  // namespace

Response::Run::Run(const Plan& plan)
    : group(plan.batch.make_group()), of_building(plan.zeros) {
    const int lanes = plan.lanes();
    const auto n_steps = static_cast<std::size_t>(group->most_steps());
    for (const ChannelPlan& channel : plan.of_channels) {
        const std::size_t n = channel.factor.size();
        channels.push_back({LaneArray(n, lanes), LaneArray(n, lanes)});
        if (!is_metered(channel.quantity)) continue;
        const Partition& forms = plan.shared.meter(channel.quantity).rows;
        meter(channel.quantity) = {like(forms, 3, lanes), like(forms, 3, lanes)};
    }
    for (const ZonePlan& zone : plan.shared.zones)
        zones.push_back(make_zone(plan, zone, n_steps));
    shown = LaneArray(n_steps, lanes);
    zeros = LaneArray(n_steps, lanes);
    rows = make_rows(n_steps, lanes);
    of_rows = make_rows(n_steps, lanes);
    floor_share = LaneArray(zones.size(), lanes);
    of_floor_share = LaneArray(zones.size(), lanes);
}

Response::Response(const Batch& batch, std::vector<Channel> channels)
    : plan_(new Plan{batch, batch.plan(), std::move(channels), {}, {}, {}, {}}) {
    for (const Channel& channel : plan_->channels) {
        const bool air = channel.quantity == Quantity::air_temperature;
        bool& is_seen = air ? plan_->shows_air : plan_->shows_powers;
        plan_->of_channels.push_back(plan_channel(channel, plan_->shared));
        plan_->of_channels.back().is_first = !is_seen;
        is_seen = true;
    }
    plan_->stretches = plan_stretches(plan_->shared);
    plan_->written = plan_written(plan_->shared);
    plan_->zeros = zeros_like(plan_->shared.nominal);
    for (const Written& written : plan_->written)
        if (written.target.part == Part::plant) plan_->pulls_powers = true;
}

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
    return !plan_->shared.coupled;
}

void Response::DeleteRun::operator()(Run* run) const {
    delete run;
}

Response::RunPointer Response::make_run() const {
    return RunPointer(new Run(*plan_));
}

std::vector<std::string> Response::predict(const Matrix& points, std::size_t first,
                                           std::size_t count, Run& run) const {
    run.failures = plan_->batch.prepare(points, first, count, *run.group);
    run.count = count;
    if (plan_->shared.coupled) {
        read_plain(*plan_, run);
        return run.failures;
    }
    for (int lane = 0; lane < lanes(); ++lane) {
        const std::string failure = write_lane(lane, run);
        const std::size_t k = std::min(static_cast<std::size_t>(lane), count - 1);
        if (run.failures[k].empty()) run.failures[k] = failure;
    }
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

}  // namespace bemcal::physics
