/// The inside of a response: what its runs share, and a run.
#pragma once

#include "kernel/affine_adjoint.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_plan.hpp"
#include "kernel/request.hpp"

namespace bemcal::kernel {

/// A channel laid on the drive's steps.
struct ChannelPlan {
    physics::Quantity quantity = physics::Quantity::heating;
    bool is_first = true;        ///< of those that see the powers, or the air
    std::vector<int> interval;   ///< [n_steps] -1 before the period
    std::vector<double> factor;  ///< [n_readings] see IntervalTime
    IntervalTime time() const { return {interval.data(), factor.data()}; }
};

/// A number of the building that a parameter writes to.
struct Written {
    std::size_t parameter;
    physics::Target target;
    double per_value;  ///< d number / d parameter
};

struct ResponsePlan {
    ResponsePlan(const Batch& of_batch, std::vector<Channel> wanted);

    const Batch& batch;
    const BatchPlan& shared;
    std::vector<Channel> channels;
    std::vector<ChannelPlan> of_channels{};
    std::vector<Span> stretches;  ///< warm-up and period in pieces that fit the cache
    std::vector<Written> written;
    physics::Building zeros;  ///< adjoints to start from

    bool shows_air = false;     ///< any channel is the air temperature
    bool shows_powers = false;  ///< any other channel
    bool pulls_powers = false;  ///< the way back needs the powers: plant or meters vary

    int lanes() const { return shared.table.lanes; }
    std::size_t n_zones() const { return shared.zones.size(); }
    bool in_period(const Span& stretch) const {
        return stretch.begin >= shared.drive.n_warm_up;
    }
    /// The only channel is read while the powers are in registers.
    bool in_one_pass() const {
        return channels.size() == 1 &&
               shared.is_metered_in_one_pass(channels[0].quantity);
    }
};

/// Of Way::there, what only the way back needs is empty.
struct ResponseRun {
    ResponseRun(const ResponsePlan& plan, Way which);

    Way way;

    struct OfChannel {
        LaneArray readings, sensitivities;
    };
    /// Forms of a quantity's meter, and their adjoints [3 n_rows x lanes].
    struct OfMeter {
        LaneArray rows, of_rows;
    };
    /// What a zone needs on the way back.
    struct OfZone {
        LaneArray kept;         ///< [n_stretches n_states] states before each stretch
        LaneArray state;        ///< scratch
        LaneArray tape;         ///< of a stretch
        BatchGroup::Rows rows;  ///< of a stretch: what it shows
        LaneArray of_regimes, of_rows, of_state;
        LaneArray of_air;           ///< of a stretch, where there are several zones
        BatchGroup::Rows of_asked;  ///< of a stretch, where a zone has an air system
    };

    Batch::GroupPointer group;
    std::size_t count = 0;  ///< lanes in use
    std::vector<std::string> failures;
    std::vector<OfChannel> channels;
    std::array<OfMeter, n_quantities> meters;
    std::vector<OfZone> zones;
    LaneArray shown;                          ///< a quantity over a stretch
    LaneArray zeros;                          ///< adjoints of the powers in the warm-up
    BatchGroup::Rows rows, of_rows;           ///< of the building over a stretch
    LaneArray floor_share, of_floor_share;    ///< [n_zones]
    LaneArray of_shown;                       ///< of a stretch, where there are
    Extras extras, of_extras;                 ///< systems, or a plant that cycles
    std::vector<char> is_broken;              ///< scratch
    std::vector<physics::Building> of_lanes;  ///< what systems give, of each lane
    NetworkPair networks;
    physics::Building of_building;

    OfMeter& meter(physics::Quantity quantity) {
        return meters[static_cast<std::size_t>(quantity)];
    }
    MeterLanes meter_lanes(physics::Quantity quantity) {
        return {meter(quantity).rows.data(),
                group->plan.meter(quantity).row_offset.data()};
    }
};

}  // namespace bemcal::kernel
