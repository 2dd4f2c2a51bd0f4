/// Writes the validation of a meter, a group for each part of its readings, and what the
/// data said of each unknown.
/// Follows from `validate_parts` and `moves_of`.
/// Of Guideline 14 only met or not is stored; of days the errors, not the totals.
#include "posterior/validation_results.hpp"

#include "study/fit.hpp"

#include <cmath>

namespace bemcal::posterior {
namespace {

double seconds_of(physics::Seconds time) {
    return static_cast<double>(time.time_since_epoch().count());
}

void add_fits(const study::Validation& validation, const std::string& folder,
              study::DatasetBuilder& datasets) {
    std::vector<double> values;
    std::vector<std::string> names;
    using Fits = study::BeforeAfter<stats::FitMetrics>;
    for (const auto version : {&Fits::before, &Fits::after})
        for (const Fits* fits : {&validation.own, &validation.daily, &validation.monthly})
            for (const study::FitNumber& number : study::fit_numbers)
                values.push_back(fits->*version.*number.value);
    for (const study::FitNumber& number : study::fit_numbers)
        names.emplace_back(number.name);
    datasets.texts(folder + "metric", "metric", std::move(names));
    datasets.array(folder + "validation_fit", {"version", "resolution", "metric"},
                   {2, 3, std::size(study::fit_numbers)}, std::move(values));
}

void add_verdicts(const study::Validation& validation, const std::string& folder,
                  study::DatasetBuilder& datasets) {
    std::vector<double> values;
    using Verdicts = study::BeforeAfter<study::Verdict>;
    for (const auto version : {&Verdicts::before, &Verdicts::after})
        for (const Verdicts* of :
             {&validation.hourly_verdict, &validation.monthly_verdict})
            values.push_back((of->*version).is_met ? 1 : 0);
    datasets.array(folder + "guideline_14_met", {"version", "verdict"}, {2, 2},
                   std::move(values));
}

void add_months(const std::vector<study::MonthError>& months, const std::string& folder,
                study::DatasetBuilder& datasets) {
    if (months.empty()) return;
    std::vector<double> begins, measured, predicted, errors;
    for (const study::MonthError& month : months) {
        begins.push_back(seconds_of(month.begin));
        measured.push_back(month.measured);
    }
    using Pair = study::BeforeAfter<double>;
    for (const auto version : {&Pair::before, &Pair::after})
        for (const study::MonthError& month : months) {
            predicted.push_back(month.predicted.*version);
            errors.push_back(month.relative.*version);
        }
    datasets.vector(folder + "month", "month", std::move(begins));
    datasets.vector(folder + "month_measured", "month", std::move(measured));
    datasets.array(folder + "month_predicted", {"version", "month"}, {2, months.size()},
                   std::move(predicted));
    datasets.array(folder + "month_error", {"version", "month"}, {2, months.size()},
                   std::move(errors));
}

void add_days(const std::vector<study::DayFit>& days, const std::string& name,
              const std::string& folder, study::DatasetBuilder& datasets) {
    if (days.empty()) return;
    std::vector<double> begins, errors;
    for (const study::DayFit& day : days) begins.push_back(seconds_of(day.day));
    using Fits = study::BeforeAfter<stats::FitMetrics>;
    for (const auto version : {&Fits::before, &Fits::after})
        for (const study::DayFit& day : days)
            errors.push_back((day.metrics.*version).cv_rmse);
    datasets.vector(folder + name, name, std::move(begins));
    datasets.array(folder + name + "_cv_rmse", {"version", name}, {2, days.size()},
                   std::move(errors));
}

void add_coverage(const study::Validation& validation, const std::string& folder,
                  study::DatasetBuilder& datasets) {
    datasets.vector(
        folder + "coverage", "interval",
        {validation.own_coverage.inside_50, validation.own_coverage.inside_90,
         validation.monthly_coverage.inside_50, validation.monthly_coverage.inside_90});
    const stats::Pit& pit = validation.own_pit;
    datasets.vector(folder + "pit", "pit_bin", {pit.counts.begin(), pit.counts.end()});
    datasets.scalar(folder + "pit_distance", pit.distance);
}

}  // namespace

std::vector<study::PartValidation> add_validation(const MeterPrediction& meter,
                                                  std::span<const study::Role> roles,
                                                  const std::string& folder,
                                                  study::DatasetBuilder& datasets) {
    const study::Predicted predicted{meter.quantity,
                                     meter.interval,
                                     meter.begins,
                                     meter.measured,
                                     meter.nominal,
                                     meter.mean,
                                     meter.draws.rows > 0 ? &meter.draws : nullptr};
    std::vector<study::PartValidation> parts = study::validate_parts(predicted, roles);
    for (const study::PartValidation& part : parts) {
        const std::string inner = folder + part.part + "/";
        add_fits(part.validation, inner, datasets);
        add_verdicts(part.validation, inner, datasets);
        add_months(part.validation.months, inner, datasets);
        add_days(part.validation.mid_months, "mid_month", inner, datasets);
        add_days(part.validation.design_days, "design_day", inner, datasets);
        add_coverage(part.validation, inner, datasets);
    }
    return parts;
}

void add_moves(const std::vector<ParameterMove>& moves, study::DatasetBuilder& datasets) {
    std::vector<double> contraction, shift, range_share;
    std::vector<std::string> findings, words;
    for (const ParameterMove& move : moves) {
        contraction.push_back(move.contraction);
        shift.push_back(move.shift);
        range_share.push_back(move.range_share);
        findings.emplace_back(name_of(move.finding));
        words.push_back(move.words);
    }
    for (auto* values : {&contraction, &shift, &range_share})
        values->push_back(std::nan(""));
    findings.emplace_back();
    words.emplace_back();
    datasets.vector("contraction", "unknown", std::move(contraction));
    datasets.vector("shift", "unknown", std::move(shift));
    datasets.vector("range_share", "unknown", std::move(range_share));
    datasets.texts("data_finding", "unknown", std::move(findings));
    datasets.texts("data_words", "unknown", std::move(words));
}

}  // namespace bemcal::posterior
