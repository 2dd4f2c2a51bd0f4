/// The Kalman filter of the scaled residuals and its way back. Once the gain has settled
/// it is held to the end of the stretch, and the way back differentiates that.
/// Source: state-space form of Hartikainen and Sarkka 2010; holding the gain is our own.
/// Left out: smoothing, prediction of readings.
#include "stats/residual_model_filter.hpp"

namespace bemcal::stats::residual {

namespace {

using Flags = Eigen::Array<bool, width, 1>;

/// A covariance before a reading; where `is_repeated`, that of the record before.
struct Record {
    Covariance covariance;
    Flags is_repeated;
};

void store(double* records, std::size_t index, const Record& record) {
    const Covariance& p = record.covariance;
    std::size_t at = 7 * index;
    for (const Lanes* entry : {&p.aa, &p.am, &p.ad, &p.mm, &p.md, &p.dd})
        row(records, at++) = *entry;
    row(records, at) = record.is_repeated.cast<double>();
}

Record load(const double* records, std::size_t index) {
    const double* at = records + 7 * index * width;
    return {{row(at, 0), row(at, 1), row(at, 2), row(at, 3), row(at, 4), row(at, 5)},
            row(at, 6) > 0};
}

/// Not above the tolerance; a lane that is not finite is settled too.
Flags is_settled(const Gain& now, const Gain& before, double tolerance) {
    const Lanes change = (now.k.a - before.k.a)
                             .abs()
                             .max((now.k.m - before.k.m).abs())
                             .max((now.k.d - before.k.d).abs())
                             .max((now.variance - before.variance).abs() * now.precision);
    return !(change > tolerance);
}

}  // namespace

Filter::Filter(const ReadingTimes& times, const ParameterLanes& parameters,
               double tolerance, const Scaled& scaled, const FilterScratch& scratch)
    : times_(times),
      parameters_(parameters),
      tolerance_(tolerance),
      scaled_(scaled),
      scratch_(scratch),
      slopes_(times.gaps.size(), no_motion()) {
    motions_.reserve(times.gaps.size());
    for (const std::size_t gap : times.gaps)
        motions_.push_back(motion_over(parameters, gap));
}

/// After the last reading read.
struct Filter::Forward {
    State state = no_state();
    Covariance covariance = no_covariance();
    Lanes squares = all(0);  ///< sum of innovation^2 / variance
    LogProduct variances;
    std::size_t n_records = 0;
};

void Filter::read(std::size_t begin, std::size_t end, const Transition& t, const Gain& g,
                  Forward& now) const {
    State x = now.state;
    for (std::size_t k = begin; k < end; ++k) {
        const Lanes a = t.rho * x.a;
        const Lanes m = t.mm * x.m + t.md * x.d, d = t.dm * x.m + t.dd * x.d;
        const Lanes innovation = row(scaled_.z, k) - (a + m);
        now.squares += innovation * innovation * g.precision;
        now.variances.times(g.variance);
        x = {a + g.k.a * innovation, m + g.k.m * innovation, d + g.k.d * innovation};
        row(scaled_.slope, k) = innovation;
        row(scratch_.states, 3 * k + 3) = x.a;
        row(scratch_.states, 3 * k + 4) = x.m;
        row(scratch_.states, 3 * k + 5) = x.d;
    }
    now.state = x;
}

/// Leaves the filtered covariance after the stretch.
void Filter::read_stretch(const ReadingTimes::Stretch& stretch, Forward& now) const {
    const Motion& unit = motions_[ReadingTimes::unit];
    Record record{predicted(motions_[stretch.gap], now.covariance),
                  Flags::Constant(false)};
    Flags settled = Flags::Constant(false);
    Gain gain = gain_of(record.covariance);
    store(scratch_.records, now.n_records++, record);
    read(stretch.begin, stretch.begin + 1, motions_[stretch.gap].transition, gain, now);
    std::size_t next = stretch.begin + 1;
    for (; next < stretch.end && !settled.all(); ++next) {
        const Covariance moved = predicted(unit, filtered(record.covariance, gain));
        record = {choose(settled, record.covariance, moved), settled};
        const Gain before = gain;
        gain = gain_of(record.covariance);
        settled = settled || is_settled(gain, before, tolerance_);
        store(scratch_.records, now.n_records++, record);
        read(next, next + 1, unit.transition, gain, now);
    }
    read(next, stretch.end, unit.transition, gain, now);
    now.covariance = filtered(record.covariance, gain);
}

Lanes Filter::log_density() {
    Forward now;
    for (std::size_t k = 0; k < 3; ++k) row(scratch_.states, k) = all(0);
    for (std::size_t k = 0; k < times_.stretches.size(); ++k) {
        read_stretch(times_.stretches[k], now);
        scratch_.records_end[k] = now.n_records;
    }
    return -0.5 * (now.squares + now.variances.log());
}

/// Where the way back stands: a record with its gain, and the derivatives of all that
/// comes later.
struct Filter::Backward {
    Record record{no_covariance(), Flags::Constant(false)};
    Gain gain{no_state(), all(0), all(0)};
    State by_state = no_state();                 ///< after the reading before
    Covariance by_covariance = no_covariance();  ///< the record's
    GainSlope by_gain{no_state(), all(0)};

