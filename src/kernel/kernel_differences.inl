/// Sums over the base points of a Sobol design, step by step and lane by lane: of b (y -
/// a), y - a and (y - a)^2, of which the indices of every step are made.
/// Source: Saltelli et al. 2010, Comput. Phys. Commun. 181. The indices themselves are
/// left to the callers of Batch. Included by kernel_reduce.inl.

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

/// A group of mixed rows on its way: no sums of powers, and the meter's form beside the
/// zone's constants.
struct MixedGroup {
    const ZoneLanes& group;
    const double *a, *b, *regime;
    V theta_m;

    explicit MixedGroup(const MixedLanes& mixed)
        : group(mixed.zone),
          a(mixed.a),
          b(mixed.b),
          regime(group.regimes),
          theta_m(load(group.state)) {}

    void next() {
        a += lanes;
        b += lanes;
    }

    /// One step: what the meter reads, less the row of A.
    template <int planes, bool more_drivers>
    [[gnu::always_inline]] inline V difference(const ZoneTime& zone, int step,
                                               const double* drivers) {
        using C = StandardColumn;
        regime = as_operands(regime);
        const double* row = group.rows + zone.row_offset[step];
        const Terms terms = terms_of_step<planes, more_drivers>(
            zone, Coefficients<false>(regime), regime, row, drivers);
        const V asked = fnma(column(regime, C::gain), theta_m, terms.asked);
        const V heat = min(positive_part(asked), column(regime, C::most_heating));
        const V cool = max(negative_part(add(asked, column(regime, C::gap))),
                           column(regime, C::most_cooling));
        theta_m = add(add(fma(column(regime, C::keep), theta_m, terms.mass), heat), cool);
        const V heated = fma(column(row, MixedColumn::per_heating), heat,
                             column(row, MixedColumn::source));
        return sub(fnma(column(row, MixedColumn::per_cooling), cool, heated), load(a));
    }
};

/// Time and the sums on their way.
struct MixedPlace {
    const double* drivers;
    long stride;  ///< from one step's drivers to the next
    double* sums;
};

/// The sums of a step are added to zero, or to what was written before.
enum class Onto { zero, sums };

/// A segment of two groups, whose chains of arithmetic hide each other's latency and
/// which share the stores of the sums; or of one, n = 1.
template <int planes, bool more_drivers, int n, Onto onto>
[[gnu::always_inline]] inline void add_segment(const ZoneTime& zone, const Segment& piece,
                                               MixedPlace& at, MixedGroup& one,
                                               MixedGroup& other) {
    one.regime = one.group.regimes + piece.regime * zone.regime_size;
    other.regime = other.group.regimes + piece.regime * zone.regime_size;
    for (int step = piece.begin; step < piece.end; ++step) {
        const V d = one.difference<planes, more_drivers>(zone, step, at.drivers);
        V e = d;
        if constexpr (n == 2)
            e = other.difference<planes, more_drivers>(zone, step, at.drivers);
        V product = mul(load(one.b), d), difference = d, square = mul(d, d);
        if constexpr (onto == Onto::sums) {
            product = fma(load(one.b), d, load(at.sums));
            difference = add(d, load(at.sums + lanes));
            square = fma(d, d, load(at.sums + 2 * lanes));
        }
        if constexpr (n == 2) {
            product = fma(load(other.b), e, product);
            difference = add(e, difference);
            square = fma(e, e, square);
        }
        store(at.sums, product);
        store(at.sums + lanes, difference);
        store(at.sums + 2 * lanes, square);
        one.next();
        other.next();
        at.drivers += at.stride;
        at.sums += 3 * lanes;
    }
}

template <int planes, bool more_drivers, int n, Onto onto>
void add_groups(const ZoneTime& zone, const Segment& steps, const MixedLanes* groups,
                double* sums) {
    const long stride = planes > 0 ? 1 + planes : zone.n_drivers + zone.n_planes;
    MixedPlace at{zone.drivers + steps.begin * stride, stride, sums};
    MixedGroup one(groups[0]), other(groups[n - 1]);
    for_pieces(zone, steps.regime, steps.begin, steps.end, [&](const Segment& piece) {
        if (piece.in_sun != 0)
            add_segment<planes, more_drivers, n, onto>(zone, piece, at, one, other);
        else
            add_segment<0, more_drivers, n, onto>(zone, piece, at, one, other);
    });
    store(one.group.state, one.theta_m);
    if (n == 2) store(other.group.state, other.theta_m);
}

/// All groups, two by two.
template <int planes, bool more_drivers>
void add_all(const ZoneTime& zone, const Segment& steps, const MixedLanes* groups, int n,
             double* sums) {
    if (n == 1)
        return add_groups<planes, more_drivers, 1, Onto::zero>(zone, steps, groups, sums);
    add_groups<planes, more_drivers, 2, Onto::zero>(zone, steps, groups, sums);
    for (int k = 2; k + 1 < n; k += 2)
        add_groups<planes, more_drivers, 2, Onto::sums>(zone, steps, groups + k, sums);
    if (n % 2 == 1)
        add_groups<planes, more_drivers, 1, Onto::sums>(zone, steps, groups + n - 1,
                                                        sums);
}

void run_metered(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin,
                 int end, const MeterLanes& meter_lanes, double* shown) {
    run_standard(zone, group, segment, begin, end, Metered{meter_lanes, shown});
}

void run_differences(const ZoneTime& zone, int segment, int begin, int end,
                     const MixedLanes* groups, int n, double* sums) {
    constexpr void (*by_planes[])(const ZoneTime&, const Segment&, const MixedLanes*, int,
                                  double*) = {
        add_all<-1, false>, add_all<1, false>, add_all<2, false>, add_all<3, false>,
        add_all<4, false>,  add_all<5, false>, add_all<6, false>};
    const Segment steps{begin, end, segment, 0};
    if (zone.n_drivers > 1) return add_all<-1, true>(zone, steps, groups, n, sums);
    by_planes[zone.n_planes <= 6 ? zone.n_planes : 0](zone, steps, groups, n, sums);
}
