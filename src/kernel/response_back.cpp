/// The way back of a response: stretches from the last to the first, each run again with
/// a tape, then each lane's coefficients to its parameters.
/// Follows from response.cpp in reverse; kept states and reruns save memory
/// (checkpointing). Not for buildings that run plain or have numbers that follow from
/// others.
#include "adjoint/meters_adjoint.hpp"
#include "base/nan.hpp"
#include "kernel/response.hpp"
#include "kernel/response_plan.hpp"

#include <stdexcept>

namespace bemcal::kernel {

namespace {

void copy(const LaneArray& from, LaneArray& to) {
    std::copy_n(from.data(), from.size(), to.data());
}

/// A stretch on its way back.
class StretchBack {
  public:
    StretchBack(const ResponsePlan& plan, std::size_t index, ResponseRun& run)
        : plan_(plan),
          index_(index),
          run_(run),
          stretch_(plan.stretches[index]),
          in_period_(plan.in_period(stretch_)) {}

    void pull() {
        keep();
        if (is_supplied()) run_.of_extras.clear();
        if (in_period_)
            for (std::size_t k = 0; k < plan_.channels.size(); ++k) seed(k);
        for (std::size_t z = 0; z < run_.zones.size(); ++z) pull_zone(z);
    }

  private:
    const Table& table() const { return plan_.shared.table; }
    bool shares_air() const {
        return in_period_ && plan_.shows_air && run_.zones.size() > 1;
    }
    int n_steps() const { return stretch_.end - stretch_.begin; }
    /// Air systems, or a plant that cycles, stand between zones and meters.
    bool is_supplied() const { return plan_.shared.supplied && in_period_; }
    bool adds_up() const { return run_.zones.size() > 1 || is_supplied(); }

    Stretch in_segments(std::size_t zone) const {
        const std::vector<int>& segment_of = plan_.shared.zones[zone].segment_of;
        return {stretch_.begin, stretch_.end,
                segment_of[static_cast<std::size_t>(stretch_.begin)],
                segment_of[static_cast<std::size_t>(stretch_.end - 1)]};
    }

    ZoneLanes lanes_of(std::size_t zone) {
        ZoneLanes lanes = run_.group->zones[zone].lanes();
        lanes.state = run_.zones[zone].state.data();
        return lanes;
    }

    Show show() const {
        if (is_supplied() || (in_period_ && plan_.shows_air)) return Show::powers_and_air;
        return in_period_ && plan_.pulls_powers ? Show::powers : Show::sums;
    }

    /// Once more forwards, with tapes.
    void keep() {
        const bool add = adds_up() && show() != Show::sums;
        if (add)
            for (LaneArray* rows :
                 {&run_.rows.heating, &run_.rows.cooling, &run_.rows.air})
                rows->clear();
        if (is_supplied()) run_.extras.clear();
        for (std::size_t z = 0; z < run_.zones.size(); ++z) {
            ResponseRun::OfZone& zone = run_.zones[z];
            const std::size_t n = zone.state.columns();
            std::copy_n(zone.kept.column(index_ * n), zone.state.size(),
                        zone.state.data());
            table().adjoint.keep(run_.group->zones[z].time, lanes_of(z), in_segments(z),
                                 show(), zone.rows.pointers(), zone.tape.data());
            if (add)
                table().add_zone(supplied(z), run_.floor_share.column(z), n_steps(),
                                 run_.rows.pointers());
        }
    }

    SupplyPlace place(std::size_t zone) const {
        return run_.group->supply_place(zone, stretch_.begin, stretch_.end);
    }

    /// What a zone shows behind its air system. What it asks for stays in its rows.
    PowerRows supplied(std::size_t index) {
        ResponseRun::OfZone& zone = run_.zones[index];
        if (!is_supplied()) return zone.rows.pointers();
        copy(zone.rows.heating, zone.of_asked.heating);
        copy(zone.rows.cooling, zone.of_asked.cooling);
        copy(zone.rows.air, zone.of_asked.air);
        supply_rows(place(index), zone.of_asked.pointers(), run_.extras, run_.is_broken);
        return zone.of_asked.pointers();
    }

