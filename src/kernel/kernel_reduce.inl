/// What is made of the powers: meters, sums, and errors against readings, from rows that
/// were written or while the powers are in registers. Fills the table of functions.
/// Follows from meter_form (meters) and ErrorSums (batch). It brings kernel_body along,
/// over the same vector type. By month, and from sums to answers, is left to reduction.
#include "kernel/kernel_body.inl"

void add_zone(const PowerRows& zone, const double* floor_share, int n_steps,
              const PowerRows& total) {
    const V share = load(floor_share);
    for (long at = 0; at < static_cast<long>(n_steps) * lanes; at += lanes) {
        store(total.heating + at, add(load(total.heating + at), load(zone.heating + at)));
        store(total.cooling + at, add(load(total.cooling + at), load(zone.cooling + at)));
        store(total.air + at, fma(share, load(zone.air + at), load(total.air + at)));
    }
}

void meter(const MeterLanes& meter_lanes, const PowerRows& powers, int begin, int end,
           double* shown) {
    for (int step = begin; step < end; ++step) {
        const double* row = meter_lanes.rows + meter_lanes.row_offset[step];
        const long at = static_cast<long>(step - begin) * lanes;
        const V heated = fma(column(row, 1), load(powers.heating + at), load(row));
        store(shown + at, fma(column(row, 2), load(powers.cooling + at), heated));
    }
}

void add_up(const double* shown, int n_steps, double* sum) {
    V total = load(sum);
    for (int step = 0; step < n_steps; ++step) total = add(total, column(shown, step));
    store(sum, total);
}

/// Sums over intervals of error, its square, its product with the reading, and its share.
struct Errors {
    V open, error, square, product, relative;

    explicit Errors(const double* sums)
        : open(column(sums, ErrorColumn::open_interval)),
          error(column(sums, ErrorColumn::error)),
          square(column(sums, ErrorColumn::square)),
          product(column(sums, ErrorColumn::product)),
          relative(column(sums, ErrorColumn::relative)) {}

    void write(double* sums) const {
        store(sums + ErrorColumn::open_interval * lanes, open);
        store(sums + ErrorColumn::error * lanes, error);
        store(sums + ErrorColumn::square * lanes, square);
        store(sums + ErrorColumn::product * lanes, product);
        store(sums + ErrorColumn::relative * lanes, relative);
    }

    /// \param sum  of the interval's steps
    void close(const ReadingTime& reading, int interval, double factor, V sum) {
        const double measured = reading.measured[interval];
        if (measured != measured) return;
        const V y = broadcast(measured);
        const V e = fms(sum, broadcast(factor), y);
        error = add(error, e);
        square = fma(e, e, square);
        product = fma(e, y, product);
        relative = fma(magnitude(e), broadcast(reading.inverse[interval]), relative);
    }
};

void compare(const ReadingTime& reading, const double* shown, int begin, int end,
             double* errors) {
    Errors sums(errors);
    for (int step = begin; step < end; ++step) {
        sums.open = add(sums.open, column(shown, step - begin));
        const int interval = reading.closes[step];
        if (interval < 0) continue;
        sums.close(reading, interval, reading.factor[interval], sums.open);
        sums.open = broadcast(0);
    }
    sums.write(errors);
}

/// What a meter reads [W] while the powers are in registers.
[[gnu::always_inline]] inline V metered(const MeterLanes& meter_lanes, int step,
                                        const double* regime, V heat, V cool) {
    const double* row = meter_lanes.rows + meter_lanes.row_offset[step];
    const V watts = column(regime, StandardColumn::watts);
    const V heated = fma(mul(column(row, 1), watts), heat, load(row));
    return fnma(mul(column(row, 2), watts), cool, heated);
}

/// Sees a meter that is read at every step.
struct Compared {
    static constexpr bool sums_powers = true;
    MeterLanes meter_lanes;
    ReadingTime reading;
    int first;  ///< step of the first reading
    double factor;
    double* errors;
    Errors sums;
    void see(int step, const double* regime, V, V heat, V cool) {
        sums.close(reading, step - first, factor,
                   metered(meter_lanes, step, regime, heat, cool));
    }
    void end() const { sums.write(errors); }
};

void run_compared(const ZoneTime& zone, const ZoneLanes& group, int segment, int begin,
                  int end, const MeterLanes& meter_lanes, const ReadingTime& reading,
                  double* errors) {
    run_standard(zone, group, segment, begin, end,
                 Compared{meter_lanes, reading, begin - reading.closes[begin],
                          reading.factor[0], errors, Errors(errors)});
}

#include "kernel/kernel_adjoint.inl"
#include "kernel/kernel_differences.inl"

constexpr Table table{
    lanes,           run,
    run_compared,    run_metered,
    run_differences, add_differences,
    add_base,        add_zone,
    meter,           add_up,
    compare,         {collect, keep, seed_meter, seed_air, share_air, pull}};
