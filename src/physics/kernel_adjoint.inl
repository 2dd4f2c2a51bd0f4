/// The way back through the time loops: reverse-mode differentiation of kernel_body.inl
/// by hand, stretch by stretch. Included by kernel_reduce.inl, over the same vector type.
///
/// A stretch is run once more from its kept state, with a tape that fits the first-level
/// cache, then walked backwards: first the chain from step to step (the adjoint of the
/// mass and of the power asked), then the sums over steps that make the adjoints of the
/// coefficients. A clamp passes its adjoint to the side that was taken.

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

void collect(const IntervalTime& time, const double* shown, int begin, int end,
             double* readings) {
    int before = begin > 0 ? time.interval[begin - 1] : -1;
    for (int step = begin; step < end; ++step) {
        const int interval = time.interval[step];
        double* reading = readings + static_cast<long>(interval) * lanes;
        V sum = mul(column(shown, step - begin), broadcast(time.factor[interval]));
        if (interval == before) sum = add(load(reading), sum);
        store(reading, sum);
        before = interval;
    }
}

/// d objective / d what is shown at a step.
inline V sensitivity_at(const IntervalTime& time, const double* sensitivities, int step) {
    const int interval = time.interval[step];
    return mul(load(sensitivities + static_cast<long>(interval) * lanes),
               broadcast(time.factor[interval]));
}

template <bool powers_too>
void seed_meter_rows(const IntervalTime& time, const double* sensitivities,
                     const MeterLanes& meter_lanes, const PowerRows& powers, int begin,
                     int end, const PowerRows& adjoints, double* meter_rows) {
    for (int step = begin; step < end; ++step) {
        const V s = sensitivity_at(time, sensitivities, step);
        const double* row = meter_lanes.rows + meter_lanes.row_offset[step];
        double* of_row = meter_rows + meter_lanes.row_offset[step];
        double* heating = adjoints.heating + static_cast<long>(step - begin) * lanes;
        double* cooling = adjoints.cooling + static_cast<long>(step - begin) * lanes;
        store(heating, fma(column(row, 1), s, load(heating)));
        store(cooling, fma(column(row, 2), s, load(cooling)));
        add_to(of_row, 0, s);
        if constexpr (powers_too) {
            add_to(of_row, 1, mul(s, column(powers.heating, step - begin)));
            add_to(of_row, 2, mul(s, column(powers.cooling, step - begin)));
        }
    }
}

void seed_meter(const IntervalTime& time, const double* sensitivities,
                const MeterLanes& meter_lanes, const PowerRows& powers, int begin,
                int end, const PowerRows& adjoints, double* meter_rows) {
    const auto seed =
        powers.heating == nullptr ? seed_meter_rows<false> : seed_meter_rows<true>;
    seed(time, sensitivities, meter_lanes, powers, begin, end, adjoints, meter_rows);
}

void seed_air(const IntervalTime& time, const double* sensitivities, int begin, int end,
              double* adjoints) {
    for (int step = begin; step < end; ++step)
        add_to(adjoints, step - begin, sensitivity_at(time, sensitivities, step));
}

void share_air(const double* adjoints, const double* air, const double* floor_share,
               int n_steps, double* zone_adjoints, double* of_share) {
    const V share = load(floor_share);
    V sum = load(of_share);
    for (int step = 0; step < n_steps; ++step) {
        const V s = column(adjoints, step);
        store(zone_adjoints + static_cast<long>(step) * lanes, mul(share, s));
        sum = fma(s, column(air, step), sum);
    }
    store(of_share, sum);
}

/// Keeps the standard hour's tape, and writes what is to be shown.
struct StandardKept {
    static constexpr bool sums_powers = false;
    Show show;
    Written<true> written;
    double* tape;
    void keep(V theta_m) { store(tape + StandardTape::theta_m * lanes, theta_m); }
    void see(int step, const double* regime, V asked, V heat, V cool) {
        store(tape + StandardTape::asked * lanes, asked);
        tape += StandardTape::count * lanes;
        if (show != Show::sums) written.see(step, regime, asked, heat, cool);
    }
    void end() {}
};

