/// Between what is shown and what is read: steps summed over their intervals, and
/// readings' sensitivities spread to the adjoints of powers, meter rows and air.
/// Follows from meter_form and the sums over intervals, in reverse. Included by
/// kernel_adjoint.inl, which takes the adjoints back through time.

void collect(const IntervalTime& time, const double* shown, int begin, int end,
             double* readings) {
    const int* interval_of = time.interval;
    const double* factor = time.factor;
    int before = begin > 0 ? interval_of[begin - 1] : -1;
    for (int step = begin; step < end; ++step, shown += lanes) {
        const int interval = interval_of[step];
        double* reading = readings + static_cast<long>(interval) * lanes;
        V sum = mul(load(shown), broadcast(factor[interval]));
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

/// Adjoints of a meter's row: they stay in registers while the row holds.
struct MeterSums {
    V source, heating, cooling;
    explicit MeterSums(const double* row)
        : source(load(row)), heating(column(row, 1)), cooling(column(row, 2)) {}
    void write(double* row) const {
        store(row, source);
        store(row + lanes, heating);
        store(row + 2 * lanes, cooling);
    }
};

template <bool adds, bool powers_too>
void seed_meter_rows(const IntervalTime& time, const double* sensitivities,
                     const MeterLanes& meter_lanes, const PowerRows& powers, int begin,
                     int end, const PowerRows& adjoints, double* meter_rows) {
    const auto [rows, row_offset] = meter_lanes;
    const auto [of_heating, of_cooling, of_air] = adjoints;
    const auto [heating, cooling, air] = powers;
    const IntervalTime intervals = time;
    int offset = row_offset[begin];
    MeterSums sums(meter_rows + offset);
    for (int step = begin, at = 0; step < end; ++step, at += lanes) {
        if (row_offset[step] != offset) {
            sums.write(meter_rows + offset);
            offset = row_offset[step];
            sums = MeterSums(meter_rows + offset);
        }
        const V s = sensitivity_at(intervals, sensitivities, step);
        const V heats = mul(column(rows + offset, 1), s);
        const V cools = mul(column(rows + offset, 2), s);
        store(of_heating + at, adds ? add(load(of_heating + at), heats) : heats);
        store(of_cooling + at, adds ? add(load(of_cooling + at), cools) : cools);
        sums.source = add(sums.source, s);
        if constexpr (powers_too) {
            sums.heating = fma(s, load(heating + at), sums.heating);
            sums.cooling = fma(s, load(cooling + at), sums.cooling);
        }
    }
    sums.write(meter_rows + offset);
}

void seed_meter(const IntervalTime& time, const double* sensitivities,
                const MeterLanes& meter_lanes, const PowerRows& powers, int begin,
                int end, Seed how, const PowerRows& adjoints, double* meter_rows) {
    const bool adds = how == Seed::add, powers_too = powers.heating != nullptr;
    const auto seed =
        adds ? powers_too ? seed_meter_rows<true, true> : seed_meter_rows<true, false>
        : powers_too ? seed_meter_rows<false, true>
                     : seed_meter_rows<false, false>;
    seed(time, sensitivities, meter_lanes, powers, begin, end, adjoints, meter_rows);
}

void seed_air(const IntervalTime& time, const double* sensitivities, int begin, int end,
              Seed how, double* adjoints) {
    for (int step = begin; step < end; ++step) {
        double* of_air = adjoints + static_cast<long>(step - begin) * lanes;
        const V s = sensitivity_at(time, sensitivities, step);
        store(of_air, how == Seed::add ? add(load(of_air), s) : s);
    }
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
