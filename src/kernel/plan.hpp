/// What the points of a batch share: how time falls into pieces that the fast kernel can
/// walk through with fixed coefficients.
///
/// A regime is a distinct set of conductances and set-points: a distinct row of the
/// profiles that drive them, and of the season. A row is a distinct set of gains within a
/// regime. Drivers are series that enter linearly, step by step (linear_input.hpp):
/// outdoor air and what it differs by, boundaries, irradiance, and loads with more
/// distinct values than are worth a table. Segments are runs of steps of one regime, in
/// sun or in the dark.
#pragma once

#include "kernel/kernel.hpp"
#include "kernel/partition.hpp"
#include "physics/meters.hpp"
#include "physics/parameters.hpp"
#include "physics/step_map.hpp"

#include <span>
#include <vector>

namespace bemcal::kernel {

/// What a zone's seasons have as limits, over all points [degC].
class SeasonLimits {
  public:
    void add(const physics::Structure& structure);
    bool is_seasonal() const {
        return heating_.least < physics::unlimited || cooling_.most > -physics::unlimited;
    }
    /// Steps in which the shares of rooms are the same, whatever the limits.
    Partition classes(std::span<const double> theta_rm) const;
    /// Whether these are the classes of a structure, too.
    bool has(const physics::Structure& structure) const;

  private:
    struct Ends {
        double least = physics::unlimited, most = -physics::unlimited;
    };
    Ends heating_, cooling_;
};

struct ZonePlan {
    std::size_t zone = 0;
    std::vector<physics::Term>
        states;                  ///< of a zone with refinements; empty = standard hour
    std::vector<int> planes;     ///< that its elements lie in
    bool shifted = false;        ///< outdoors differs from the weather, or may
    bool vented = false;         ///< openings follow the room, or may
    bool elements_vary = false;  ///< surfaces or windows follow a profile
    SeasonLimits season;
    std::vector<int> temperature_drivers;  ///< profiles of temperatures
    std::vector<int> load_drivers;         ///< profiles of loads that are drivers
    bool imposed_driver = false;  ///< imposed power follows a profile: the last driver
    Partition regimes, rows;
    std::vector<std::vector<int>> rows_of_regime;  ///< [n_regimes]
    std::vector<double> drivers;                   ///< [n_steps x (n_drivers + planes)]
    std::vector<int> row_offset;                   ///< [n_steps]
    std::vector<Segment> segments;
    std::vector<int> segment_of;  ///< [n_steps]

    bool is_standard() const { return states.empty(); }
    /// Of the states that of the air, where openings follow it; -1 = they do not.
    int vented_state() const;
    int n_drivers() const;
    int regime_columns() const;
    int of_regime_columns() const;  ///< of its adjoints, see ZoneAdjoint
    int row_columns() const;
    ZoneTime time(int lanes) const;
};

/// What plans are made for.
struct Nominal {
    const physics::Building& building;
    const std::vector<physics::Parameter>& parameters;
    const physics::Drive& drive;
    int lanes;
};
ZonePlan plan_zone(const Nominal& nominal, std::size_t zone, ProfileClasses& classes);

/// A run of steps within one month; months count from 0.
struct Span {
    int begin, end, month;
};
/// The period's months, in steps of the drive.
std::vector<Span> plan_months(const physics::Drive& drive);
/// The same in pieces whose rows fit the first-level cache.
std::vector<Span> cut_chunks(const std::vector<Span>& months);

/// Steps in which a meter's form is the same.
struct MeterPlan {
    Partition rows;
    /// The shares of the powers follow a profile: that of the plant's efficiency or of
    /// the meter's factor.
    bool shares_vary = false;
    bool has_factor = false;      ///< other than 1, or may have
    std::vector<int> row_offset;  ///< [n_steps]
    /// Steps in which the rows of a single standard zone are the same, too: the rows of
    /// MixedLanes. Empty for other buildings.
    Partition mixed;
    std::vector<int> mixed_offset;  ///< [n_steps]
};
/// Fills what is said of mixed rows.
void plan_mixed(const ZonePlan& zone, int lanes, MeterPlan& meter);
MeterPlan plan_meter(const Nominal& nominal, physics::Quantity quantity,
                     ProfileClasses& classes);

/// Where the rows of the steps' classes begin.
std::vector<int> offsets_of(const Partition& rows, int doubles_per_row);

}  // namespace bemcal::kernel
