/// What the points of a batch share: how time falls into pieces that the fast kernel can
/// walk through with fixed coefficients.
///
/// A regime is a distinct set of conductances and set-points: a distinct row of the
/// profiles that drive them. A row is a distinct set of gains within a regime. Drivers
/// are series that enter linearly, step by step: outdoor air, boundaries, irradiance, and
/// loads with more distinct values than are worth a table. Segments are runs of steps of
/// one regime, in sun or in the dark.
#pragma once

#include "physics/kernel.hpp"
#include "physics/meters.hpp"
#include "physics/parameters.hpp"
#include "physics/step_map.hpp"

#include <vector>

namespace bemcal::physics {

/// Steps sorted into classes, numbered in the order of their first appearance.
struct Partition {
    std::vector<int> class_of;  ///< [n_steps]
    std::vector<int> first;     ///< [n_classes] step in which the class appears first
    int size() const { return static_cast<int>(first.size()); }
};
Partition one_class(int n_steps);
/// The classes in which all of these rows of Drive::profiles are constant, too.
Partition refine(Partition classes, const Drive& drive, const std::vector<int>& profiles);

struct ZonePlan {
    std::size_t zone = 0;
    std::vector<Term> states;  ///< of a zone with refinements; empty = standard hour
    std::vector<int> planes;   ///< that its elements lie in
    std::vector<int> boundary_drivers;  ///< boundaries whose temperature varies
    std::vector<int> load_drivers;      ///< profiles of loads that are drivers
    bool imposed_driver = false;  ///< imposed power follows a profile: the last driver
    Partition regimes, rows;
    std::vector<std::vector<int>> rows_of_regime;  ///< [n_regimes]
    std::vector<double> drivers;                   ///< [n_steps x (n_drivers + planes)]
    std::vector<int> row_offset;                   ///< [n_steps]
    std::vector<kernel::Segment> segments;
    std::vector<int> segment_of;  ///< [n_steps]

    bool is_standard() const { return states.empty(); }
    int n_drivers() const;
    int regime_columns() const;
    int of_regime_columns() const;  ///< of its adjoints, see kernel::ZoneAdjoint
    int row_columns() const;
    kernel::ZoneTime time(int lanes) const;
};

ZonePlan plan_zone(const Building& nominal, const std::vector<Parameter>& parameters,
                   const Drive& drive, std::size_t zone, int lanes);

/// A run of steps within one month; months count from 0.
struct Span {
    int begin, end, month;
};
/// The period's months, in steps of the drive.
std::vector<Span> plan_months(const Drive& drive);
/// The same in pieces whose rows fit the first-level cache.
std::vector<Span> cut_chunks(const std::vector<Span>& months);

/// Steps in which a meter's form is the same.
struct MeterPlan {
    Partition rows;
    bool plant_varies = false;    ///< the plant's efficiency follows a profile
    std::vector<int> row_offset;  ///< [n_steps]
    /// [n_months x n_rows] steps of the period.
    std::vector<std::vector<double>> row_counts;
    /// Steps in which the rows of a single standard zone are the same, too: the rows of
    /// kernel::MixedLanes. Empty for other buildings.
    Partition mixed;
    std::vector<int> mixed_offset;  ///< [n_steps]
};
/// Fills what is said of mixed rows.
void plan_mixed(const ZonePlan& zone, int lanes, MeterPlan& meter);
MeterPlan plan_meter(const Building& nominal, const Drive& drive, Quantity quantity,
                     const std::vector<Span>& months, int lanes);

}  // namespace bemcal::physics