    /// The building's powers, nullptr where they are not needed.
    PowerRows powers() {
        if (!plan_.pulls_powers) return {nullptr, nullptr, nullptr};
        return adds_up() ? run_.rows.pointers() : run_.zones[0].rows.pointers();
    }

    void seed(std::size_t channel) {
        const auto [begin, end, month] = stretch_;
        const ChannelPlan& of_channel = plan_.of_channels[channel];
        const double* sensitivities = run_.channels[channel].sensitivities.data();
        const auto how = of_channel.is_first ? Seed::write : Seed::add;
        if (of_channel.quantity == physics::Quantity::air_temperature)
            return table().adjoint.seed_air(of_channel.time(), sensitivities, begin, end,
                                            how, run_.of_rows.air.data());
        table().adjoint.seed_meter(of_channel.time(), sensitivities,
                                   run_.meter_lanes(of_channel.quantity), powers(), begin,
                                   end, how, run_.of_rows.pointers(),
                                   run_.meter(of_channel.quantity).of_rows.data());
        if (is_supplied() && shows_extras(place(0), of_channel.quantity))
            seed_extras(of_channel, sensitivities);
    }

    void seed_extras(const ChannelPlan& channel, const double* sensitivities) {
        const auto lanes = static_cast<std::size_t>(plan_.lanes());
        double* to = run_.of_shown.data();
        for (int step = stretch_.begin; step < stretch_.end; ++step) {
            const auto interval = static_cast<std::size_t>(
                channel.interval[static_cast<std::size_t>(step)]);
            for (std::size_t k = 0; k < lanes; ++k)
                *to++ = sensitivities[interval * lanes + k] * channel.factor[interval];
        }
        pull_extras(place(0), channel.quantity, run_.extras, run_.of_shown.data(),
                    run_.of_extras, run_.of_lanes);
    }

    /// Adjoints of what a zone asks for, from those of what its system takes.
    PowerRows of_asked(std::size_t index, const PowerRows& of_taken) {
        ResponseRun::OfZone& zone = run_.zones[index];
        const PowerRows to = zone.of_asked.pointers();
        std::copy_n(of_taken.heating, zone.of_asked.heating.size(), to.heating);
        std::copy_n(of_taken.cooling, zone.of_asked.cooling.size(), to.cooling);
        if (of_taken.air != nullptr)
            std::copy_n(of_taken.air, zone.of_asked.air.size(), to.air);
        else
            zone.of_asked.air.clear();
        pull_supply_rows(place(index), zone.rows.pointers(), to, run_.of_extras,
                         run_.of_lanes);
        return to;
    }

    /// Adjoints of what a zone shows.
    PowerRows of_shown(std::size_t index) {
        if (!in_period_) return {run_.zeros.data(), run_.zeros.data(), nullptr};
        PowerRows of_rows = run_.of_rows.pointers();
        if (!plan_.shows_air) of_rows.air = nullptr;
        if (!shares_air()) return is_supplied() ? of_asked(index, of_rows) : of_rows;
        ResponseRun::OfZone& zone = run_.zones[index];
        table().adjoint.share_air(of_rows.air, zone.rows.air.data(),
                                  run_.floor_share.column(index), n_steps(),
                                  zone.of_air.data(), run_.of_floor_share.column(index));
        of_rows.air = zone.of_air.data();
        return is_supplied() ? of_asked(index, of_rows) : of_rows;
    }

    void pull_zone(std::size_t index) {
        ResponseRun::OfZone& zone = run_.zones[index];
        table().adjoint.pull(
            run_.group->zones[index].time, lanes_of(index), in_segments(index),
            of_shown(index), zone.tape.data(),
            {zone.of_regimes.data(), zone.of_rows.data(), zone.of_state.data()});
    }

