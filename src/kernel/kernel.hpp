/// The border between the batch and its time loops: plain structs and a table of
/// functions.
///
/// One file per instruction set fills the table (kernel_scalar, kernel_v3, kernel_v4)
/// from the same source (kernel_body.inl, kernel_reduce.inl). This header has no standard
/// templates: in those files they would become weak symbols full of instructions that the
/// linker may give to the rest of the program.
///
/// Lane data is [columns x lanes]: a column is one coefficient of all points of a group.
#pragma once

namespace bemcal::kernel {

/// What a run writes beside the sums of the powers: nothing, powers, or air temperature
/// too.
enum class Show { sums, powers, powers_and_air };

/// Steps [begin, end) over which conductances and set-points hold; in_sun = 0 where all
/// irradiance is 0.
struct Segment {
    int begin, end, regime, in_sun;
};

/// Columns of a regime of the standard hour with a thermostat. Powers are carried as the
/// change of the mass temperature that they cause in a step [K].
struct StandardColumn {
    enum : int {
        keep,          ///< of the mass temperature from step to step [-]
        gain,          ///< power asked per mass temperature [-]
        most_heating,  ///< limit, >= 0
        gap,           ///< between the set-points, as power
        most_cooling,  ///< limit, <= 0
        watts,         ///< power per change of the mass temperature [W/K]
        kelvin,        ///< air temperature per power [-]
        set_point,     ///< of heating [degC]
        sun_mass,      ///< mass temperature per solar gain [K/W]
        sun_asked,     ///< power asked per solar gain [K/W]
        drivers  ///< pairs (mass, asked) per driver, then the apertures of the planes
    };
};
constexpr int standard_row_columns = 2;  ///< constants of (mass, asked)

/// Columns of a regime of any other zone, n states: forms are the free air temperature
/// and the states after the step, 1 + n of them.
struct GeneralColumn {
    enum : int {
        most_heating,  ///< [W]
        most_cooling,  ///< [W], >= 0
        gain_heating,  ///< power asked per kelvin of the free air temperature [W/K]
        gain_cooling,
        reach_heating,  ///< by which rooms differ from what is asked [W]
        reach_cooling,
        span_heating,  ///< of the hottest room's power, over which some ask [W]
        span_cooling,
        per_span_heating,  ///< [1/W]; 0 where they do not differ
        per_span_cooling,
        together,  ///< of the hottest room's cooling, what each gets at least [-]
        imposed,   ///< power per value of the last driver [W]
        forms  ///< (1 + n) each: heating, cooling, states, sun, drivers; then apertures
    };
};
/// Columns of openings that follow the room, after the apertures.
struct VentingColumn {
    enum : int {
        opens_above,  ///< [degC]
        per_band,     ///< [1/K]
        forms         ///< (1 + n) per W that reaches the air node
    };
};
constexpr int general_row_columns(int n_states) {
    return 3 + n_states;
}  ///< forms, asked twice; then what openings carry when wide open [W/K], if any

/// A zone's time, the same for all points.
struct ZoneTime {
    int n_states;      ///< 0 = the standard hour with a thermostat
    int imposed;       ///< 1 = power imposed from the last driver and the rows
    int vented_state;  ///< the state that is the air, followed by openings; -1 = none
    int n_drivers, n_planes;
    int regime_size;        ///< doubles, all lanes
    int of_regime_size;     ///< of a regime's adjoints
    const double* drivers;  ///< [n_steps x (n_drivers + n_planes)], theta_e first
    const int* row_offset;  ///< [n_steps] from ZoneLanes::rows, in doubles
    const Segment* segments;
};

/// A zone of a group of points.
struct ZoneLanes {
    const double* regimes;  ///< [n_regimes x columns x lanes]
    const double* rows;     ///< [n_rows x row columns x lanes]
    double* state;          ///< [states x lanes]
    double* sums;           ///< [2 x lanes] heating and cooling, added to [W steps]
};

/// Rows [steps x lanes] of heating and cooling [W] and air temperature [degC].
struct PowerRows {
    double *heating, *cooling, *air;
};

/// One meter of a group: [n_rows x 3 x lanes] source [W], share of heating, of cooling.
struct MeterLanes {
    const double* rows;
    const int* row_offset;  ///< [n_steps]
};

/// What the mixed rows of a Sobol design are compared with: rows [steps x lanes] of its
/// matrices A and B; and sums [steps x 3 x lanes] of b (y - a), y - a and (y - a)^2.
struct DifferenceLanes {
    const double *a, *b;
    double* sums;
};

/// Columns of a row of MixedLanes: a standard row, then a meter's form: its source [W]
/// and its shares of the powers [W/K].
struct MixedColumn {
    enum : int { mass, asked, source, per_heating, per_cooling, count };
};

/// A group of mixed rows of a Sobol design; its rows are [n_rows x MixedColumn x lanes].
/// a, b: what it is compared with [steps x lanes].
struct MixedLanes {
    ZoneLanes zone;
    const double *a, *b;
};

/// Readings of a meter, the same for all points.
struct ReadingTime {
    const int* closes;       ///< [n_steps] interval that ends with the step, or -1
    const double* measured;  ///< [n_intervals] NaN = missing
    const double* inverse;   ///< 1 / |measured|, or 0
    const double*
        factor;  ///< from the sum of W or degC over the interval to the reading's unit
};

/// Columns of a reading's sums.
struct ErrorColumn {
    enum : int { open_interval, error, square, product, relative, count };
};

/// The interval of each step, and what makes the interval's reading of the sum over its
/// steps of W or degC.
struct IntervalTime {
    const int* interval;   ///< [n_steps] -1 before the period
    const double* factor;  ///< [n_intervals]
};

/// Steps [begin, end) and the segments of the first and the last of them.
struct Stretch {
    int begin, end, first_segment, last_segment;
};

/// d objective / d each element of a zone's coefficients and state, in their shapes; but
/// in a regime of the standard hour the planes are pairs (mass, asked) as the drivers
/// are: sums of their irradiance with both adjoints. sun_mass, sun_asked and the
/// apertures follow from them (affine_adjoint.cpp).
struct ZoneAdjoint {
    double *regimes, *rows, *state;
};

/// Columns of a step's tape, what the way back needs of the way forward: the mass before
/// the step, the powers [K], what they leave of the power asked. Where the way back has
/// been, the adjoints of the mass after the step and of the power asked stand in place of
/// the powers.
struct StandardTape {
    enum : int {
        theta_m,
        heating,
        cooling,
        excess,
        count,
        mass = heating,
        asked = cooling
    };
};
constexpr int general_tape_columns(int n_states) {
    return n_states + 3;
}  ///< states before, air with no power, heating, cooling

/// Whether rows are written or added to.
enum class Seed { write, add };

/// The way back (kernel_adjoint.inl). Adjoints are added to; rows of a stretch are
/// [steps x lanes].
struct AdjointTable {
    /// Readings [n_intervals x lanes] from what a meter shows.
    void (*collect)(const IntervalTime&, const double* shown, int begin, int end,
                    double* readings);
    /// Runs the stretch and keeps its tape; group.sums is not used. Writes what is shown:
    /// the air too, where its adjoints are not 0.
    void (*keep)(const ZoneTime&, const ZoneLanes& group, const Stretch&, Show,
                 const PowerRows&, double* tape);
    /// From sensitivities [n_intervals x lanes] to the powers' adjoints and to those of
    /// the meter's rows: of their sources only where powers.heating is nullptr.
    void (*seed_meter)(const IntervalTime&, const double* sensitivities,
                       const MeterLanes&, const PowerRows& powers, int begin, int end,
                       Seed, const PowerRows& adjoints, double* meter_rows);
    /// The same for the air temperature.
    void (*seed_air)(const IntervalTime&, const double* sensitivities, int begin, int end,
                     Seed, double* adjoints);
    /// A zone's part of the building's air. \param of_share  [lanes]
    void (*share_air)(const double* adjoints, const double* air,
                      const double* floor_share, int n_steps, double* zone_adjoints,
                      double* of_share);
    /// Back through a stretch that was kept: the powers' adjoints (air may be nullptr)
    /// and the adjoint of the state after it to all others.
    void (*pull)(const ZoneTime&, const ZoneLanes& group, const Stretch&,
                 const PowerRows& adjoints, double* tape, const ZoneAdjoint&);
};

struct Table {
    int lanes;
    /// Steps [begin, end) of a zone, whose first segment is `segment`.
    void (*run)(const ZoneTime&, const ZoneLanes&, int segment, int begin, int end, Show,
                const PowerRows&);
    /// The same in one pass with the errors of a meter read at every step.
    void (*run_compared)(const ZoneTime&, const ZoneLanes&, int segment, int begin,
                         int end, const MeterLanes&, const ReadingTime&, double* errors);
    /// The same in one pass with the rows of a meter [W].
    void (*run_metered)(const ZoneTime&, const ZoneLanes&, int segment, int begin,
                        int end, const MeterLanes&, double* shown);
    /// Steps of n > 0 groups of mixed rows in one pass with a meter and its differences:
    /// writes the sums over the groups, in their order; no sums of powers. The zone's
    /// row_offset is that of MixedLanes' rows.
    void (*run_differences)(const ZoneTime&, int segment, int begin, int end,
                            const MixedLanes* groups, int n, double* sums);
    /// Differences of rows that are shown.
    void (*add_differences)(const double* shown, int n_steps, const DifferenceLanes&);
    /// Takes the shift [n_steps] off a and, in place, b; adds a, b, a^2 + b^2 to the sums
    /// [steps x 3 x lanes].
    void (*add_base)(const double* shift, int n_steps, const double* a, double* b,
                     double* sums);
    /// total += zone, air times its share of the floor.
    void (*add_zone)(const PowerRows& zone, const double* floor_share, int n_steps,
                     const PowerRows& total);
    void (*meter)(const MeterLanes&, const PowerRows&, int begin, int end, double* shown);
    void (*add_up)(const double* shown, int n_steps, double* sum);
    void (*compare)(const ReadingTime&, const double* shown, int begin, int end,
                    double* errors);
    AdjointTable adjoint;
};

const Table& scalar_table();
const Table& v3_table();
const Table& v4_table();

}  // namespace bemcal::kernel
