/// Sums over the base points of a Sobol design, step by step and lane by lane: what the
/// indices of every step are made of (Saltelli et al. 2010, Comput. Phys. Commun. 181:
/// sums of b (y - a) and (y - a)^2). Included by kernel_reduce.inl.

/// Adds one step. \param sums  [3 x lanes]
[[gnu::always_inline]] inline void add_difference(V y, V a, V b, double* sums) {
    const V d = sub(y, a);
    store(sums, fma(b, d, load(sums)));
    store(sums + lanes, add(d, load(sums + lanes)));
    store(sums + 2 * lanes, fma(d, d, load(sums + 2 * lanes)));
}

void add_differences(const double* shown, int n_steps, const DifferenceLanes& to) {
    for (int step = 0; step < n_steps; ++step)
        add_difference(column(shown, step), column(to.a, step), column(to.b, step),
                       to.sums + 3L * step * lanes);
}

void add_base(const double* shift, int n_steps, const double* a, double* b,
              double* sums) {
    for (int step = 0; step < n_steps; ++step, sums += 3 * lanes) {
        const V s = broadcast(shift[step]), x = sub(column(a, step), s),
                y = sub(column(b, step), s);
        store(b + step * lanes, y);
        store(sums, add(x, load(sums)));
        store(sums + lanes, add(y, load(sums + lanes)));
        store(sums + 2 * lanes, fma(y, y, fma(x, x, load(sums + 2 * lanes))));
    }
}

/// Writes a meter's rows.
struct Metered {
    static constexpr bool sums_powers = false;
    MeterLanes meter_lanes;
    double* shown;
    void see(int step, const double* regime, V, V heat, V cool) {
        store(shown, metered(meter_lanes, step, regime, heat, cool));
        shown += lanes;
    }
    void end() {}
};

/// Adds a meter's differences.
struct Mixed {
    static constexpr bool sums_powers = false;
    MeterLanes meter_lanes;
    DifferenceLanes to;
    void see(int step, const double* regime, V, V heat, V cool) {
        add_difference(metered(meter_lanes, step, regime, heat, cool), load(to.a),
                       load(to.b), to.sums);
        to.a += lanes;
        to.b += lanes;
        to.sums += 3 * lanes;
    }
    void end() {}
};

void run_metered(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin,
                 int end, const MeterLanes& meter_lanes, double* shown) {
    run_standard(zone, group, segment, begin, end, Metered{meter_lanes, shown});
}

void run_differences(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin,
                     int end, const MeterLanes& meter_lanes, const DifferenceLanes& to) {
    run_standard(zone, group, segment, begin, end, Mixed{meter_lanes, to});
}
