/// Lays channels on the steps, cuts warm-up and period into stretches, lists the numbers
/// that parameters write to, and reserves the memory of a run.
/// Plain bookkeeping without a source. Of two parameters that write to one number the
/// last one counts. Layers, radiators and couplings have no adjoints.
#include "kernel/response_plan.hpp"

#include "kernel/request_plan.hpp"

#include <map>

namespace bemcal::kernel {

namespace {

ChannelPlan plan_channel(const Channel& channel, const BatchPlan& batch) {
    const physics::Drive& drive = batch.drive;
    const std::vector<int> bounds = batch.bounds_of(channel.interval);
    ChannelPlan plan;
    plan.quantity = channel.quantity;
    plan.interval.assign(static_cast<std::size_t>(drive.n_warm_up), -1);
    plan.interval.reserve(static_cast<std::size_t>(drive.n_steps()));
    for (std::size_t k = 0; k + 1 < bounds.size(); ++k) {
        const int n = bounds[k + 1] - bounds[k];
        plan.interval.insert(plan.interval.end(), static_cast<std::size_t>(n),
                             static_cast<int>(k));
        plan.factor.push_back(channel.quantity == physics::Quantity::air_temperature
                                  ? 1.0 / n
                                  : kWh_per_W(drive));
    }
    return plan;
}

std::vector<Span> plan_stretches(const BatchPlan& batch) {
    std::vector<Span> stretches = cut_chunks({{0, batch.drive.n_warm_up, 0}});
    stretches.insert(stretches.end(), batch.chunks.begin(), batch.chunks.end());
    return stretches;
}

double per_value(double number, const physics::Parameter& parameter) {
    const bool is_factor = parameter.effect == physics::Effect::factor;
    return is_factor ? number / parameter.nominal : 1;
}

/// Every number that a parameter writes to, once: of two parameters the last one holds.
std::vector<Written> plan_written(const BatchPlan& batch) {
    physics::Building building = batch.nominal;
    std::map<const double*, std::size_t> known;
    std::vector<Written> written;
    for (std::size_t p = 0; p < batch.parameters.size(); ++p)
        for (const physics::Target& target : batch.parameters[p].targets) {
            const double& number = physics::number_at(building, target);
            const Written entry{p, target,
                                per_value(number, batch.parameters[p]) * target.weight};
            const auto [place, is_new] = known.try_emplace(&number, written.size());
            if (is_new)
                written.push_back(entry);
            else
                written[place->second] = entry;
        }
    return written;
}

/// As many parts as the building has, without words.
physics::Building parts_of(const physics::Building& building) {
    physics::Building parts;
    parts.constructions.resize(building.constructions.size());
    parts.glazings.resize(building.glazings.size());
    parts.boundaries.resize(building.boundaries.size());
    parts.air_systems.resize(building.air_systems.size());
    parts.zones.resize(building.zones.size());
    for (std::size_t z = 0; z < parts.zones.size(); ++z) {
        parts.zones[z].surfaces.resize(building.zones[z].surfaces.size());
        parts.zones[z].windows.resize(building.zones[z].windows.size());
        parts.zones[z].flows.resize(building.zones[z].flows.size());
        parts.zones[z].loads.resize(building.zones[z].loads.size());
    }
    return parts;
}

std::size_t count_in(const physics::Zone& zone, physics::Part part) {
    switch (part) {
        case physics::Part::surface:
            return zone.surfaces.size();
        case physics::Part::window:
            return zone.windows.size();
        case physics::Part::flow:
            return zone.flows.size();
        case physics::Part::load:
            return zone.loads.size();
        default:
            return part == physics::Part::zone ? 1 : 0;
    }
}

/// How many parts of a kind stand in the building itself, or have such parts.
std::size_t count_in(const physics::Building& building, physics::Part part) {
    switch (part) {
        case physics::Part::construction:
            return building.constructions.size();
        case physics::Part::glazing:
            return building.glazings.size();
        case physics::Part::boundary:
            return building.boundaries.size();
        case physics::Part::air_system:
            return building.air_systems.size();
        case physics::Part::plant:
            return 1;
        case physics::Part::meter:
            return building.meter_factor.size();
        default:
            return building.zones.size();
    }
}

bool is_of_zone(physics::Part part) {
    return part != physics::Part::construction && part != physics::Part::glazing &&
           part != physics::Part::boundary && part != physics::Part::plant &&
           part != physics::Part::meter && part != physics::Part::air_system;
}

/// The number of a part's field set to 0; of an input all of its numbers.
void set_to_zero(physics::Building& building, physics::Target target,
                 physics::Building& zeros) {
    physics::Input* input = physics::input_at(zeros, target);
    if (input == nullptr) {
        physics::number_at(zeros, target) = 0;
        return;
    }
    input->value = input->low = 0;
    input->changes.resize(physics::input_at(building, target)->changes.size());
}

/// The building's parts with all of their numbers 0.
physics::Building zeros_like(physics::Building building) {
    physics::Building zeros = parts_of(building);
    for (std::size_t field = 0; field < physics::fields().size(); ++field) {
        const physics::Part part = physics::fields()[field].part;
        for (std::size_t k = 0; k < count_in(zeros, part); ++k) {
            const std::size_t n = is_of_zone(part) ? count_in(zeros.zones[k], part) : 1;
            for (std::size_t inner = 0; inner < n; ++inner)
                set_to_zero(building,
                            {part, static_cast<int>(k), static_cast<int>(inner),
                             static_cast<int>(field)},
                            zeros);
        }
    }
    return zeros;
}

bool is_metered(physics::Quantity quantity) {
    return quantity != physics::Quantity::air_temperature;
}

std::size_t columns_of(const Partition& classes, int each) {
    return static_cast<std::size_t>(classes.size() * each);
}

int tape_columns(const ZonePlan& zone) {
    return zone.is_standard()
               ? static_cast<int>(StandardTape::count)
               : general_tape_columns(static_cast<int>(zone.states.size()));
}

ResponseRun::OfZone make_zone(const ResponsePlan& plan, const ZonePlan& zone,
                              std::size_t n_steps, Way way) {
    const int lanes = plan.lanes();
    const std::size_t n_states = zone.is_standard() ? 1 : zone.states.size();
    ResponseRun::OfZone run;
    run.kept = LaneArray(plan.stretches.size() * n_states, lanes);
    if (way == Way::there) return run;
    run.state = LaneArray(n_states, lanes);
    run.tape = LaneArray(n_steps * static_cast<std::size_t>(tape_columns(zone)), lanes);
    run.rows = make_rows(n_steps, lanes);
    run.of_regimes = LaneArray(columns_of(zone.regimes, zone.of_regime_columns()), lanes);
    run.of_rows = LaneArray(columns_of(zone.rows, zone.row_columns()), lanes);
    run.of_state = LaneArray(n_states, lanes);
    run.of_air = LaneArray(n_steps, lanes);
    if (plan.shared.supplied) run.of_asked = make_rows(n_steps, lanes);
    return run;
}

ResponseRun::OfChannel make_channel(const ChannelPlan& plan, int lanes, Way way) {
    const std::size_t n = plan.factor.size();
    return {LaneArray(n, lanes), way == Way::there ? LaneArray() : LaneArray(n, lanes)};
}

ResponseRun::OfMeter make_meter(const Partition& forms, int lanes, Way way) {
    const std::size_t n = columns_of(forms, 3);
    return {LaneArray(n, lanes), way == Way::there ? LaneArray() : LaneArray(n, lanes)};
}

/// What the building needs on the way back.
void make_way_back(const ResponsePlan& plan, std::size_t n_steps, ResponseRun& run) {
    const int lanes = plan.lanes();
    run.zeros = LaneArray(n_steps, lanes);
    run.rows = make_rows(n_steps, lanes);
    run.of_rows = make_rows(n_steps, lanes);
    run.of_floor_share = LaneArray(run.zones.size(), lanes);
    if (!plan.shared.supplied) return;
    run.of_shown = LaneArray(n_steps, lanes);
    for (Extras* extras : {&run.extras, &run.of_extras}) *extras = Extras(n_steps, lanes);
    run.is_broken.resize(static_cast<std::size_t>(lanes));
    run.of_lanes.assign(static_cast<std::size_t>(lanes), plan.zeros);
}

void add_channel(const Channel& channel, ResponsePlan& plan) {
    const bool air = channel.quantity == physics::Quantity::air_temperature;
    bool& is_seen = air ? plan.shows_air : plan.shows_powers;
    plan.of_channels.push_back(plan_channel(channel, plan.shared));
    plan.of_channels.back().is_first = !is_seen;
    is_seen = true;
}

}  // namespace

ResponsePlan::ResponsePlan(const Batch& of_batch, std::vector<Channel> wanted)
    : batch(of_batch),
      shared(batch.plan()),
      channels(std::move(wanted)),
      stretches(plan_stretches(shared)),
      written(plan_written(shared)),
      zeros(zeros_like(shared.nominal)) {
    for (const Channel& channel : channels) add_channel(channel, *this);
    for (const Written& number : written)
        if (number.target.part == physics::Part::plant ||
            number.target.part == physics::Part::meter)
            pulls_powers = true;
}

ResponseRun::ResponseRun(const ResponsePlan& plan, Way which)
    : way(which), group(plan.batch.make_group()), of_building(plan.zeros) {
    const int lanes = plan.lanes();
    const auto n_steps = static_cast<std::size_t>(group->most_steps());
    for (const ChannelPlan& channel : plan.of_channels) {
        channels.push_back(make_channel(channel, lanes, way));
        if (is_metered(channel.quantity))
            meter(channel.quantity) =
                make_meter(plan.shared.meter(channel.quantity).rows, lanes, way);
    }
    for (const ZonePlan& zone : plan.shared.zones)
        zones.push_back(make_zone(plan, zone, n_steps, way));
    shown = LaneArray(n_steps, lanes);
    floor_share = LaneArray(zones.size(), lanes);
    if (way == Way::there_and_back) make_way_back(plan, n_steps, *this);
}

}  // namespace bemcal::kernel
