/// The time loops, written once over a vector V of `lanes` doubles, so that all
/// instruction sets give the same bits (not xsimd or Highway: what V needs is 30 lines of
/// intrinsics, and which min, max and fma they are is to be seen). A thermostat asks for
/// the power missing to its set-point, linear in the mass temperature, and gets what the
/// plant can: two clamps. Source: ISO 13790, (C.13) solved once (affine). Refinements are
/// left to kernel_general, meters to kernel_reduce. Included in an unnamed namespace.

inline V column(const double* columns, int index) {
    return load(columns + index * lanes);
}

/// Coefficients stay operands of the arithmetic, read from the first-level cache: there
/// are more of them than registers, and to hoist them out of a short loop means to copy
/// them to the stack.
inline const double* as_operands(const double* columns) {
    asm("" : "+r"(columns));
    return columns;
}

/// The columns of a regime that every step of a segment needs: operands, or held in
/// registers where there are 32 of them, as loads are what such a loop waits for.
template <bool held>
class Coefficients {
  public:
    explicit Coefficients(const double* regime) : regime_(regime) { load(); }
    /// Those of another regime, or the same.
    void change_to(const double* regime) {
        if (regime == regime_) return;
        regime_ = regime;
        load();
    }
    /// To be called at the begin of a step.
    const double* regime() { return regime_ = as_operands(regime_); }
    template <int k>
    V get() const {
        if constexpr (held && k < n_held)
            return held_[k];
        else
            return column(regime_, k);
    }

  private:
    void load() {
        if constexpr (held)
#pragma GCC unroll 16
            for (int k = 0; k < n_held; ++k) held_[k] = column(regime_, k);
    }
    static constexpr int n_held = StandardColumn::drivers + 2;
    const double* regime_;
    V held_[held ? n_held : 1];  // what is not got from here is not loaded
};

