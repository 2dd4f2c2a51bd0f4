/// A group of points under way: numbers into buildings and coefficients, steps of all
/// zones run and added up, meters read from the powers.
/// Follows from affine, meter_rows and the kernel's table. Numbers before the first that
/// changed are not written again. What the points share is in batch_plan, buildings that
/// run plain are run in batch.cpp.
#include "base/error.hpp"
#include "base/nan.hpp"
#include "kernel/batch_plan.hpp"
#include "kernel/meter_rows.hpp"

#include <cmath>

namespace bemcal::kernel {

namespace {

std::size_t longest(const std::vector<Span>& chunks) {
    int most = 1;
    for (const Span& chunk : chunks) most = std::max(most, chunk.end - chunk.begin);
    return static_cast<std::size_t>(most);
}

BatchGroup::Zone make_zone(const ZonePlan& plan, int lanes) {
    const auto columns = [](const Partition& classes, int each) {
        return static_cast<std::size_t>(classes.size()) * static_cast<std::size_t>(each);
    };
    return {plan.time(lanes),
            LaneArray(columns(plan.regimes, plan.regime_columns()), lanes),
            LaneArray(columns(plan.rows, plan.row_columns()), lanes),
            LaneArray(plan.is_standard() ? 1 : plan.states.size(), lanes),
            LaneArray(2, lanes)};
}

}  // namespace

BatchGroup::Rows make_rows(std::size_t steps, int lanes) {
    return {LaneArray(steps, lanes), LaneArray(steps, lanes), LaneArray(steps, lanes)};
}

Show show_for(physics::Quantity quantity) {
    return quantity == physics::Quantity::air_temperature ? Show::powers_and_air
                                                          : Show::powers;
}

const double* shown_as_it_is(physics::Quantity quantity, const BatchPlan& plan,
                             const PowerRows& rows) {
    if (quantity == physics::Quantity::air_temperature) return rows.air;
    if (plan.meter(quantity).has_factor) return nullptr;
    if (quantity == physics::Quantity::heating) return rows.heating;
    return quantity == physics::Quantity::cooling ? rows.cooling : nullptr;
}

BatchGroup::Written::Written(const BatchPlan& plan)
    : buildings(static_cast<std::size_t>(plan.table.lanes), plan.nominal),
      points(buildings.size(), plan.parameters.size()) {
    std::ranges::fill(points.values, nan);
}

BatchGroup::BatchGroup(const BatchPlan& shared)
    : BatchGroup(shared, std::make_shared<Written>(shared), std::nullopt) {}

BatchGroup::BatchGroup(const BatchPlan& shared, std::shared_ptr<Written> of_others,
                       std::optional<physics::Quantity> meter)
    : plan(shared),
      written(std::move(of_others)),
      buildings(written->buildings),
      meter_at_once(meter) {
    const int lanes = plan.table.lanes;
    for (const ZonePlan& zone : plan.zones) zones.push_back(make_zone(zone, lanes));
    floor_share_ = LaneArray(zones.size(), lanes);
    is_broken_.resize(static_cast<std::size_t>(lanes));
    networks_.resize(static_cast<std::size_t>(lanes));
    most_steps_ = longest(plan.chunks);
}

/// Parameters before the first that changes are at their values already.
void BatchGroup::write_building(std::span<const double> point, std::size_t lane) {
    const std::span<double> before = written->points.row(lane);
    const auto is_same = [](double one, double other) {
        return one == other && std::signbit(one) == std::signbit(other);
    };
    const auto first = static_cast<std::size_t>(
        std::ranges::mismatch(point, before, is_same).in1 - point.begin());
    physics::apply(plan.nominal, std::span(plan.parameters).subspan(first),
                   point.subspan(first), buildings[lane]);
    std::ranges::copy(point, before.begin());
}

std::vector<std::string> BatchGroup::write(const Matrix& points, std::size_t first,
                                           std::size_t count) {
    std::vector<std::string> failures(count);
    meter_is_made_.fill(false);
    mixed_is_of_.reset();
    for (std::size_t lane = 0; lane < count; ++lane) {
        write_building(points.row(first + lane), lane);
        write_start(static_cast<int>(lane));
    }
    for (std::size_t zone = 0; zone < zones.size(); ++zone) write_zone(zone, failures);
    for (std::size_t lane = 0; lane < count; ++lane)
        if (!failures[lane].empty()) clear_lane(static_cast<int>(lane));
    const int last = static_cast<int>(count) - 1;
    for (int lane = last + 1; lane < plan.table.lanes; ++lane) repeat_lane(last, lane);
    return failures;
}

void BatchGroup::write_start(int lane) {
    const physics::Building& building = buildings[static_cast<std::size_t>(lane)];
    is_broken_[static_cast<std::size_t>(lane)] = 0;
    for (std::size_t z = 0; z < zones.size(); ++z) {
        kernel::write_start(plan.zones[z], plan.drive.theta_start,
                            zones[z].state.data() + lane, plan.table.lanes);
        floor_share_.column(z)[lane] =
            building.zones[z].floor_area / building.floor_area();
    }
}

/// Regime by regime, all lanes of each: where every hour has its own, the tables are
/// larger than any cache.
void BatchGroup::write_zone(std::size_t zone, std::vector<std::string>& failures) {
    const int lanes = plan.table.lanes;
    double *const regimes = zones[zone].regimes.data(), *const rows =
                                                            zones[zone].rows.data();
    for (int regime = 0; regime < plan.zones[zone].regimes.size(); ++regime) {
        for (std::size_t lane = 0; lane < failures.size(); ++lane) {
            if (!failures[lane].empty()) continue;
            try {
                write_coefficients(plan.zones[zone], regime, buildings[lane], plan.drive,
                                   networks_[lane], maps_,
                                   {regimes + lane, rows + lane, lanes});
            } catch (const CannotSimulate& error) {
                failures[lane] = error.what();
            }
        }
        repeat_coefficients(plan.zones[zone], regime, static_cast<int>(failures.size()),
                            {regimes, rows, lanes});
    }
}

/// All but the coefficients.
void BatchGroup::repeat_lane(int from, int to) {
    const auto source = static_cast<std::size_t>(from),
               target = static_cast<std::size_t>(to);
    buildings[target] = buildings[source];
    std::ranges::copy(written->points.row(source), written->points.row(target).begin());
    for (Zone& zone : zones) zone.state.copy_lane(from, to);
    floor_share_.copy_lane(from, to);
}

/// Coefficients that stay finite, for a lane that failed.
void BatchGroup::clear_lane(int lane) {
    buildings[static_cast<std::size_t>(lane)] = plan.nominal;
    std::ranges::fill(written->points.row(static_cast<std::size_t>(lane)), nan);
    for (Zone& zone : zones)
        for (LaneArray* array : {&zone.regimes, &zone.rows, &zone.state})
            array->clear_lane(lane);
}

bool BatchGroup::is_finite(int lane) const {
    double sum = 0;
    for (std::size_t z = 0; z < zones.size(); ++z)
        for (std::size_t state = 0; state < zones[z].state.columns(); ++state)
            sum += zones[z].state.at(state, lane);
    return std::isfinite(sum) && is_broken_[static_cast<std::size_t>(lane)] == 0;
}

/// Sums alone need no rows, which are larger than all the rest.
void BatchGroup::make_room(Show show) {
    if (show == Show::sums || !of_zone_.heating.empty()) return;
    of_zone_ = make_rows(most_steps_, plan.table.lanes);
    if (zones.size() > 1) of_building_ = make_rows(most_steps_, plan.table.lanes);
    if (plan.supplied) extras_ = Extras(most_steps_, plan.table.lanes);
}

PowerRows BatchGroup::run(int begin, int end, Show show) {
    make_room(show);
    const PowerRows of_zone = of_zone_.pointers();
    const bool add = zones.size() > 1 && show != Show::sums;
    const bool supply = plan.supplied && show != Show::sums;
    if (supply) {
        show = Show::powers_and_air;
        extras_.clear();
    }
    if (add)
        for (LaneArray* array :
             {&of_building_.heating, &of_building_.cooling, &of_building_.air})
            array->clear();
    for (std::size_t z = 0; z < zones.size(); ++z) {
        const int segment = plan.zones[z].segment_of[static_cast<std::size_t>(begin)];
        plan.table.run(zones[z].time, zones[z].lanes(), segment, begin, end, show,
                       of_zone);
        if (supply)
            supply_rows(supply_place(z, begin, end), of_zone, extras_, is_broken_);
        if (add)
            plan.table.add_zone(of_zone, floor_share_.column(z), end - begin,
                                of_building_.pointers());
    }
    return add ? of_building_.pointers() : of_zone;
}

/// A lane whose efficiency is not above 0 somewhere shows nothing, and has failed.
void BatchGroup::write_meter(const MeterPlan& meter, physics::Quantity quantity, int lane,
                             LaneArray& table) {
    try {
        write_meter_rows(meter, buildings[static_cast<std::size_t>(lane)], plan.drive,
                         quantity, lane, table);
    } catch (const CannotSimulate&) {
        table.fill_lane(lane, nan);
        is_broken_[static_cast<std::size_t>(lane)] = 1;
    }
}

MeterLanes BatchGroup::meter(physics::Quantity quantity) {
    const MeterPlan& meter = plan.meter(quantity);
    const auto q = static_cast<std::size_t>(quantity);
    const auto n_rows = static_cast<std::size_t>(meter.rows.size());
    LaneArray& table = meters_[q];
    if (table.empty()) table = LaneArray(3 * n_rows, plan.table.lanes);
    for (std::size_t lane = 0; lane < buildings.size() && !meter_is_made_[q]; ++lane)
        write_meter(meter, quantity, static_cast<int>(lane), table);
    meter_is_made_[q] = true;
    return {table.data(), meter.row_offset.data()};
}

void BatchGroup::write_mixed(physics::Quantity quantity) {
    using C = MixedColumn;
    const ZonePlan& zone = plan.zones[0];
    const MeterPlan& meter_plan = plan.meter(quantity);
    const MeterLanes form = meter(quantity);
    const auto lanes = static_cast<std::size_t>(plan.table.lanes);
    double* to = mixed_.data();
    for (const int first : meter_plan.mixed.first) {
        const auto step = static_cast<std::size_t>(first);
        const double* row = zones[0].rows.data() + zone.row_offset[step];
        const double* of_meter = form.rows + form.row_offset[step];
        const double* watts = zones[0].regimes.data() +
                              zone.regimes.class_of[step] * zones[0].time.regime_size +
                              StandardColumn::watts * plan.table.lanes;
        std::copy_n(row, 2 * lanes, to);
        std::copy_n(of_meter, lanes, to + C::source * lanes);
        for (std::size_t k = 0; k < lanes; ++k) {
            to[C::per_heating * lanes + k] = of_meter[lanes + k] * watts[k];
            to[C::per_cooling * lanes + k] = of_meter[2 * lanes + k] * watts[k];
        }
        to += C::count * lanes;
    }
}

ZoneLanes BatchGroup::mixed(physics::Quantity quantity) {
    if (mixed_is_of_ != quantity) {
        const auto n_rows = static_cast<std::size_t>(plan.meter(quantity).mixed.size());
        if (mixed_.empty() || mixed_.columns() != n_rows * MixedColumn::count)
            mixed_ = LaneArray(n_rows * MixedColumn::count, plan.table.lanes);
        write_mixed(quantity);
        mixed_is_of_ = quantity;
    }
    ZoneLanes zone = zones[0].lanes();
    zone.rows = mixed_.data();
    return zone;
}

const double* BatchGroup::show(physics::Quantity quantity, const PowerRows& rows,
                               int begin, int end) {
    if (const double* power = shown_as_it_is(quantity, plan, rows)) return power;
    if (shown_.empty()) shown_ = LaneArray(most_steps_, plan.table.lanes);
    plan.table.meter(meter(quantity), rows, begin, end, shown_.data());
    show_extras(quantity, begin, end, shown_.data());
    return shown_.data();
}

void BatchGroup::show_extras(physics::Quantity quantity, int begin, int end,
                             double* shown) const {
    if (plan.supplied) add_extras(supply_place(0, begin, end), quantity, extras_, shown);
}

}  // namespace bemcal::kernel
