/// The way back through a zone with refinements, step by step from a kept tape: forms,
/// clamped powers, sun, and openings that follow the room.
/// Follows from kernel_general, differentiated in reverse by hand; a clamp passes its
/// adjoint to the side taken. Included by kernel_adjoint.inl, which has the standard
/// hour.

/// Keeps the tape, and writes what is to be shown.
struct GeneralKept {
    GeneralWritten written;
    int n;
    double* tape;
    void see(int step, const V* state, V free, Powers power, V air) const {
        double* row = tape + static_cast<long>(step - written.first) *
                                 general_tape_columns(n) * lanes;
        for (int s = 0; s < n; ++s) store(row + s * lanes, state[s]);
        store(row + n * lanes, free);
        store(row + (n + 1) * lanes, power.heating);
        store(row + (n + 2) * lanes, power.cooling);
        written.see(step, state, free, power, air);
    }
};

/// Adjoints of the forms of a step: form 0 is the air, the others the states after it.
template <int n>
struct FormAdjoints {
    V value[n + 1];
    /// Column `index` of the forms meets `factor`: adds to the column's adjoint, returns
    /// the factor's.
    V pull(const double* forms, int index, V factor, double* of_forms) const {
        V sum = broadcast(0);
        for (int f = 0; f <= n; ++f) {
            add_to(of_forms, index * (n + 1) + f, mul(value[f], factor));
            sum = fma(column(forms, index * (n + 1) + f), value[f], sum);
        }
        return sum;
    }
    void add_to_column(double* of_forms, int index, V factor) const {
        for (int f = 0; f <= n; ++f)
            add_to(of_forms, index * (n + 1) + f, mul(value[f], factor));
    }
};

/// Adjoints of a power of rooms that differ.
struct OfRooms {
    V limit, asked, reach, together;
};

/// Back through the mean over rooms and its limit. Those of span and its inverse are in
/// reach and together.
inline OfRooms pull_rooms(const Rooms& rooms, V limit, V asked, V power, V of_power) {
    const V on = keep_where(less(broadcast(0), power), of_power);
    const V freely = keep_where(less(power, limit), on);
    const V hottest = rooms.hottest(asked), share = rooms.share(asked);
    const Mask is_some = both(less(broadcast(0), hottest), less(hottest, rooms.span));
    const V of_all = keep_where(less(rooms.span, hottest), freely);
    const V of_some = keep_where(is_some, freely);
    const V slope = rooms.slope(asked);
    return {sub(on, freely), fma(of_some, slope, of_all),
            mul(of_some, fnma(share, share, slope)),
            mul(of_some, fnma(share, rooms.some(asked), rooms.some(asked)))};
}

/// Back through the powers: returns the adjoint of the air temperature that would be
/// without them.
template <int n>
V pull_powers(const ZoneTime& zone, const double* regime, const double* coefficients,
              const double* row, const double* drivers, V of_heating, V of_cooling,
              double* of_regime, double* of_row) {
    using C = GeneralColumn;
    const V free = column(row, n);
    const Powers asked = asked_of_step<n>(zone, regime, coefficients, drivers, free);
    const OfRooms heated =
        pull_rooms(heated_rooms(regime), column(regime, C::most_heating), asked.heating,
                   column(row, n + 1), of_heating);
    const OfRooms cooled =
        pull_rooms(cooled_rooms(regime), column(regime, C::most_cooling), asked.cooling,
                   column(row, n + 2), of_cooling);
    add_to(of_regime, C::most_heating, heated.limit);
    add_to(of_regime, C::most_cooling, cooled.limit);
    add_to(of_regime, C::reach_heating, heated.reach);
    add_to(of_regime, C::reach_cooling, cooled.reach);
    add_to(of_regime, C::together, cooled.together);
    const V heat = heated.asked, cool = cooled.asked;
    add_to(of_row, n + 1, heat);
    add_to(of_row, n + 2, cool);
    if (zone.imposed != 0)
        add_to(of_regime, C::imposed,
               mul(broadcast(drivers[zone.n_drivers - 1]), sub(heat, cool)));
    add_to(of_regime, C::gain_heating, sub(broadcast(0), mul(heat, free)));
    add_to(of_regime, C::gain_cooling, mul(cool, free));
    return fnma(column(regime, C::gain_heating), heat,
                mul(column(regime, C::gain_cooling), cool));
}

/// The sun's part of a step: adjoints of its column and of the apertures.
template <int n>
void pull_sun(const ZoneTime& zone, const FormAdjoints<n>& of_form, const double* forms,
              const double* irradiance, double* of_forms) {
    const int planes = (3 + n + zone.n_drivers) * (n + 1);
    const V sun = sunshine<-1>(forms + planes * lanes, irradiance, zone.n_planes);
    const V of_sun = of_form.pull(forms, 2 + n, sun, of_forms);
    for (int p = 0; p < zone.n_planes; ++p)
        add_to(of_forms, planes + p, mul(of_sun, broadcast(irradiance[p])));
}