/// phi_sol [W]: the sum of aperture times irradiance. planes < 0: known at run time only.
template <int planes>
[[gnu::always_inline]] inline V sunshine(const double* apertures,
                                         const double* irradiance, int n_planes) {
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

/// Irradiance is not looked at where planes = 0.
template <int planes, bool more_drivers, bool held>
[[gnu::always_inline]] inline Terms terms_of_step(const ZoneTime& zone,
                                                  const Coefficients<held>& of,
                                                  const double* regime, const double* row,
                                                  const double* drivers) {
    using C = StandardColumn;
    const V theta_e = broadcast(drivers[0]);
    Terms terms{fma(of.template get<C::drivers>(), theta_e, column(row, 0)),
                fma(of.template get<C::drivers + 1>(), theta_e, column(row, 1))};
    if constexpr (more_drivers)
        for (int k = 1; k < zone.n_drivers; ++k) {
            const V driver = broadcast(drivers[k]);
            terms.mass = fma(column(regime, C::drivers + 2 * k), driver, terms.mass);
            terms.asked =
                fma(column(regime, C::drivers + 2 * k + 1), driver, terms.asked);
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

/// A zone of the standard hour on its way: where time is, the mass, and the powers' sums.
struct Standard {
    const ZoneTime& zone;
    const ZoneLanes& group;
    const double* drivers;
    V theta_m, heating, cooling;
    Coefficients<many_registers> of;

    Standard(const ZoneTime& time, const ZoneLanes& points, int begin)
        : zone(time),
          group(points),
          drivers(time.drivers +
                  static_cast<long>(begin) * (time.n_drivers + time.n_planes)),
          theta_m(load(points.state)),
          heating(load(points.sums)),
          cooling(load(points.sums + lanes)),
          of(points.regimes) {}

    void write() const {
        store(group.state, theta_m);
        store(group.sums, heating);
        store(group.sums + lanes, cooling);
    }

    /// One segment. `watch` sees the powers of every step.
    /// \param stride  from one step's drivers to the next
    template <int planes, bool more_drivers, class Watch>
    [[gnu::always_inline]] inline void advance(const Segment& segment, long stride,
                                               Watch& watch) {
        using C = StandardColumn;
        of.change_to(group.regimes + segment.regime * zone.regime_size);
        for (int step = segment.begin; step < segment.end; ++step) {
            const double* regime = of.regime();
            const double* row = group.rows + zone.row_offset[step];
            Terms terms =
                terms_of_step<planes, more_drivers>(zone, of, regime, row, drivers);
            if constexpr (requires { watch.keep(theta_m); }) watch.keep(theta_m);
            const V asked = fnma(of.get<C::gain>(), theta_m, terms.asked);
            const V heat = min(positive_part(asked), of.get<C::most_heating>());
            const V cool = max(negative_part(add(asked, of.get<C::gap>())),
                               of.get<C::most_cooling>());
            theta_m = add(add(fma(of.get<C::keep>(), theta_m, terms.mass), heat), cool);
            if constexpr (Watch::sums_powers) {
                heating = fma(of.get<C::watts>(), heat, heating);
                cooling = fnma(of.get<C::watts>(), cool, cooling);
            }
            watch.see(step, regime, asked, heat, cool);
            drivers += stride;
        }
    }
};

/// Sees nothing.
struct Unwatched {
    static constexpr bool sums_powers = true;
    void see(int, const double*, V, V, V) {}
    void end() {}
};

/// Writes rows in W, and the air temperature.
template <bool air>
struct Written {
    static constexpr bool sums_powers = true;
    PowerRows rows;
    int first;
    void see(int step, const double* regime, V asked, V heat, V cool) {
        using C = StandardColumn;
        const long at = static_cast<long>(step - first) * lanes;
        store(rows.heating + at, mul(heat, column(regime, C::watts)));
        store(rows.cooling + at, fnma(cool, column(regime, C::watts), broadcast(0)));
        if constexpr (air)
            store(rows.air + at,
                  fnma(column(regime, C::kelvin), sub(sub(asked, heat), cool),
                       column(regime, C::set_point)));
    }
    void end() {}
};

/// Calls action(segment) for the pieces of segments in [begin, end).
template <class Action>
[[gnu::always_inline]] inline void for_pieces(const ZoneTime& zone, int segment,
                                              int begin, int end, Action action) {
    for (; begin < end; ++segment) {
        Segment piece = zone.segments[segment];
        if (piece.begin < begin) piece.begin = begin;
        if (piece.end > end) piece.end = end;
        action(piece);
        begin = piece.end;
    }
}

/// Steps [begin, end); in the dark the sun's terms are left out.
template <int planes, bool more_drivers, class Watch>
void run_pieces(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin,
                int end, Watch watch) {
    const long stride = planes > 0 ? 1 + planes : zone.n_drivers + zone.n_planes;
    Standard standard(zone, group, begin);
    for_pieces(zone, segment, begin, end, [&](const Segment& piece) {
        if (piece.in_sun != 0)
            standard.advance<planes, more_drivers>(piece, stride, watch);
        else
            standard.advance<0, more_drivers>(piece, stride, watch);
    });
    standard.write();
    watch.end();
}

/// The sun's planes are counted at compile time up to 6.
template <class Watch>
void run_standard(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin,
                  int end, const Watch& watch) {
    if (zone.n_drivers > 1)
        return run_pieces<-1, true>(zone, group, segment, begin, end, watch);
    switch (zone.n_planes) {
        case 1:
            return run_pieces<1, false>(zone, group, segment, begin, end, watch);
        case 2:
            return run_pieces<2, false>(zone, group, segment, begin, end, watch);
        case 3:
            return run_pieces<3, false>(zone, group, segment, begin, end, watch);
        case 4:
            return run_pieces<4, false>(zone, group, segment, begin, end, watch);
        case 5:
            return run_pieces<5, false>(zone, group, segment, begin, end, watch);
        case 6:
            return run_pieces<6, false>(zone, group, segment, begin, end, watch);
        default:
            return run_pieces<-1, false>(zone, group, segment, begin, end, watch);
    }
}

#include "kernel/kernel_general.inl"

void run(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin, int end,
         Show show, const PowerRows& out) {
    if (zone.n_states > 0)
        run_general(zone, group, segment, begin, end, GeneralWritten{show, out, begin});
    else if (show == Show::sums)
        run_standard(zone, group, segment, begin, end, Unwatched{});
    else if (show == Show::powers)
        run_standard(zone, group, segment, begin, end, Written<false>{out, begin});
    else
        run_standard(zone, group, segment, begin, end, Written<true>{out, begin});
}