    const ResponsePlan& plan_;
    std::size_t index_;
    ResponseRun& run_;
    const Span& stretch_;
    bool in_period_;
};

void clear_adjoints(const physics::Building& zeros, ResponseRun& run) {
    for (ResponseRun::OfMeter& meter : run.meters) meter.of_rows.clear();
    for (ResponseRun::OfZone& zone : run.zones)
        for (LaneArray* adjoints : {&zone.of_regimes, &zone.of_rows, &zone.of_state})
            adjoints->clear();
    run.of_floor_share.clear();
    for (physics::Building& of_lane : run.of_lanes) of_lane = zeros;
}

/// Shares of the floor: A_z / sum of A.
void pull_floor_shares(const physics::Building& building, int lane, ResponseRun& run) {
    const double total = building.floor_area();
    double mean = 0;
    for (std::size_t z = 0; z < run.zones.size(); ++z)
        mean += run.of_floor_share.at(z, lane) * run.floor_share.at(z, lane);
    for (std::size_t z = 0; z < run.zones.size(); ++z)
        run.of_building.zones[z].floor_area +=
            (run.of_floor_share.at(z, lane) - mean) / total;
}

void pull_meter(physics::Quantity quantity, const physics::Building& building, int lane,
                ResponseRun& run) {
    const BatchPlan& batch = run.group->plan;
    const MeterPlan& meter = batch.meter(quantity);
    const std::vector<int>& first = meter.rows.first;
    const LaneArray& of_rows = run.meter(quantity).of_rows;
    for (std::size_t row = 0; row < first.size(); ++row) {
        physics::MeterForm of_form;
        of_form.source = of_rows.at(3 * row, lane);
        of_form.per_heating = of_rows.at(3 * row + 1, lane);
        of_form.per_cooling = of_rows.at(3 * row + 2, lane);
        if (meter.has_factor)
            of_form = adjoint::pull_meter_factor(building, batch.drive, quantity,
                                                 first[row], of_form, run.of_building);
        adjoint::pull_meter_form(building, batch.drive, quantity, first[row], of_form,
                                 run.of_building);
    }
}

/// From a lane's coefficients to the numbers of its building.
void pull_building(const ResponsePlan& plan, int lane, ResponseRun& run) {
    const physics::Building& building =
        run.group->buildings[static_cast<std::size_t>(lane)];
    run.of_building =
        run.of_lanes.empty() ? plan.zeros : run.of_lanes[static_cast<std::size_t>(lane)];
    for (std::size_t z = 0; z < run.zones.size(); ++z) {
        const LaneAdjoints adjoints{run.zones[z].of_regimes.data() + lane,
                                    run.zones[z].of_rows.data() + lane, plan.lanes()};
        pull_coefficients(plan.shared.zones[z], building, plan.shared.drive, run.networks,
                          adjoints, run.of_building);
    }
    for (std::size_t q = 0; q < n_quantities; ++q)
        if (!run.meters[q].rows.empty())
            pull_meter(static_cast<physics::Quantity>(q), building, lane, run);
    pull_floor_shares(building, lane, run);
}

/// A number without effect has no part, even where its nominal value is unlimited.
void write_gradient(const ResponsePlan& plan, const physics::Building& of_building,
                    std::span<double> gradient) {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (const Written& written : plan.written) {
        const double of_number = physics::number_at(of_building, written.target);
        if (of_number != 0) gradient[written.parameter] += of_number * written.per_value;
    }
}

}  // namespace

void Response::pull_back(Run& run, Matrix& gradient) const {
    if (!is_differentiable()) throw std::logic_error("this building has no derivatives");
    if (run.way == Way::there) throw std::logic_error("this run has no way back");
    clear_adjoints(plan_->zeros, run);
    for (std::size_t k = plan_->stretches.size(); k-- > 0;)
        StretchBack(*plan_, k, run).pull();
    for (std::size_t k = 0; k < run.count; ++k) {
        if (!run.failures[k].empty()) {
            std::fill(gradient.row(k).begin(), gradient.row(k).end(), nan);
            continue;
        }
        pull_building(*plan_, static_cast<int>(k), run);
        write_gradient(*plan_, run.of_building, gradient.row(k));
    }
}

}  // namespace bemcal::kernel