/// Back through openings: returns the adjoint of the air temperature that they follow.
template <int n>
V pull_venting(const double* columns, const FormAdjoints<n>& of_form, V conductance,
               const Opening& opening, double* of_columns, double* of_conductance) {
    using C = VentingColumn;
    const V zero = broadcast(0), power = opening.power(conductance);
    V of_power = zero;
    for (int f = 0; f <= n; ++f) {
        add_to(of_columns, C::forms + f, fnma(of_form.value[f], power, zero));
        of_power = fnma(column(columns, C::forms + f), of_form.value[f], of_power);
    }
    add_to(of_conductance, 0, mul(of_power, mul(opening.share, opening.difference)));
    const Mask partly =
        both(less(zero, opening.share), less(opening.share, broadcast(1)));
    const V of_share =
        keep_where(partly, mul(of_power, mul(conductance, opening.difference)));
    const V of_above = mul(of_share, column(columns, C::per_band));
    add_to(of_columns, C::opens_above, sub(zero, of_above));
    add_to(of_columns, C::per_band, mul(of_share, opening.above));
    return add(of_above, keep_where(less(zero, opening.difference),
                                    mul(of_power, mul(conductance, opening.share))));
}

/// The same of the step whose tape begins at `row`.
template <int n>
V pull_venting(const ZoneTime& zone, const FormAdjoints<n>& of_form, const double* forms,
               const double* coefficients, const double* row, double theta_e,
               double* of_forms, double* of_row) {
    const int at = venting_columns(zone) * lanes;
    const Opening opening =
        opening_at(forms + at, column(row, zone.vented_state), theta_e);
    return pull_venting<n>(forms + at, of_form, column(coefficients, 3 + n), opening,
                           of_forms + at, of_row + (3 + n) * lanes);
}

/// The way back through one segment.
/// \param state  adjoints of the states after it, then before it
template <int n, bool vented>
void pull_segment(const ZoneTime& zone, const ZoneLanes& group, const Segment& segment,
                  const PowerRows& adjoints, int first, const double* tape,
                  const ZoneAdjoint& to, V* state) {
    const double* regime = group.regimes + segment.regime * zone.regime_size;
    double* of_regime = to.regimes + segment.regime * zone.of_regime_size;
    const double* forms = regime + GeneralColumn::forms * lanes;
    double* of_forms = of_regime + GeneralColumn::forms * lanes;
    const int stride = zone.n_drivers + zone.n_planes;
    for (int step = segment.end - 1; step >= segment.begin; --step) {
        const long at = step - first;
        const double* row = tape + at * general_tape_columns(n) * lanes;
        const double* drivers = zone.drivers + static_cast<long>(step) * stride;
        double* of_row = to.rows + zone.row_offset[step];
        FormAdjoints<n> of_form;
        of_form.value[0] =
            adjoints.air == nullptr ? broadcast(0) : load(adjoints.air + at * lanes);
        for (int s = 0; s < n; ++s) of_form.value[s + 1] = state[s];
        const V of_heating = add(load(adjoints.heating + at * lanes),
                                 of_form.pull(forms, 0, column(row, n + 1), of_forms));
        const V of_cooling = add(load(adjoints.cooling + at * lanes),
                                 of_form.pull(forms, 1, column(row, n + 2), of_forms));
        of_form.value[0] =
            add(of_form.value[0],
                pull_powers<n>(zone, regime, group.rows + zone.row_offset[step], row,
                               drivers, of_heating, of_cooling, of_regime, of_row));
        for (int f = 0; f <= n; ++f) add_to(of_row, f, of_form.value[f]);
        for (int k = 0; k < zone.n_drivers; ++k)
            of_form.add_to_column(of_forms, 3 + n + k, broadcast(drivers[k]));
        if (segment.in_sun != 0)
            pull_sun<n>(zone, of_form, forms, drivers + zone.n_drivers, of_forms);
        for (int s = 0; s < n; ++s)
            state[s] = of_form.pull(forms, 2 + s, column(row, s), of_forms);
        if constexpr (vented)
            state[zone.vented_state] = add(
                state[zone.vented_state],
                pull_venting<n>(zone, of_form, forms, group.rows + zone.row_offset[step],
                                row, drivers[0], of_forms, of_row));
    }
}

template <int n, bool vented>
void pull_general(const ZoneTime& zone, const ZoneLanes& group, const Stretch& stretch,
                  const PowerRows& adjoints, double* tape, const ZoneAdjoint& to) {
    V state[n];
    for (int s = 0; s < n; ++s) state[s] = column(to.state, s);
    for_pieces_back(zone, stretch, [&](const Segment& piece) {
        pull_segment<n, vented>(zone, group, piece, adjoints, stretch.begin, tape, to,
                                state);
    });
    for (int s = 0; s < n; ++s) store(to.state + s * lanes, state[s]);
}
