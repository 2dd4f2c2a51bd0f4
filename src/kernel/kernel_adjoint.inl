/// The way back through kernel_body's loops: reverse-mode differentiation by hand. A
/// stretch is run again from its kept state with a tape that fits the first-level cache,
/// then walked backwards: first the chain of mass and power asked, then the sums over
/// steps. A clamp passes its adjoint to the side taken. Included by kernel_reduce.inl.
/// Refinements are in kernel_adjoint_general; parameters are reached in affine_adjoint.

inline void add_to(double* columns, int index, V value) {
    double* at = columns + index * lanes;
    store(at, add(load(at), value));
}

/// Calls action(segment) for the pieces of segments in the stretch, the last one first.
template <class Action>
[[gnu::always_inline]] inline void for_pieces_back(const ZoneTime& zone,
                                                   const Stretch& stretch,
                                                   Action action) {
    for (int index = stretch.last_segment; index >= stretch.first_segment; --index) {
        Segment piece = zone.segments[index];
        if (piece.begin < stretch.begin) piece.begin = stretch.begin;
        if (piece.end > stretch.end) piece.end = stretch.end;
        action(piece);
    }
}

#include "kernel/kernel_seed.inl"

/// Keeps the standard hour's tape, and writes what is to be shown.
template <Show show>
struct StandardKept {
    static constexpr bool sums_powers = false;
    Written<show == Show::powers_and_air> written;
    double* tape;
    void keep(V theta_m) { store(tape + StandardTape::theta_m * lanes, theta_m); }
    void see(int step, const double* regime, V asked, V heat, V cool) {
        store(tape + StandardTape::heating * lanes, heat);
        store(tape + StandardTape::cooling * lanes, cool);
        if constexpr (show == Show::powers_and_air)
            store(tape + StandardTape::excess * lanes, sub(sub(asked, heat), cool));
        tape += StandardTape::count * lanes;
        if constexpr (show != Show::sums) written.see(step, regime, asked, heat, cool);
    }
    void end() {}
};

/// What powers at their limits leave there: few steps have any.
inline void pull_limits(Mask heats_freely, V of_heats, Mask cools_freely, V of_cools,
                        double* of_regime) {
    using C = StandardColumn;
    add_to(of_regime, C::most_heating, sub(of_heats, keep_where(heats_freely, of_heats)));
    add_to(of_regime, C::most_cooling, sub(of_cools, keep_where(cools_freely, of_cools)));
}

/// The air temperature's part of the powers' adjoints; adds to those of its columns.
inline V pull_air(V per_air, V excess, const double* regime, double* of_regime) {
    using C = StandardColumn;
    add_to(of_regime, C::set_point, per_air);
    store(of_regime + C::kelvin * lanes,
          fnma(per_air, excess, column(of_regime, C::kelvin)));
    return mul(per_air, column(regime, C::kelvin));
}

/// The chain from step to step: leaves the adjoints of each step's power asked and of the
/// mass after it on the tape; returns that of the mass before the segment.
/// \param tape  of the step `first`
template <bool air>
V pull_chain(const Segment& segment, const double* regime, const PowerRows& adjoints,
             int first, double* tape, V theta_m, double* of_regime) {
    using C = StandardColumn;
    const auto [per_heating, per_cooling, per_air] = adjoints;
    const V zero = broadcast(0);
    V watts = column(of_regime, C::watts), gap = column(of_regime, C::gap);
    for (int step = segment.end - 1 - first; step >= segment.begin - first; --step) {
        regime = as_operands(regime);
        const long at = static_cast<long>(step) * lanes;
        double* row = tape + at * StandardTape::count;
        const V heat = column(row, StandardTape::heating),
                cool = column(row, StandardTape::cooling);
        watts = fma(load(per_heating + at), heat, watts);
        watts = fnma(load(per_cooling + at), cool, watts);
        const Mask heats_freely = less(heat, column(regime, C::most_heating)),
                   cools_freely = less(column(regime, C::most_cooling), cool);
        V of_heat = fma(load(per_heating + at), column(regime, C::watts), theta_m);
        V of_cool = fnma(load(per_cooling + at), column(regime, C::watts), theta_m);
        V of_air = zero;
        if constexpr (air) {
            of_air = pull_air(load(per_air + at), column(row, StandardTape::excess),
                              regime, of_regime);
            of_heat = add(of_heat, of_air);
            of_cool = add(of_cool, of_air);
        }
        of_heat = keep_where(less(zero, heat), of_heat);
        of_cool = keep_where(less(cool, zero), of_cool);
        if (!all(both(heats_freely, cools_freely)))
            pull_limits(heats_freely, of_heat, cools_freely, of_cool, of_regime);
        of_heat = keep_where(heats_freely, of_heat);
        of_cool = keep_where(cools_freely, of_cool);
        gap = add(gap, of_cool);
        V of_asked = add(of_heat, of_cool);
        if constexpr (air) of_asked = sub(of_asked, of_air);
        store(row + StandardTape::asked * lanes, of_asked);
        store(row + StandardTape::mass * lanes, theta_m);
        theta_m = fnma(column(regime, C::gain), of_asked,
                       mul(column(regime, C::keep), theta_m));
    }
    store(of_regime + C::watts * lanes, watts);
    store(of_regime + C::gap * lanes, gap);
    return theta_m;
}

