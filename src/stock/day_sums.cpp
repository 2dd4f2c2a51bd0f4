/// Sums readings and predictions over quarters of a day, of all periods in a row.
/// Follows from study::readings_of and a single simulation. A quarter with a reading
/// missing is missing.
/// Leaves out meters by the month, and the part of a day at a period's cut end.
#include "stock/day_sums.hpp"

#include "study/fit_model.hpp"
#include "study/points.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stock {

namespace {

constexpr std::size_t n_quarters = 4;
constexpr std::chrono::hours a_quarter{24 / n_quarters};

bool is_by_day(const study::Meter& meter) {
    return meter.interval == physics::Interval::daily && !meter.interval.are_own();
}
bool is_by_hour(const study::Meter& meter) {
    return meter.interval == physics::Interval::step ||
           meter.interval == physics::Interval::hourly;
}

std::vector<DayFeature> features_of(const study::Case& building) {
    std::vector<DayFeature> features;
    for (std::size_t m = 0; m < building.meters.size(); ++m) {
        if (is_by_day(building.meters[m])) features.push_back({m, 0, true});
        if (!is_by_hour(building.meters[m])) continue;
        for (std::size_t q = 0; q < n_quarters; ++q) features.push_back({m, q, false});
    }
    return features;
}

/// What each meter reads in a period at the nominal values.
std::vector<std::vector<double>> predictions_in(const study::Case& building,
                                                const study::Period& period) {
    const physics::Drive drive = study::drive_of(building, period);
    std::vector<kernel::Channel> channels;
    channels.reserve(building.meters.size());
    for (const study::Meter& meter : building.meters)
        channels.push_back({meter.quantity, meter.interval});
    const study::FitModel model(building.building, building.parameters, drive, channels);
    const Matrix all = model.predict(study::nominal_row(building.parameters));
    std::vector<std::vector<double>> predictions;
    predictions.reserve(channels.size());
    for (std::size_t m = 0; m < channels.size(); ++m)
        predictions.emplace_back(
            all.values.begin() + static_cast<std::ptrdiff_t>(model.first()[m]),
            all.values.begin() + static_cast<std::ptrdiff_t>(model.first()[m + 1]));
    return predictions;
}

/// Of each meter, over all periods.
std::vector<DaySums::Series> series_of(const study::Case& building) {
    std::vector<DaySums::Series> all(building.meters.size());
    for (const study::Period& period : building.periods) {
        const auto readings = study::readings_of(building, period);
        const auto predictions = predictions_in(building, period);
        const physics::TimeAxis axis = study::axis_of(building, period);
        for (std::size_t m = 0; m < all.size(); ++m) {
            const auto begins = study::begins_of(axis, building.meters[m].interval);
            const auto append = [](auto& to, const auto& from) {
                to.insert(to.end(), from.begin(), from.end());
            };
            append(all[m].begins, begins);
            append(all[m].measured, readings[m].values);
            append(all[m].predicted, predictions[m]);
        }
    }
    return all;
}

/// Sums of one feature, day by day; those of a temperature are means.
class Column {
  public:
    Column(const study::Case& building, const DayFeature& feature, std::size_t n_days)
        : feature_(feature),
          meter_(building.meters[feature.meter]),
          sums_(n_days, 0),
          counts_(n_days, 0) {}

    void add(std::size_t day, physics::Seconds begin, double value) {
        const auto quarter = static_cast<std::size_t>(
            (begin - std::chrono::floor<std::chrono::days>(begin)) / a_quarter);
        if (day >= sums_.size() ||
            (!feature_.is_whole_day && quarter != feature_.quarter))
            return;
        sums_[day] += value;
        counts_[day] += 1;
    }

    double at(std::size_t day, double n_whole) const {
        if (counts_[day] != n_whole) return nan;
        return physics::is_temperature(meter_.quantity) ? sums_[day] / n_whole
                                                        : sums_[day];
    }

  private:
    const DayFeature& feature_;
    const study::Meter& meter_;
    std::vector<double> sums_, counts_;
};

/// Readings in a whole feature.
double n_in(const DayFeature& feature, const study::Meter& meter, int step_s) {
    if (feature.is_whole_day) return 1;
    const int length =
        meter.interval == physics::Interval::step ? step_s : physics::day_s / 24;
    return std::chrono::seconds(a_quarter).count() / static_cast<double>(length);
}

}  // namespace

std::size_t DaySums::row_of(physics::Seconds time) const {
    const auto days = std::chrono::floor<std::chrono::days>(time - first).count();
    return static_cast<std::size_t>(
        std::clamp<long long>(days, 0, static_cast<long long>(n_days())));
}

physics::Seconds DaySums::day_at(std::size_t row) const {
    return first + std::chrono::days(static_cast<int>(row));
}

DaySums day_sums(const study::Case& building) {
    DaySums sums;
    sums.first = std::chrono::floor<std::chrono::days>(building.periods.front().from);
    sums.features = features_of(building);
    const auto n_days = static_cast<std::size_t>(
        std::chrono::floor<std::chrono::days>(building.periods.back().to - sums.first)
            .count());
    sums.measured = sums.predicted = Matrix(n_days, sums.features.size(), nan);
    std::vector<Column> measured, predicted;
    for (const DayFeature& feature : sums.features) {
        measured.emplace_back(building, feature, n_days);
        predicted.emplace_back(building, feature, n_days);
    }
    sums.series = series_of(building);
    for (std::size_t f = 0; f < sums.features.size(); ++f) {
        const DaySums::Series& series = sums.series[sums.features[f].meter];
        for (std::size_t k = 0; k < series.begins.size(); ++k) {
            const std::size_t day = sums.row_of(series.begins[k]);
            measured[f].add(day, series.begins[k], series.measured[k]);
            predicted[f].add(day, series.begins[k], series.predicted[k]);
        }
    }
    for (std::size_t f = 0; f < sums.features.size(); ++f) {
        const double n = n_in(sums.features[f], building.meters[sums.features[f].meter],
                              building.step_s);
        for (std::size_t d = 0; d < n_days; ++d) {
            sums.measured(d, f) = measured[f].at(d, n);
            sums.predicted(d, f) = predicted[f].at(d, n);
        }
    }
    return sums;
}

}  // namespace bemcal::stock
