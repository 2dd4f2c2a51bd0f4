/// The inside of a batch: what its points share, and a group of them under way.
#pragma once

#include "base/lane_array.hpp"
#include "base/matrix.hpp"
#include "kernel/affine.hpp"
#include "kernel/supply.hpp"
#include "physics/drive.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bemcal::kernel {

using physics::n_quantities;
constexpr std::size_t n_intervals = 5;

struct BatchPlan {
    const physics::Building& nominal;
    std::vector<physics::Parameter> parameters;
    const physics::Drive& drive;
    const Table& table;
    bool plain = false;     ///< runs_plain
    bool supplied = false;  ///< some zone has an air system, or the plant may cycle
    std::vector<Span> months, chunks;  ///< of the period, in steps of the drive
    std::vector<ZonePlan> zones;       ///< empty where plain
    std::array<MeterPlan, n_quantities> meters;
    std::array<std::vector<int>, n_intervals> bounds;  ///< the calendar's, in steps of
                                                       ///< the period

    /// First steps of the intervals, and the period's number of steps.
    std::vector<int> bounds_of(const physics::Intervals& intervals) const;
    int n_months() const { return static_cast<int>(months.size()); }
    /// A meter can be read while the powers are in registers.
    bool is_metered_in_one_pass(physics::Quantity quantity) const {
        return quantity != physics::Quantity::air_temperature && zones.size() == 1 &&
               zones[0].is_standard() && !supplied;
    }
    const MeterPlan& meter(physics::Quantity quantity) const {
        return meters[static_cast<std::size_t>(quantity)];
    }
};

struct BatchGroup {
    struct Zone {
        ZoneTime time;
        LaneArray regimes, rows, state, sums;
        ZoneLanes lanes() {
            return {regimes.data(), rows.data(), state.data(), sums.data()};
        }
    };
    struct Rows {
        LaneArray heating, cooling, air;
        PowerRows pointers() { return {heating.data(), cooling.data(), air.data()}; }
    };

    /// The points of the lanes as buildings; groups may write theirs one after another.
    struct Written {
        explicit Written(const BatchPlan& plan);
        std::vector<physics::Building> buildings;  ///< [lanes]
        Matrix points;  ///< [lanes x parameters] that they are at
    };

    explicit BatchGroup(const BatchPlan& shared);
    /// One that writes into buildings of others, and reads this meter at once.
    BatchGroup(const BatchPlan& shared, std::shared_ptr<Written> buildings,
               std::optional<physics::Quantity> meter);
    /// Coefficients and starts of points [first, first + count), which take the first
    /// lanes; lanes beyond are as the last of these. Says of each why it is impossible,
    /// empty = it is not; its coefficients then are finite.
    std::vector<std::string> write(const Matrix& points, std::size_t first,
                                   std::size_t count);
    bool is_finite(int lane) const;  ///< all states are numbers
    /// Steps [begin, end) of all zones; no more than a chunk if something is shown.
    /// Returns the building's rows.
    PowerRows run(int begin, int end, Show show);
    /// Steps that a run may show.
    int most_steps() const { return static_cast<int>(most_steps_); }
    MeterLanes meter(physics::Quantity quantity);
    /// The only zone, a standard one, with the meter's form in its rows.
    ZoneLanes mixed(physics::Quantity quantity);
    /// W or degC of a chunk's steps [steps x lanes], after run() with `show` for that
    /// quantity.
    const double* show(physics::Quantity quantity, const PowerRows& rows, int begin,
                       int end);
    /// Adds to what a meter shows what fans and cycling of the last run take.
    void show_extras(physics::Quantity quantity, int begin, int end, double* shown) const;
    SupplyPlace supply_place(std::size_t zone, int begin, int end) const {
        return {buildings, zone, plan.drive, begin, end};
    }

    const BatchPlan& plan;
    std::shared_ptr<Written> written;
    std::vector<physics::Building>&
        buildings;  ///< [lanes] points written into the nominal
    std::optional<physics::Quantity> meter_at_once;
    std::vector<Zone> zones;
    std::array<LaneArray, n_quantities> plain;  ///< where the plan is, over the period

  private:
    void make_room(Show show);
    void write_building(std::span<const double> point, std::size_t lane);
    void write_start(int lane);
    void write_zone(std::size_t zone, std::vector<std::string>& failures);
    void repeat_lane(int from, int to);
    void clear_lane(int lane);
    void write_meter(const MeterPlan& meter, physics::Quantity quantity, int lane,
                     LaneArray& table);
    void write_mixed(physics::Quantity quantity);

    std::vector<physics::Network> networks_;  ///< [lanes] of the last regime
    physics::StepMaps maps_;
    LaneArray floor_share_;  ///< [zones x lanes]
    std::size_t most_steps_ = 1;
    Rows of_zone_, of_building_;   ///< of a chunk
    LaneArray shown_;              ///< a quantity over a chunk
    Extras extras_;                ///< over a chunk
    std::vector<char> is_broken_;  ///< [lanes] what a system takes is not finite
    std::array<LaneArray, n_quantities> meters_;      ///< coefficients,
    std::array<bool, n_quantities> meter_is_made_{};  ///< written when first needed
    LaneArray mixed_;                                 ///< rows of MixedLanes,
    std::optional<physics::Quantity> mixed_is_of_;
};

/// \return rows of `steps`, of each quantity
BatchGroup::Rows make_rows(std::size_t steps, int lanes);

/// What a run has to show for a quantity.
Show show_for(physics::Quantity quantity);

/// The rows that a quantity is; nullptr where a meter makes it.
const double* shown_as_it_is(physics::Quantity quantity, const BatchPlan& plan,
                             const PowerRows& rows);

/// Why a lane went wrong: the plain version says where.
std::string why_not_finite(const physics::Building& building,
                           const physics::Drive& drive);

}  // namespace bemcal::kernel