/// Adds to the adjoints of the rows, and of what meets the mass temperature and the first
/// driver.
void pull_constants(const ZoneTime& zone, const Segment& segment, const double* tape,
                    const double* drivers, double* of_regime, double* of_rows) {
    using C = StandardColumn;
    const long stride = zone.n_drivers + zone.n_planes;
    V keep_sum = column(of_regime, C::keep), gain_sum = column(of_regime, C::gain),
      mass_sum = column(of_regime, C::drivers),
      asked_sum = column(of_regime, C::drivers + 1);
    for (int step = segment.begin; step < segment.end; ++step) {
        const V of_mass = column(tape, StandardTape::mass),
                of_asked = column(tape, StandardTape::asked),
                theta_m = column(tape, StandardTape::theta_m);
        double* of_row = of_rows + zone.row_offset[step];
        add_to(of_row, 0, of_mass);
        add_to(of_row, 1, of_asked);
        keep_sum = fma(of_mass, theta_m, keep_sum);
        gain_sum = fnma(of_asked, theta_m, gain_sum);
        mass_sum = fma(of_mass, broadcast(drivers[0]), mass_sum);
        asked_sum = fma(of_asked, broadcast(drivers[0]), asked_sum);
        tape += StandardTape::count * lanes;
        drivers += stride;
    }
    store(of_regime + C::keep * lanes, keep_sum);
    store(of_regime + C::gain * lanes, gain_sum);
    store(of_regime + C::drivers * lanes, mass_sum);
    store(of_regime + (C::drivers + 1) * lanes, asked_sum);
}

/// Adds the products of `n` neighbouring drivers or planes with both adjoints.
/// \param sums  [n x 2 x lanes]
template <int n>
void add_products(const double* tape, const double* drivers, long stride, int n_steps,
                  double* sums) {
    V mass[n], asked[n];
    for (int k = 0; k < n; ++k) mass[k] = column(sums, 2 * k);
    for (int k = 0; k < n; ++k) asked[k] = column(sums, 2 * k + 1);
    for (int step = 0; step < n_steps; ++step) {
        for (int k = 0; k < n; ++k) {
            const V driver = broadcast(drivers[k]);
            mass[k] = fma(column(tape, StandardTape::mass), driver, mass[k]);
            asked[k] = fma(column(tape, StandardTape::asked), driver, asked[k]);
        }
        tape += StandardTape::count * lanes;
        drivers += stride;
    }
    for (int k = 0; k < n; ++k) store(sums + 2 * k * lanes, mass[k]);
    for (int k = 0; k < n; ++k) store(sums + (2 * k + 1) * lanes, asked[k]);
}

/// The same for drivers or planes [from, to) of all, two at a time: as many as the
/// registers hold.
void pull_drivers(const ZoneTime& zone, const Segment& segment, const double* tape,
                  const double* drivers, int from, int to, double* of_regime) {
    const long stride = zone.n_drivers + zone.n_planes;
    const int n_steps = segment.end - segment.begin;
    double* sums = of_regime + StandardColumn::drivers * lanes;
    for (; from + 1 < to; from += 2)
        add_products<2>(tape, drivers + from, stride, n_steps, sums + 2 * from * lanes);
    if (from < to)
        add_products<1>(tape, drivers + from, stride, n_steps, sums + 2 * from * lanes);
}

/// All sums over the steps of a segment, once the chain has been through it.
void pull_sums(const ZoneTime& zone, const Segment& segment, const double* tape,
               const ZoneAdjoint& to) {
    const int first_plane = zone.n_drivers, end = first_plane + zone.n_planes;
    const double* drivers = zone.drivers + static_cast<long>(segment.begin) * end;
    double* of_regime = to.regimes + segment.regime * zone.of_regime_size;
    pull_constants(zone, segment, tape, drivers, of_regime, to.rows);
    pull_drivers(zone, segment, tape, drivers, 1, first_plane, of_regime);
    if (segment.in_sun != 0)
        pull_drivers(zone, segment, tape, drivers, first_plane, end, of_regime);
}

void pull_standard(const ZoneTime& zone, const ZoneLanes& group, const Stretch& stretch,
                   const PowerRows& adjoints, double* tape, const ZoneAdjoint& to) {
    const auto chain = adjoints.air == nullptr ? pull_chain<false> : pull_chain<true>;
    for_pieces_back(zone, stretch, [&](const Segment& piece) {
        store(to.state, chain(piece, group.regimes + piece.regime * zone.regime_size,
                              adjoints, stretch.begin, tape, load(to.state),
                              to.regimes + piece.regime * zone.of_regime_size));
        pull_sums(zone, piece,
                  tape + static_cast<long>(piece.begin - stretch.begin) *
                             StandardTape::count * lanes,
                  to);
    });
}

#include "kernel/kernel_adjoint_general.inl"

void keep(const ZoneTime& zone, const ZoneLanes& group, const Stretch& stretch, Show show,
          const PowerRows& out, double* tape) {
    const auto [begin, end, segment, last] = stretch;
    const auto run_kept = [&](const auto& watch) {
        run_standard(zone, group, segment, begin, end, watch);
    };
    if (zone.n_states > 0)
        run_general(zone, group, segment, begin, end,
                    GeneralKept{{show, out, begin}, zone.n_states, tape});
    else if (show == Show::sums)
        run_kept(StandardKept<Show::sums>{{out, begin}, tape});
    else if (show == Show::powers)
        run_kept(StandardKept<Show::powers>{{out, begin}, tape});
    else
        run_kept(StandardKept<Show::powers_and_air>{{out, begin}, tape});
}

void pull(const ZoneTime& zone, const ZoneLanes& group, const Stretch& stretch,
          const PowerRows& adjoints, double* tape, const ZoneAdjoint& to) {
    if (zone.n_states == 0)
        return pull_standard(zone, group, stretch, adjoints, tape, to);
    for_variant(zone, [&]<int n, bool vented>() {
        pull_general<n, vented>(zone, group, stretch, adjoints, tape, to);
    });
}
