/// The time loop of a zone with refinements: forms of the air and up to four states,
/// powers as clamped lines of the free air temperature, openings that follow the room.
/// Follows from step_map's forms and structure's thermostat. The standard hour has a
/// faster loop in kernel_body, which includes this file; radiators and coupled zones have
/// none.

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
        result.add_column(forms, 2 + n,
                          sunshine<-1>(forms + (3 + n + zone.n_drivers) * (n + 1) * lanes,
                                       drivers + zone.n_drivers, zone.n_planes));
    for (int s = 0; s < n; ++s) result.add_column(forms, 2 + s, state[s]);
    return result;
}

struct Powers {
    V heating, cooling;
};

/// Powers that thermostats ask for, below 0 where they are off.
template <int n>
Powers asked_of_step(const ZoneTime& zone, const double* regime, const double* row,
                     const double* drivers, V theta_free) {
    using C = GeneralColumn;
    V heat = column(row, n + 1), cool = column(row, n + 2);
    if (zone.imposed != 0) {
        const V driver = broadcast(drivers[zone.n_drivers - 1]);
        heat = fma(column(regime, C::imposed), driver, heat);
        cool = fnma(column(regime, C::imposed), driver, cool);
    }
    return {fnma(column(regime, C::gain_heating), theta_free, heat),
            fma(column(regime, C::gain_cooling), theta_free, cool)};
}

/// How rooms differ, physics/structure's: columns of a regime.
struct Rooms {
    V reach, span, per_span, together;
    V hottest(V asked) const { return add(asked, reach); }
    /// Of the span the part over which rooms ask for power [W].
    V some(V asked) const { return min(max(hottest(asked), broadcast(0)), span); }
    /// 0 = no room asks, 1 = all do.
    V share(V asked) const { return mul(some(asked), per_span); }
    /// Mean power per power of the hottest, while only some ask for more than they get.
    V slope(V asked) const {
        return fma(fnma(together, broadcast(1), broadcast(1)), share(asked), together);
    }
    V mean(V asked) const {
        const V half = broadcast(0.5);
        const V per_hottest = fma(fnma(together, half, half), share(asked), together);
        return fma(some(asked), per_hottest,
                   max(sub(hottest(asked), span), broadcast(0)));
    }
};

inline Rooms heated_rooms(const double* regime) {
    using C = GeneralColumn;
    return {column(regime, C::reach_heating), column(regime, C::span_heating),
            column(regime, C::per_span_heating), broadcast(0)};
}
inline Rooms cooled_rooms(const double* regime) {
    using C = GeneralColumn;
    return {column(regime, C::reach_cooling), column(regime, C::span_cooling),
            column(regime, C::per_span_cooling), column(regime, C::together)};
}

inline Powers powers_of_rooms(const double* regime, Powers asked) {
    using C = GeneralColumn;
    return {
        min(heated_rooms(regime).mean(asked.heating), column(regime, C::most_heating)),
        min(cooled_rooms(regime).mean(asked.cooling), column(regime, C::most_cooling))};
}

/// Writes what is to be shown of a general zone's step.
struct GeneralWritten {
    Show show;
    PowerRows out;
    int first;
    void see(int step, const V*, V, Powers power, V air) const {
        const long at = static_cast<long>(step - first) * lanes;
        if (show != Show::sums) store(out.heating + at, power.heating);
        if (show != Show::sums) store(out.cooling + at, power.cooling);
        if (show == Show::powers_and_air) store(out.air + at, air);
    }
};

/// Where the columns of openings are, from those of the forms.
inline int venting_columns(const ZoneTime& zone) {
    const int n = zone.n_states;
    return (3 + n + zone.n_drivers) * (n + 1) + zone.n_planes;
}

/// Openings at a step: how far they are open, the air over what they open above, and over
/// outdoors [K].
struct Opening {
    V share, above, difference;
    V power(V conductance) const { return mul(mul(conductance, share), difference); }
};

inline Opening opening_at(const double* columns, V theta_air, double theta_e) {
    const V zero = broadcast(0);
    const V above = sub(theta_air, column(columns, VentingColumn::opens_above));
    const V reach = mul(above, column(columns, VentingColumn::per_band));
    return {min(max(reach, zero), broadcast(1)), above,
            max(sub(theta_air, broadcast(theta_e)), zero)};
}

/// Takes the heat that leaves through openings from the forms.
template <int n>
void vent(const ZoneTime& zone, const double* forms, const double* row, double theta_e,
          const V* state, Forms<n>& form) {
    const double* columns = forms + venting_columns(zone) * lanes;
    const Opening opening = opening_at(columns, state[zone.vented_state], theta_e);
    const V power = opening.power(column(row, 3 + n));
    for (int f = 0; f <= n; ++f)
        form.value[f] =
            fnma(column(columns, VentingColumn::forms + f), power, form.value[f]);
}

/// `watch` sees the state before each step, the air with no power, the powers, the air.
template <int n, bool vented, class Watch>
void general_segment(const ZoneTime& zone, const ZoneLanes& group, const Segment& segment,
                     const Watch& watch) {
    const int stride = zone.n_drivers + zone.n_planes;
    const double* regime = group.regimes + segment.regime * zone.regime_size;
    const double* forms = regime + GeneralColumn::forms * lanes;
    const double* drivers = zone.drivers + static_cast<long>(segment.begin) * stride;
    V state[n], heat = load(group.sums), cool = load(group.sums + lanes);
    for (int s = 0; s < n; ++s) state[s] = column(group.state, s);
    for (int step = segment.begin; step < segment.end; ++step, drivers += stride) {
        const double* row = group.rows + zone.row_offset[step];
        Forms<n> form =
            forms_of_step<n>(zone, forms, row, drivers, state, segment.in_sun != 0);
        if constexpr (vented) vent<n>(zone, forms, row, drivers[0], state, form);
        const V free = form.value[0];
        const Powers power =
            powers_of_rooms(regime, asked_of_step<n>(zone, regime, row, drivers, free));
        form.add_column(forms, 0, power.heating);
        form.add_column(forms, 1, power.cooling);
        watch.see(step, state, free, power, form.value[0]);
        for (int s = 0; s < n; ++s) state[s] = form.value[s + 1];
        heat = add(heat, power.heating);
        cool = add(cool, power.cooling);
    }
    for (int s = 0; s < n; ++s) store(group.state + s * lanes, state[s]);
    store(group.sums, heat);
    store(group.sums + lanes, cool);
}

/// Calls use.operator()<states, vented>() for the zone's own.
template <class Use>
void for_variant(const ZoneTime& zone, Use use) {
    const bool vented = zone.vented_state >= 0;
    switch (zone.n_states) {
        case 1:
            return use.template operator()<1, false>();
        case 2:
            return vented ? use.template operator()<2, true>()
                          : use.template operator()<2, false>();
        case 3:
            return vented ? use.template operator()<3, true>()
                          : use.template operator()<3, false>();
        default:
            return vented ? use.template operator()<4, true>()
                          : use.template operator()<4, false>();
    }
}

template <class Watch>
void run_general(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin,
                 int end, const Watch& watch) {
    for_pieces(zone, segment, begin, end, [&](const Segment& piece) {
        for_variant(zone, [&]<int n, bool vented>() {
            general_segment<n, vented>(zone, group, piece, watch);
        });
    });
}