/// Sums over the steps of a segment that do not need the drivers.
struct StandardSums {
    V watts, most_heating, gap, most_cooling, kelvin, set_point;
    void write(double* regime) const {
        using C = StandardColumn;
        add_to(regime, C::watts, watts);
        add_to(regime, C::most_heating, most_heating);
        add_to(regime, C::gap, gap);
        add_to(regime, C::most_cooling, most_cooling);
        add_to(regime, C::kelvin, kelvin);
        add_to(regime, C::set_point, set_point);
    }
};

/// The chain from step to step: leaves the adjoints of each step's power asked and of the
/// mass after it on the tape; returns that of the mass before the segment.
/// \param tape  of the step `first`
template <bool air>
V pull_chain(const Segment& segment, const double* regime, const PowerRows& adjoints,
             int first, double* tape, V theta_m, double* of_regime) {
    using C = StandardColumn;
    const V zero = broadcast(0);
    StandardSums sums{zero, zero, zero, zero, zero, zero};
    for (int step = segment.end - 1; step >= segment.begin; --step) {
        regime = as_operands(regime);
        double* row =
            tape + static_cast<long>(step - first) * StandardTape::count * lanes;
        const V asked = column(row, StandardTape::asked);
        const V over = add(asked, column(regime, C::gap));
        const V heat = min(max(asked, zero), column(regime, C::most_heating));
        const V cool = max(min(over, zero), column(regime, C::most_cooling));
        const V per_heating = column(adjoints.heating, step - first);
        const V per_cooling = column(adjoints.cooling, step - first);
        V of_heat = fma(per_heating, column(regime, C::watts), theta_m);
        V of_cool = fnma(per_cooling, column(regime, C::watts), theta_m);
        V of_asked = zero;
        sums.watts = fnma(per_cooling, cool, fma(per_heating, heat, sums.watts));
        if constexpr (air) {
            const V per_air = column(adjoints.air, step - first);
            const V excess = mul(per_air, column(regime, C::kelvin));
            sums.kelvin = fnma(per_air, sub(sub(asked, heat), cool), sums.kelvin);
            sums.set_point = add(sums.set_point, per_air);
            of_heat = add(of_heat, excess);
            of_cool = add(of_cool, excess);
            of_asked = sub(of_asked, excess);
        }
        const V heats = if_less(zero, asked, of_heat),
                cools = if_less(over, zero, of_cool);
        const V heats_freely = if_less(asked, column(regime, C::most_heating), heats);
        const V cools_freely = if_less(column(regime, C::most_cooling), over, cools);
        sums.most_heating = add(sums.most_heating, sub(heats, heats_freely));
        sums.most_cooling = add(sums.most_cooling, sub(cools, cools_freely));
        sums.gap = add(sums.gap, cools_freely);
        of_asked = add(add(of_asked, heats_freely), cools_freely);
        store(row + StandardTape::asked * lanes, of_asked);
        store(row + StandardTape::mass * lanes, theta_m);
        theta_m = fnma(column(regime, C::gain), of_asked,
                       mul(column(regime, C::keep), theta_m));
    }
    sums.write(of_regime);
    return theta_m;
}

/// Adds to the adjoints of the rows, and of what meets the mass temperature and the first
/// driver.
void pull_constants(const ZoneTime& zone, const Segment& segment, const double* tape,
                    const double* drivers, long stride, double* of_regime,
                    double* of_rows) {
    using C = StandardColumn;
    V keep_sum = broadcast(0), gain_sum = keep_sum, mass_sum = keep_sum,
      asked_sum = keep_sum;
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
    add_to(of_regime, C::keep, keep_sum);
    add_to(of_regime, C::gain, gain_sum);
    add_to(of_regime, C::drivers, mass_sum);
    add_to(of_regime, C::drivers + 1, asked_sum);
}

/// Sums of the two adjoints times `n` neighbouring drivers or planes.
template <int n>
struct Products {
    V mass[n], asked[n];
};

template <int n>
Products<n> products(const double* tape, const double* drivers, long stride,
                     int n_steps) {
    Products<n> sums;
    for (int k = 0; k < n; ++k) sums.mass[k] = sums.asked[k] = broadcast(0);
    for (int step = 0; step < n_steps; ++step) {
        for (int k = 0; k < n; ++k) {
            const V driver = broadcast(drivers[k]);
            sums.mass[k] = fma(column(tape, StandardTape::mass), driver, sums.mass[k]);
            sums.asked[k] = fma(column(tape, StandardTape::asked), driver, sums.asked[k]);
        }
        tape += StandardTape::count * lanes;
        drivers += stride;
    }
    return sums;
}