    void look_at(const Record& other) {
        record = other;
        gain = gain_of(other.covariance);
    }
};

void Filter::unread(std::size_t begin, std::size_t end, std::size_t kind, Backward& now) {
    const Transition t = motions_[kind].transition;
    const Gain g = now.gain;
    Transition by_t = slopes_[kind].transition;
    GainSlope by_gain = now.by_gain;
    State s = now.by_state;
    for (std::size_t k = end; k-- > begin;) {
        const Lanes innovation = row(scaled_.slope, k);
        const Lanes expected = innovation * g.precision;
        by_gain.k.a += s.a * innovation;
        by_gain.k.m += s.m * innovation;
        by_gain.k.d += s.d * innovation;
        by_gain.variance += 0.5 * (expected * expected - g.precision);
        const Lanes slope = g.k.a * s.a + g.k.m * s.m + g.k.d * s.d - expected;
        row(scaled_.slope, k) = slope;
        const State by{s.a - slope, s.m - slope, s.d};
        const Lanes a = row(scratch_.states, 3 * k), m = row(scratch_.states, 3 * k + 1),
                    d = row(scratch_.states, 3 * k + 2);
        by_t.rho += by.a * a;
        by_t.mm += by.m * m;
        by_t.md += by.m * d;
        by_t.dm += by.d * m;
        by_t.dd += by.d * d;
        s = {t.rho * by.a, t.mm * by.m + t.dm * by.d, t.md * by.m + t.dd * by.d};
    }
    slopes_[kind].transition = by_t;
    now.by_gain = by_gain;
    now.by_state = s;
}

/// From a record's covariance to that of the record before; a repeated one passes all on.
/// The first came from nothing: its transition is 0.
void Filter::undo_prediction(std::size_t index, std::size_t kind, Backward& now) {
    const Flags is_repeated = now.record.is_repeated;
    const Covariance slope = choose(is_repeated, no_covariance(),
                                    now.by_covariance + gain_back(now.gain, now.by_gain));
    now.by_gain = choose(is_repeated, now.by_gain, {no_state(), all(0)});
    now.look_at(load(scratch_.records, index == 0 ? 0 : index - 1));
    const Transition& transition = motions_[kind].transition;
    add_motion_slope(transition, filtered(now.record.covariance, now.gain), slope,
                     slopes_[kind]);
    const Covariance by_filtered = predicted_back(transition, slope);
    now.by_covariance =
        choose(is_repeated, now.by_covariance, filtered_back(now.gain, by_filtered));
}

void Filter::unread_stretch(std::size_t index, Backward& now) {
    const auto& stretch = times_.stretches[index];
    const std::size_t first = index == 0 ? 0 : scratch_.records_end[index - 1];
    std::size_t end = stretch.end;
    for (std::size_t record = scratch_.records_end[index]; record-- > first;) {
        const std::size_t reading = stretch.begin + (record - first);
        const std::size_t kind = record == first ? stretch.gap : ReadingTimes::unit;
        unread(reading + 1, end, ReadingTimes::unit, now);
        unread(reading, reading + 1, kind, now);
        undo_prediction(record, kind, now);
        end = reading;
    }
}

void Filter::pull_back(ParameterLanes& derivative) {
    Backward now;
    now.look_at(
        load(scratch_.records, scratch_.records_end[times_.stretches.size() - 1] - 1));
    for (std::size_t k = times_.stretches.size(); k-- > 0;) unread_stretch(k, now);
    for (std::size_t k = 0; k < times_.gaps.size(); ++k)
        pull_back_motion(parameters_, times_.gaps[k], slopes_[k], derivative);
}

}  // namespace bemcal::stats::residual
