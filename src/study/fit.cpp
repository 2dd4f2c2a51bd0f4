/// Says how well points fit the meters: metrics from the kernel's error sums, verdicts, a
/// score; and looks closely at single points by the plain simulation.
/// Source: ASHRAE Guideline 14 for NMBE, CV(RMSE) and their limits.
/// The score has no weights: it adds up squared CV(RMSE). Intervals are in `validation`.
#include "study/fit.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"
#include "physics/simulate.hpp"

#include <cmath>
#include <optional>
#include <utility>

namespace bemcal::study {
namespace {

bool is_finer_than_month(physics::Interval interval) {
    return interval != physics::Interval::monthly &&
           interval != physics::Interval::annual;
}

/// What is measured follows from the errors: measured = simulated - error.
stats::PairSums pairs_of(const kernel::ErrorSums& sums) {
    stats::PairSums pairs;
    pairs.n = sums.n;
    pairs.error = sums.error;
    pairs.square = sums.square;
    pairs.simulated = sums.simulated;
    pairs.simulated_square = sums.simulated_square;
    pairs.product = sums.product;
    pairs.measured = sums.simulated - sums.error;
    pairs.measured_square = sums.square - sums.simulated_square + 2 * sums.product;
    pairs.n_relative = sums.n_relative;
    pairs.relative = sums.relative;
    return pairs;
}

const stats::FitMetrics* metrics_at(stats::Resolution resolution,
                                    const kernel::Readings& readings,
                                    const MeterFit& fit) {
    if (resolution == stats::Resolution::monthly) return &fit.monthly;
    return is_finer_than_month(readings.interval) ? &fit.own : nullptr;
}

/// Both series added up (means for a temperature) over the intervals of each month that
/// have a reading; a month without any is left out.
stats::FitMetrics monthly_metrics(const MeterSeries& series, physics::Quantity quantity) {
    std::vector<double> simulated, measured, n;
    int month = -1;
    for (std::size_t k = 0; k < series.begins.size(); ++k) {
        if (std::isnan(series.measured[k])) continue;
        const auto label = physics::calendar_step(series.begins[k]);
        if (label.year * 12 + label.month != month) {
            month = label.year * 12 + label.month;
            for (auto* sums : {&simulated, &measured, &n}) sums->push_back(0);
        }
        simulated.back() += series.simulated[k];
        measured.back() += series.measured[k];
        n.back() += 1;
    }
    if (physics::is_temperature(quantity))
        for (std::size_t m = 0; m < n.size(); ++m) {
            simulated[m] /= n[m];
            measured[m] /= n[m];
        }
    return stats::metrics_of(simulated, measured);
}

/// By step, of each quantity; NaN where the point lies outside the method.
class PlainRun {
  public:
    PlainRun(const Case& building, const physics::Drive& drive,
             std::span<const double> point)
        : building_(building.building), drive_(drive) {
        physics::apply(building.building, building.parameters, point, building_);
        try {
            trajectory_ = physics::simulate(building_, drive_);
        } catch (const CannotSimulate&) {  // the point's failure is already on record
            trajectory_.reset();
        }
    }

    std::vector<double> by_step(physics::Quantity quantity) const {
        if (trajectory_)
            return physics::predict(building_, drive_, *trajectory_, quantity);
        return std::vector<double>(
            static_cast<std::size_t>(drive_.n_steps() - drive_.n_warm_up), nan);
    }

  private:
    physics::Building building_;
    const physics::Drive& drive_;
    std::optional<physics::Trajectory> trajectory_;  ///< none where it failed
};

MeterSeries series_of(const PlainRun& run, const physics::TimeAxis& axis,
                      const kernel::Readings& readings) {
    return compared(physics::aggregate(run.by_step(readings.quantity),
                                       physics::interval_bounds(axis, readings.interval),
                                       readings.quantity),
                    axis, readings);
}

}  // namespace

MeterSeries compared(std::vector<double> simulated, const physics::TimeAxis& period,
                     const kernel::Readings& readings) {
    MeterSeries series;
    series.begins = begins_of(period, readings.interval);
    series.simulated = std::move(simulated);
    series.measured = readings.values;
    series.fit.own = stats::metrics_of(series.simulated, series.measured);
    series.fit.monthly = is_finer_than_month(readings.interval)
                             ? monthly_metrics(series, readings.quantity)
                             : series.fit.own;
    return series;
}

MeterFit fit_of(const kernel::Readings& readings, const kernel::ErrorSums& own,
                const kernel::ErrorSums& monthly) {
    const stats::FitMetrics metrics = stats::metrics_of(pairs_of(own));
    if (!is_finer_than_month(readings.interval)) return {metrics, metrics};
    return {metrics, stats::metrics_of(pairs_of(monthly))};
}

bool meet_guideline_14(const std::vector<kernel::Readings>& readings,
                       const std::vector<MeterFit>& fits, stats::Resolution resolution) {
    bool any = false;
    for (std::size_t m = 0; m < fits.size(); ++m) {
        const stats::FitMetrics* metrics = metrics_at(resolution, readings[m], fits[m]);
        if (metrics == nullptr || metrics->n == 0) continue;
        if (!stats::meets_guideline_14(*metrics, resolution)) return false;
        any = true;
    }
    return any;
}

double score_of(const std::vector<MeterFit>& fits) {
    double score = 0;
    for (const MeterFit& fit : fits)
        if (fit.own.n > 0) {
            const double error = stats::relative_error(fit.own);
            score += error * error;
        }
    return score;
}

CloseLook look_closely(const Case& building, const Period& period,
                       const physics::Drive& drive, std::span<const double> point,
                       const std::vector<physics::Quantity>& hourly) {
    const PlainRun run(building, drive, point);
    CloseLook look;
    for (const auto& readings : readings_of(building, period))
        look.meters.push_back(series_of(run, axis_of(building, period), readings));
    for (const auto quantity : hourly) look.hourly.push_back(run.by_step(quantity));
    return look;
}

}  // namespace bemcal::study
