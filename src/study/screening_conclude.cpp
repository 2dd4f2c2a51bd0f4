/// From the items' answers to the datasets of a screening: counts, the best points,
/// nominal against best, and with keep_points every point.
#include "study/datasets.hpp"
#include "study/screening_plan.hpp"

#include <algorithm>
#include <limits>

namespace bemcal::study {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Ranking ranking_of(const ScreeningPlan& plan, const std::vector<ItemAnswer>& answers) {
    Ranking all(plan.layout, plan.options.n_best);
    for (std::size_t item = 0; item < answers.size(); ++item) {
        const ItemAnswer& answer = answers[item];
        if (!answer.error.empty()) continue;
        if (plan.options.keep_points)
            all.add_rows(static_cast<long long>(plan.first_of(item)), answer.values);
        else
            all.add(Ranking::unpack(plan.layout, plan.options.n_best, answer.values));
    }
    return all;
}

std::vector<Failure> failures_of(const ScreeningPlan& plan,
                                 const std::vector<ItemAnswer>& answers) {
    std::vector<Failure> failures;
    for (std::size_t item = 0; item < answers.size(); ++item) {
        const ItemAnswer& answer = answers[item];
        failures.insert(failures.end(), answer.failures.begin(), answer.failures.end());
        for (std::size_t r = 0; !answer.error.empty() && r < plan.size_of(item); ++r)
            failures.push_back(
                {static_cast<long long>(plan.first_of(item) + r), answer.error});
    }
    return failures;
}

void add_names(const ScreeningPlan& plan, DatasetBuilder& datasets) {
    std::vector<std::string> meters, units, periods;
    for (const Meter& meter : plan.building.meters) {
        meters.push_back(meter.name);
        units.push_back(physics::unit_of(meter.quantity));
    }
    for (const Period& period : plan.building.periods) periods.push_back(period.name);
    datasets.parameters(plan.building.parameters);
    datasets.texts("meter", "meter", std::move(meters));
    datasets.texts("meter_unit", "meter", std::move(units));
    datasets.texts("period", "period", std::move(periods));
    datasets.texts("resolution", "resolution", {"hourly", "monthly"});
    datasets.texts("candidate", "candidate", {"nominal", "best"});
    datasets.scalar("n_points", static_cast<double>(plan.n_points()));
}

/// Columns [begin, begin + n) of all rows.
std::vector<double> columns_of(const Matrix& rows, std::size_t begin, std::size_t n) {
    std::vector<double> columns;
    columns.reserve(rows.rows * n);
    for (std::size_t r = 0; r < rows.rows; ++r) {
        const auto part = rows.row(r).subspan(begin, n);
        columns.insert(columns.end(), part.begin(), part.end());
    }
    return columns;
}

/// Score and metrics of rows along `dim`; leaves begin with `prefix`.
void add_rows(const RowLayout& layout, const Matrix& rows, const std::string& dim,
              const std::string& prefix, DatasetBuilder& datasets) {
    datasets.vector(prefix + "score", dim, columns_of(rows, 0, 1));
    for (std::size_t k = 0; k < RowLayout::n_metrics; ++k)
        datasets.array(prefix + RowLayout::metric_name(k), {dim, "period", "meter"},
                       {rows.rows, layout.n_periods, layout.n_meters},
                       columns_of(rows, layout.metric(k), layout.n_fits()));
}

void add_points(const ScreeningPlan& plan, const std::vector<ItemAnswer>& answers,
                DatasetBuilder& datasets) {
    const RowLayout& layout = plan.layout;
    Matrix rows(plan.n_points(), layout.width(), nan);
    for (std::size_t item = 0; item < answers.size(); ++item)
        std::ranges::copy(answers[item].values, rows.row(plan.first_of(item)).data());
    datasets.array("points", {"point", "parameter"},
                   {plan.n_points(), plan.building.parameters.size()},
                   plan.points(0, plan.n_points()).values);
    add_rows(layout, rows, "point", "", datasets);
    datasets.array("meets_guideline_14", {"point", "period", "resolution"},
                   {plan.n_points(), layout.n_periods, RowLayout::n_resolutions},
                   columns_of(rows, layout.verdicts(), layout.n_verdicts()));
}

void add_best(const ScreeningPlan& plan, const std::vector<Ranked>& best,
              DatasetBuilder& datasets) {
    Matrix rows(best.size(), plan.layout.width());
    std::vector<double> indices, parameters;
    for (std::size_t rank = 0; rank < best.size(); ++rank) {
        indices.push_back(static_cast<double>(best[rank].point));
        std::ranges::copy(best[rank].row, rows.row(rank).begin());
        const Matrix point = plan.points(static_cast<std::size_t>(best[rank].point), 1);
        parameters.insert(parameters.end(), point.values.begin(), point.values.end());
    }
    datasets.vector("best_point", "rank", std::move(indices));
    datasets.array("best_parameters", {"rank", "parameter"},
                   {best.size(), plan.building.parameters.size()}, std::move(parameters));
    add_rows(plan.layout, rows, "rank", "best_", datasets);
}

/// Nominal and best: the same shape for both.
struct Candidates {
    Matrix points;                              ///< [2 x parameters]
    std::vector<std::vector<CloseLook>> looks;  ///< [2][periods]
};

/// Where no point succeeded the nominal one stands for the best as well.
Candidates look_at_candidates(const ScreeningPlan& plan,
                              const std::vector<Ranked>& best) {
    const Matrix nominal = plan.points(0, 1);
    const Matrix chosen =
        best.empty() ? nominal : plan.points(static_cast<std::size_t>(best[0].point), 1);
    Candidates candidates{Matrix(2, nominal.cols), {}};
    std::ranges::copy(nominal.values, candidates.points.row(0).begin());
    std::ranges::copy(chosen.values, candidates.points.row(1).begin());
    for (std::size_t c = 0; c < 2; ++c) {
        candidates.looks.emplace_back();
        for (std::size_t p = 0; p < plan.models.size(); ++p)
            candidates.looks[c].push_back(look_closely(
                plan.building, plan.building.periods[p], plan.models[p]->drive,
                candidates.points.row(c), plan.options.hourly_outputs));
    }
    return candidates;
}

void add_fits(const ScreeningPlan& plan, const Candidates& candidates,
              const std::string& leaf, stats::FitMetrics MeterFit::* which,
              DatasetBuilder& datasets) {
    std::vector<double> values;
    for (const auto& looks : candidates.looks)
        for (const CloseLook& look : looks)
            for (const MeterSeries& series : look.meters)
                for (const FitNumber& number : fit_numbers)
                    values.push_back(series.fit.*which.*number.value);
    datasets.array(
        leaf, {"candidate", "period", "meter", "metric"},
        {2, plan.layout.n_periods, plan.layout.n_meters, std::size(fit_numbers)},
        std::move(values));
}

std::vector<double> joined(std::vector<double> one, const std::vector<double>& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

void add_meter_series(const ScreeningPlan& plan, const Candidates& candidates,
                      std::size_t p, DatasetBuilder& datasets) {
    for (std::size_t m = 0; m < plan.layout.n_meters; ++m) {
        const MeterSeries &nominal = candidates.looks[0][p].meters[m],
                          &best = candidates.looks[1][p].meters[m];
        const std::string folder =
            plan.building.periods[p].name + "/" + plan.building.meters[m].name + "/";
        datasets.times(folder + "time", nominal.begins);
        datasets.vector(folder + "measured", "time", nominal.measured);
        datasets.array(folder + "simulated", {"candidate", "time"},
                       {2, nominal.begins.size()},
                       joined(nominal.simulated, best.simulated));
    }
}

/// Quantities of both candidates by step, and always the outdoor temperature they were
/// simulated with, so that other models can be fitted from the result alone.
void add_hourly(const ScreeningPlan& plan, const Candidates& candidates, std::size_t p,
                DatasetBuilder& datasets) {
    const physics::Drive& drive = plan.models[p]->drive;
    const std::string folder = plan.building.periods[p].name + "/hourly/";
    std::vector<physics::Seconds> begins;
    for (int step = drive.n_warm_up; step < drive.n_steps(); ++step)
        begins.push_back(drive.axis.begin_of(step));
    const std::size_t n_steps = begins.size();
    datasets.times(folder + "time", begins);
    datasets.vector(folder + "outdoor_temperature", "time",
                    {drive.theta_e.begin() + drive.n_warm_up, drive.theta_e.end()});
    for (std::size_t q = 0; q < plan.options.hourly_outputs.size(); ++q)
        datasets.array(
            folder + physics::name_of(plan.options.hourly_outputs[q]),
            {"candidate", "time"}, {2, n_steps},
            joined(candidates.looks[0][p].hourly[q], candidates.looks[1][p].hourly[q]));
}

void add_candidates(const ScreeningPlan& plan, const std::vector<Ranked>& best,
                    DatasetBuilder& datasets) {
    const Candidates candidates = look_at_candidates(plan, best);
    datasets.array("candidate_parameters", {"candidate", "parameter"},
                   {2, candidates.points.cols}, candidates.points.values);
    std::vector<std::string> names;
    for (const FitNumber& number : fit_numbers) names.emplace_back(number.name);
    datasets.texts("metric", "metric", std::move(names));
    add_fits(plan, candidates, "fit", &MeterFit::own, datasets);
    add_fits(plan, candidates, "monthly_fit", &MeterFit::monthly, datasets);
    for (std::size_t p = 0; p < plan.layout.n_periods; ++p) {
        add_meter_series(plan, candidates, p, datasets);
        add_hourly(plan, candidates, p, datasets);
    }
}

}  // namespace

std::vector<Dataset> conclude_screening(const ScreeningPlan& plan,
                                        const std::vector<ItemAnswer>& answers) {
    DatasetBuilder datasets(plan.name);
    add_names(plan, datasets);
    const Ranking ranking = ranking_of(plan, answers);
    datasets.array("guideline_14_count", {"period", "resolution"},
                   {plan.layout.n_periods, RowLayout::n_resolutions},
                   ranking.n_meeting());
    if (!ranking.best().empty()) add_best(plan, ranking.best(), datasets);
    add_candidates(plan, ranking.best(), datasets);
    if (plan.options.keep_points) add_points(plan, answers, datasets);
    datasets.failures(failures_of(plan, answers));
    return datasets.take();
}

}  // namespace bemcal::study
