/// The time loops, written once over a vector type V of `lanes` doubles (load, store, broadcast,
/// add, sub, mul, fma, fnma, min, max): the instruction sets differ in V only, so they give the
/// same bits. Included inside an anonymous namespace.
///
/// A thermostat asks for the power that is missing to its set-point, linear in the mass
/// temperature (C.13 solved once), and gets what the plant can give: two clamps. Hooks are a
/// compile-time list of further terms of a step; the plain model has none and pays for none.

inline V column(const double* columns, int index) { return load(columns + index * lanes); }

/// phi_sol [W]: the sum of aperture times irradiance. planes < 0: known at run time only.
template <int planes>
V sunshine(const double* apertures, const double* irradiance, int n_planes) {
    const int n = planes < 0 ? n_planes : planes;
    V sum = mul(load(apertures), broadcast(irradiance[0]));
    for (int p = 1; p < n; ++p)
        sum = fma(column(apertures, p), broadcast(irradiance[p]), sum);
    return sum;
}

/// What a step adds to the mass temperature, and the power asked before the mass is seen.
struct Terms {
    V mass, asked;
};

template <int planes, bool more_drivers>
Terms terms_of_step(const ZoneTime& zone, const double* regime, const double* row,
                    const double* drivers) {
    using C = StandardColumn;
    const V theta_e = broadcast(drivers[0]);
    Terms terms{fma(column(regime, C::drivers), theta_e, column(row, 0)),
                fma(column(regime, C::drivers + 1), theta_e, column(row, 1))};
    if constexpr (more_drivers)
        for (int k = 1; k < zone.n_drivers; ++k) {
            const V driver = broadcast(drivers[k]);
            terms.mass = fma(column(regime, C::drivers + 2 * k), driver, terms.mass);
            terms.asked = fma(column(regime, C::drivers + 2 * k + 1), driver, terms.asked);
        }
    if constexpr (planes != 0) {
        const int n_drivers = more_drivers ? zone.n_drivers : 1;
        const V sun = sunshine<planes>(regime + (C::drivers + 2 * n_drivers) * lanes,
                                       drivers + n_drivers, zone.n_planes);
        terms.mass = fma(column(regime, C::sun_mass), sun, terms.mass);
        terms.asked = fma(column(regime, C::sun_asked), sun, terms.asked);
    }
    return terms;
}

/// One segment of the standard hour. `Observer` sees the powers of every step.
template <int planes, bool more_drivers, class Observer, class... Hooks>
void standard_segment(const ZoneTime& zone, const ZoneLanes& group, const Segment& segment,
                      const Observer& observer) {
    using C = StandardColumn;
    const int stride = zone.n_drivers + zone.n_planes;
    const double* regime = group.regimes + segment.regime * zone.regime_size;
    const double* drivers = zone.drivers + static_cast<long>(segment.begin) * stride;
    const V zero = broadcast(0);
    V theta_m = load(group.state), heat = zero, cool = zero;
    auto watch = observer.begin(regime);
    for (int step = segment.begin; step < segment.end; ++step, drivers += stride) {
        const double* row = group.rows + zone.row_offset[step];
        Terms terms = terms_of_step<planes, more_drivers>(zone, regime, row, drivers);
        (Hooks::act(group, step, terms), ...);
        const V asked = fnma(column(regime, C::gain), theta_m, terms.asked);
        const V heating = min(max(asked, zero), column(regime, C::most_heating));
        const V cooling = max(min(add(asked, column(regime, C::gap)), zero),
                              column(regime, C::most_cooling));
        theta_m = add(add(fma(column(regime, C::keep), theta_m, terms.mass), heating), cooling);
        heat = add(heat, heating);
        cool = add(cool, cooling);
        watch.see(step, asked, heating, cooling);
    }
    watch.end();
    const V watts = column(regime, C::watts);
    store(group.state, theta_m);
    store(group.sums, fma(heat, watts, load(group.sums)));
    store(group.sums + lanes, fnma(cool, watts, load(group.sums + lanes)));
}

/// Sees nothing.
struct Unwatched {
    struct Watch {
        void see(int, V, V, V) {}
        void end() {}
    };
    Watch begin(const double*) const { return {}; }
};

/// Writes rows in W, and the air temperature.
template <bool air>
struct Written {
    PowerRows rows;
    int first;
    struct Watch {
        const PowerRows& rows;
        int first;
        const double* regime;
        void see(int step, V asked, V heating, V cooling) {
            using C = StandardColumn;
            const long at = static_cast<long>(step - first) * lanes;
            store(rows.heating + at, mul(heating, column(regime, C::watts)));
            store(rows.cooling + at, fnma(cooling, column(regime, C::watts), broadcast(0)));
            if constexpr (air)
                store(rows.air + at,
                      fnma(column(regime, C::kelvin), sub(sub(asked, heating), cooling),
                           column(regime, C::set_point)));
        }
        void end() {}
    };
    Watch begin(const double* regime) const { return {rows, first, regime}; }
};

/// The sun's planes are counted at compile time up to 6.
template <class Observer>
void standard_in_sun(const ZoneTime& zone, const ZoneLanes& group, const Segment& segment,
                     const Observer& observer) {
    if (zone.n_drivers > 1) return standard_segment<-1, true>(zone, group, segment, observer);
    switch (zone.n_planes) {
        case 1: return standard_segment<1, false>(zone, group, segment, observer);
        case 2: return standard_segment<2, false>(zone, group, segment, observer);
        case 3: return standard_segment<3, false>(zone, group, segment, observer);
        case 4: return standard_segment<4, false>(zone, group, segment, observer);
        case 5: return standard_segment<5, false>(zone, group, segment, observer);
        case 6: return standard_segment<6, false>(zone, group, segment, observer);
        default: return standard_segment<-1, false>(zone, group, segment, observer);
    }
}