/// Calls use(k, sum with the mass, sum with the power asked) for n neighbouring drivers,
/// two at a time: as many as the registers hold.
template <class Use>
void for_products(const double* tape, const double* drivers, long stride, int n_steps,
                  int n, Use use) {
    int k = 0;
    for (; k + 1 < n; k += 2) {
        const Products<2> two = products<2>(tape, drivers + k, stride, n_steps);
        use(k, two.mass[0], two.asked[0]);
        use(k + 1, two.mass[1], two.asked[1]);
    }
    if (k == n) return;
    const Products<1> one = products<1>(tape, drivers + k, stride, n_steps);
    use(k, one.mass[0], one.asked[0]);
}

/// Adds to the adjoints of the further drivers and of the sun.
void pull_drivers(const ZoneTime& zone, const Segment& segment, const double* tape,
                  const double* drivers, long stride, const double* regime,
                  double* of_regime) {
    using C = StandardColumn;
    const int n_steps = segment.end - segment.begin;
    for_products(tape, drivers + 1, stride, n_steps, zone.n_drivers - 1,
                 [&](int k, V mass, V asked) {
                     add_to(of_regime, C::drivers + 2 * (k + 1), mass);
                     add_to(of_regime, C::drivers + 2 * (k + 1) + 1, asked);
                 });
    if (segment.in_sun == 0) return;
    const int planes = C::drivers + 2 * zone.n_drivers;
    for_products(tape, drivers + zone.n_drivers, stride, n_steps, zone.n_planes,
                 [&](int p, V mass, V asked) {
                     const V aperture = column(regime, planes + p);
                     add_to(of_regime, C::sun_mass, mul(aperture, mass));
                     add_to(of_regime, C::sun_asked, mul(aperture, asked));
                     add_to(of_regime, planes + p,
                            fma(column(regime, C::sun_mass), mass,
                                mul(column(regime, C::sun_asked), asked)));
                 });
}

void pull_standard(const ZoneTime& zone, const ZoneLanes& group, const Stretch& stretch,
                   const PowerRows& adjoints, double* tape, const ZoneAdjoint& to) {
    const long stride = zone.n_drivers + zone.n_planes;
    for_pieces_back(zone, stretch, [&](const Segment& piece) {
        const double* regime = group.regimes + piece.regime * zone.regime_size;
        double* of_regime = to.regimes + piece.regime * zone.regime_size;
        const auto chain = adjoints.air == nullptr ? pull_chain<false> : pull_chain<true>;
        store(to.state, chain(piece, regime, adjoints, stretch.begin, tape,
                              load(to.state), of_regime));
        const double* of_piece = tape + static_cast<long>(piece.begin - stretch.begin) *
                                            StandardTape::count * lanes;
        const double* drivers = zone.drivers + piece.begin * stride;
        pull_constants(zone, piece, of_piece, drivers, stride, of_regime, to.rows);
        pull_drivers(zone, piece, of_piece, drivers, stride, regime, of_regime);
    });
}

#include "physics/kernel_adjoint_general.inl"

void keep(const ZoneTime& zone, const ZoneLanes& group, const Stretch& stretch, Show show,
          const PowerRows& out, double* tape) {
    const auto [begin, end, segment, last] = stretch;
    if (zone.n_states > 0)
        run_general(zone, group, segment, begin, end,
                    GeneralKept{{show, out, begin}, zone.n_states, tape});
    else
        run_standard(zone, group, segment, begin, end,
                     StandardKept{show, {out, begin}, tape});
}

void pull(const ZoneTime& zone, const ZoneLanes& group, const Stretch& stretch,
          const PowerRows& adjoints, double* tape, const ZoneAdjoint& to) {
    switch (zone.n_states) {
        case 0:
            return pull_standard(zone, group, stretch, adjoints, tape, to);
        case 1:
            return pull_general<1>(zone, group, stretch, adjoints, tape, to);
        case 2:
            return pull_general<2>(zone, group, stretch, adjoints, tape, to);
        case 3:
            return pull_general<3>(zone, group, stretch, adjoints, tape, to);
        default:
            return pull_general<4>(zone, group, stretch, adjoints, tape, to);
    }
}
