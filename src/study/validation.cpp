/// Holds a calibrated model against readings, before and after: errors by reading, day
/// and month, verdicts, the 15th of each month, 21 January and July, coverage and PIT.
/// Source: paper 1, section 4; ASHRAE Guideline 14-2014.
/// Days and months count by `complete_intervals`. Predictions are made in `predictive`.
#include "study/validation.hpp"

#include "base/nan.hpp"
#include "study/complete_intervals.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bemcal::study {
namespace {

using physics::Interval;
using physics::Seconds;

using Fits = BeforeAfter<stats::FitMetrics>;

stats::FitMetrics metrics_or_none(std::span<const double> simulated,
                                  std::span<const double> measured) {
    if (simulated.empty()) return stats::metrics_of(stats::PairSums{});
    return stats::metrics_of(simulated, measured);
}

Fits compare(const BeforeAfter<std::span<const double>>& predicted,
             std::span<const double> measured) {
    return {metrics_or_none(predicted.before, measured),
            metrics_or_none(predicted.after, measured)};
}

/// Totals of days or months.
struct Totals {
    std::vector<CompleteInterval> intervals;
    std::vector<double> measured;
    BeforeAfter<std::vector<double>> predicted;

    Totals(const Predicted& meter, Interval by)
        : intervals(complete_intervals(meter.begins, meter.measured, meter.interval, by)),
          measured(totals_of(intervals, meter.measured, meter.quantity)),
          predicted{of(meter.before, meter.quantity), of(meter.after, meter.quantity)} {}

    Fits fits() const { return compare({predicted.before, predicted.after}, measured); }

  private:
    std::vector<double> of(std::span<const double> values, physics::Quantity quantity) {
        if (values.empty()) return {};
        return totals_of(intervals, values, quantity);
    }
};

double at_or_nan(const std::vector<double>& values, std::size_t k) {
    return values.empty() ? nan : values[k];
}

double relative_error(double predicted, double measured) {
    return measured == 0 ? nan : (predicted - measured) / measured;
}

std::vector<MonthError> errors_of(const Totals& months) {
    std::vector<MonthError> errors;
    errors.reserve(months.measured.size());
    for (std::size_t k = 0; k < months.measured.size(); ++k) {
        const double measured = months.measured[k];
        const double before = at_or_nan(months.predicted.before, k);
        const double after = at_or_nan(months.predicted.after, k);
        errors.push_back(
            {months.intervals[k].begin,
             measured,
             {before, after},
             {relative_error(before, measured), relative_error(after, measured)}});
    }
    return errors;
}

std::vector<double> picked(std::span<const double> values,
                           const std::vector<std::size_t>& indices) {
    std::vector<double> chosen;
    if (values.empty()) return chosen;
    chosen.reserve(indices.size());
    for (const std::size_t k : indices) chosen.push_back(values[k]);
    return chosen;
}

DayFit fit_of_day(const Predicted& meter, Seconds day,
                  std::vector<std::size_t> readings) {
    const auto before = picked(meter.before, readings);
    const auto after = picked(meter.after, readings);
    const Fits fits = compare({before, after}, picked(meter.measured, readings));
    return {day, fits, std::move(readings)};
}

/// Days that `is_chosen` by their calendar date, in order; of meters read within the day.
template <class F>
std::vector<DayFit> days_of(const Predicted& meter, F is_chosen) {
    std::vector<DayFit> days;
    if (meter.interval >= Interval::daily) return days;
    for (std::size_t k = 0; k < meter.begins.size();) {
        const auto day = std::chrono::floor<std::chrono::days>(meter.begins[k]);
        std::vector<std::size_t> readings;
        while (k < meter.begins.size() && meter.begins[k] < day + std::chrono::days(1))
            readings.push_back(k++);
        const auto has_reading = [&](std::size_t r) {
            return !std::isnan(meter.measured[r]);
        };
        if (is_chosen(std::chrono::year_month_day(day)) &&
            std::ranges::any_of(readings, has_reading))
            days.push_back(fit_of_day(meter, day, std::move(readings)));
    }
    return days;
}

bool is_mid_month(std::chrono::year_month_day date) {
    return date.day() == std::chrono::day(15);
}

bool is_design_day(std::chrono::year_month_day date) {
    return date.day() == std::chrono::day(21) &&
           (date.month() == std::chrono::January || date.month() == std::chrono::July);
}

BeforeAfter<Verdict> verdicts_of(const Fits& fits, stats::Resolution resolution) {
    return {verdict_of(fits.before, resolution), verdict_of(fits.after, resolution)};
}

void add_coverage(Validation& validation, const Predicted& meter, const Totals& months) {
    const Matrix none;
    const Matrix& draws = meter.draws == nullptr ? none : *meter.draws;
    validation.own_coverage = stats::coverage_of(meter.measured, draws);
    validation.own_pit = stats::pit_of(meter.measured, draws);
    validation.monthly_coverage = stats::coverage_of(
        months.measured, totals_of(months.intervals, draws, meter.quantity));
}

/// The others become missing.
std::vector<double> measured_of(const Predicted& meter, std::span<const Role> roles,
                                Role role) {
    std::vector<double> measured(meter.measured.begin(), meter.measured.end());
    for (std::size_t k = 0; k < measured.size(); ++k)
        if (roles[k] != role) measured[k] = nan;
    return measured;
}

}  // namespace

Verdict verdict_of(const stats::FitMetrics& metrics, stats::Resolution resolution) {
    const double bias = metrics.n > 1 ? metrics.nmbe * metrics.n / (metrics.n - 1) : nan;
    return {bias, metrics.n > 1 ? metrics.cv_rmse_n1 : nan,
            stats::meets_guideline_14(metrics, resolution)};
}

Validation validate(const Predicted& meter) {
    const Totals months(meter, Interval::monthly);
    Validation v;
    v.own = compare({meter.before, meter.after}, meter.measured);
    v.daily = Totals(meter, Interval::daily).fits();
    v.monthly = months.fits();
    const Fits none = compare({}, {});
    v.hourly_verdict = verdicts_of(meter.interval < Interval::monthly ? v.own : none,
                                   stats::Resolution::hourly);
    v.monthly_verdict = verdicts_of(v.monthly, stats::Resolution::monthly);
    v.months = errors_of(months);
    v.mid_months = days_of(meter, is_mid_month);
    v.design_days = days_of(meter, is_design_day);
    add_coverage(v, meter, months);
    return v;
}

std::vector<PartValidation> validate_parts(const Predicted& meter,
                                           std::span<const Role> roles) {
    constexpr std::pair<Role, const char*> names[] = {
        {Role::training, "training"},
        {Role::held_out_hour, "held_out_hours"},
        {Role::held_out_week, "held_out_weeks"}};
    std::vector<PartValidation> parts{{"all", validate(meter)}};
    for (const auto& [role, name] : names) {
        if (std::ranges::find(roles, role) == roles.end()) continue;
        const std::vector<double> measured = measured_of(meter, roles, role);
        Predicted part = meter;
        part.measured = measured;
        parts.push_back({name, validate(part)});
    }
    return parts;
}

}  // namespace bemcal::study
