/// The inside of a batch: what its points share, and a group of them under way.
#pragma once

#include "physics/affine.hpp"
#include "physics/batch.hpp"
#include "physics/lane_array.hpp"

#include <array>
#include <optional>

namespace bemcal::physics {

constexpr std::size_t n_quantities = 6, n_intervals = 5;

struct Batch::Plan {
    const Building& nominal;
    std::vector<Parameter> parameters;
    const Drive& drive;
    const kernel::Table& table;
    bool plain = false;                ///< runs_plain
    std::vector<Span> months, chunks;  ///< of the period, in steps of the drive
    std::vector<ZonePlan> zones;       ///< empty where plain
    std::array<MeterPlan, n_quantities> meters;
    std::array<std::vector<int>, n_intervals> bounds;  ///< in steps of the period

    int n_months() const { return static_cast<int>(months.size()); }
    /// A meter can be read while the powers are in registers.
    bool is_metered_in_one_pass(Quantity quantity) const {
        return quantity != Quantity::air_temperature && zones.size() == 1 &&
               zones[0].is_standard();
    }
    const MeterPlan& meter(Quantity quantity) const {
        return meters[static_cast<std::size_t>(quantity)];
    }
};

struct Batch::Group {
    struct Zone {
        kernel::ZoneTime time;
        LaneArray regimes, rows, state, sums;
        kernel::ZoneLanes lanes() {
            return {regimes.data(), rows.data(), state.data(), sums.data()};
        }
    };
    struct Rows {
        LaneArray heating, cooling, air;
        kernel::PowerRows pointers() {
            return {heating.data(), cooling.data(), air.data()};
        }
    };

    /// The points of the lanes as buildings; groups may write theirs one after another.
    struct Written {
        explicit Written(const Batch::Plan& plan);
        std::vector<Building> buildings;  ///< [lanes]
        Matrix points;                    ///< [lanes x parameters] that they are at
    };

    explicit Group(const Batch::Plan& shared);
    /// One that writes into buildings of others, and reads this meter at once.
    Group(const Batch::Plan& shared, std::shared_ptr<Written> buildings,
          std::optional<Quantity> meter);
    /// One lane's coefficients and start. Throws std::domain_error where the point is
    /// impossible.
    void write_lane(std::span<const double> point, int lane);
    void copy_lane(int from, int to);
    bool is_finite(int lane) const;  ///< all states are numbers
    void clear_lane(int lane);  ///< coefficients that stay finite, for a lane that failed
    /// Steps [begin, end) of all zones; no more than a chunk if something is shown.
    /// Returns the building's rows.
    kernel::PowerRows run(int begin, int end, kernel::Show show);
    /// Steps that a run may show.
    int most_steps() const { return static_cast<int>(most_steps_); }
    kernel::MeterLanes meter(Quantity quantity);
    /// The only zone, a standard one, with the meter's form in its rows.
    kernel::ZoneLanes mixed(Quantity quantity);
    /// W or degC of a chunk's steps [steps x lanes], after run() with `show` for that
    /// quantity.
    const double* show(Quantity quantity, const kernel::PowerRows& rows, int begin,
                       int end);

    const Batch::Plan& plan;
    std::shared_ptr<Written> written;
    std::vector<Building>& buildings;  ///< [lanes] points written into the nominal
    std::optional<Quantity> meter_at_once;
    std::vector<Zone> zones;
    std::array<LaneArray, n_quantities> plain;  ///< where the plan is, over the period

  private:
    void make_room(kernel::Show show);
    void write_building(std::span<const double> point, std::size_t lane);
    void write_mixed(Quantity quantity);

    Network network_;        ///< scratch
    LaneArray floor_share_;  ///< [zones x lanes]
    std::size_t most_steps_ = 1;
    Rows of_zone_, of_building_;                      ///< of a chunk
    LaneArray shown_;                                 ///< a quantity over a chunk
    std::array<LaneArray, n_quantities> meters_;      ///< coefficients,
    std::array<bool, n_quantities> meter_is_made_{};  ///< written when first needed
    LaneArray mixed_;                                 ///< rows of kernel::MixedLanes,
    std::optional<Quantity> mixed_is_of_;
};

/// What a run has to show for a quantity.
kernel::Show show_for(Quantity quantity);

/// The rows that a quantity is; nullptr where a meter makes it.
const double* shown_as_it_is(Quantity quantity, const Batch::Plan& plan,
                             const kernel::PowerRows& rows);

/// Why a lane went wrong: the plain version says where.
std::string why_not_finite(const Building& building, const Drive& drive);

}  // namespace bemcal::physics