template <class Observer>
void run_standard(const ZoneTime& zone, const ZoneLanes& group, const Segment& segment,
                  const Observer& observer) {
    if (segment.in_sun != 0) return standard_in_sun(zone, group, segment, observer);
    if (zone.n_drivers > 1) return standard_segment<0, true>(zone, group, segment, observer);
    standard_segment<0, false>(zone, group, segment, observer);
}

/// A zone with refinements: form 0 is the free air temperature, the others the states.
template <int n>
struct Forms {
    V value[n + 1];
    /// += column `index` of the forms times `factor`
    void add_column(const double* forms, int index, V factor) {
        for (int f = 0; f <= n; ++f)
            value[f] = fma(column(forms, index * (n + 1) + f), factor, value[f]);
    }
};

/// Columns of forms: heating, cooling, n states, sun, drivers.
template <int n>
Forms<n> forms_of_step(const ZoneTime& zone, const double* forms, const double* row,
                       const double* drivers, const V* state, bool in_sun) {
    Forms<n> result;
    for (int f = 0; f <= n; ++f) result.value[f] = column(row, f);
    for (int k = 0; k < zone.n_drivers; ++k)
        result.add_column(forms, 3 + n + k, broadcast(drivers[k]));
    if (in_sun)
        result.add_column(
            forms, 2 + n,
            sunshine<-1>(forms + (3 + n + zone.n_drivers) * (n + 1) * lanes,
                         drivers + zone.n_drivers, zone.n_planes));
    for (int s = 0; s < n; ++s) result.add_column(forms, 2 + s, state[s]);
    return result;
}

struct Powers {
    V heating, cooling;
};

template <int n>
Powers powers_of_step(const ZoneTime& zone, const double* regime, const double* row,
                      const double* drivers, V theta_free) {
    using C = GeneralColumn;
    V heat = column(row, n + 1), cool = column(row, n + 2);
    if (zone.imposed != 0) {
        const V driver = broadcast(drivers[zone.n_drivers - 1]);
        heat = fma(column(regime, C::imposed), driver, heat);
        cool = fnma(column(regime, C::imposed), driver, cool);
    }
    heat = fnma(column(regime, C::gain_heating), theta_free, heat);
    cool = fma(column(regime, C::gain_cooling), theta_free, cool);
    const V zero = broadcast(0);
    return {min(max(heat, zero), column(regime, C::most_heating)),
            min(max(cool, zero), column(regime, C::most_cooling))};
}

template <int n>
void general_segment(const ZoneTime& zone, const ZoneLanes& group, const Segment& segment,
                     Show show, const PowerRows& out, int first) {
    const int stride = zone.n_drivers + zone.n_planes;
    const double* regime = group.regimes + segment.regime * zone.regime_size;
    const double* forms = regime + GeneralColumn::forms * lanes;
    const double* drivers = zone.drivers + static_cast<long>(segment.begin) * stride;
    V state[n], heat = broadcast(0), cool = broadcast(0);
    for (int s = 0; s < n; ++s) state[s] = column(group.state, s);
    for (int step = segment.begin; step < segment.end; ++step, drivers += stride) {
        const double* row = group.rows + zone.row_offset[step];
        Forms<n> form =
            forms_of_step<n>(zone, forms, row, drivers, state, segment.in_sun != 0);
        const Powers power = powers_of_step<n>(zone, regime, row, drivers, form.value[0]);
        form.add_column(forms, 0, power.heating);
        form.add_column(forms, 1, power.cooling);
        for (int s = 0; s < n; ++s) state[s] = form.value[s + 1];
        heat = add(heat, power.heating);
        cool = add(cool, power.cooling);
        const long at = static_cast<long>(step - first) * lanes;
        if (show != Show::sums) store(out.heating + at, power.heating);
        if (show != Show::sums) store(out.cooling + at, power.cooling);
        if (show == Show::powers_and_air) store(out.air + at, form.value[0]);
    }
    for (int s = 0; s < n; ++s) store(group.state + s * lanes, state[s]);
    store(group.sums, add(heat, load(group.sums)));
    store(group.sums + lanes, add(cool, load(group.sums + lanes)));
}

inline void run_general(const ZoneTime& zone, const ZoneLanes& group, const Segment& segment,
                        Show show, const PowerRows& out, int first) {
    switch (zone.n_states) {
        case 1: return general_segment<1>(zone, group, segment, show, out, first);
        case 2: return general_segment<2>(zone, group, segment, show, out, first);
        case 3: return general_segment<3>(zone, group, segment, show, out, first);
        default: return general_segment<4>(zone, group, segment, show, out, first);
    }
}

/// Calls action(segment) for the pieces of segments in [begin, end).
template <class Action>
void for_pieces(const ZoneTime& zone, int segment, int begin, int end, Action action) {
    for (; begin < end; ++segment) {
        Segment piece = zone.segments[segment];
        if (piece.begin < begin) piece.begin = begin;
        if (piece.end > end) piece.end = end;
        action(piece);
        begin = piece.end;
    }
}

void run(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin, int end, Show show,
         const PowerRows& out) {
    for_pieces(zone, segment, begin, end, [&](const Segment& piece) {
        if (zone.n_states > 0)
            run_general(zone, group, piece, show, out, begin);
        else if (show == Show::sums)
            run_standard(zone, group, piece, Unwatched{});
        else if (show == Show::powers)
            run_standard(zone, group, piece, Written<false>{out, begin});
        else
            run_standard(zone, group, piece, Written<true>{out, begin});
    });
}
