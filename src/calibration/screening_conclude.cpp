/// Turns the items' answers into the result of a screening: counts, the best points,
/// nominal against best, and with keep_points every point; and what it found, in short.
/// Follows from the layout of a row in `ranking`.
/// Only nominal and best are simulated again (`candidates`). Points have no weights.
#include "base/nan.hpp"
#include "calibration/candidates.hpp"
#include "calibration/screening_plan.hpp"
#include "study/datasets.hpp"
#include "study/failures.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace bemcal::calibration {
namespace {

Ranking ranking_of(const ScreeningPlan& plan,
                   const std::vector<study::ItemAnswer>& answers) {
    Ranking all(plan.layout, plan.options.n_best);
    for (std::size_t item = 0; item < answers.size(); ++item) {
        const study::ItemAnswer& answer = answers[item];
        if (!answer.error.empty()) continue;
        if (plan.options.keep_points)
            all.add_rows(static_cast<long long>(plan.first_of(item)), answer.values);
        else
            all.add(Ranking::unpack(plan.layout, plan.options.n_best, answer.values));
    }
    return all;
}

std::vector<study::Failure> failures_of(const ScreeningPlan& plan,
                                        const std::vector<study::ItemAnswer>& answers) {
    std::vector<study::Failure> failures;
    for (std::size_t item = 0; item < answers.size(); ++item)
        study::append_failures(answers[item], {plan.first_of(item), plan.size_of(item)},
                               failures);
    return failures;
}

void add_names(const ScreeningPlan& plan, study::DatasetBuilder& datasets) {
    datasets.parameters(plan.building.parameters);
    add_candidate_names(plan.building, datasets);
    datasets.texts("resolution", "resolution", {"hourly", "monthly"});
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
              const std::string& prefix, study::DatasetBuilder& datasets) {
    datasets.vector(prefix + "score", dim, columns_of(rows, 0, 1));
    for (std::size_t k = 0; k < RowLayout::n_metrics; ++k)
        datasets.array(prefix + RowLayout::metric_name(k), {dim, "period", "meter"},
                       {rows.rows, layout.n_periods, layout.n_meters},
                       columns_of(rows, layout.metric(k), layout.n_fits()));
}

void add_points(const ScreeningPlan& plan, const std::vector<study::ItemAnswer>& answers,
                study::DatasetBuilder& datasets) {
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

/// [best x parameters]
Matrix points_of(const ScreeningPlan& plan, const std::vector<Ranked>& best) {
    Matrix points(0, plan.building.parameters.size());
    for (const Ranked& ranked : best) {
        const Matrix point = plan.points(static_cast<std::size_t>(ranked.point), 1);
        points.values.insert(points.values.end(), point.values.begin(),
                             point.values.end());
        ++points.rows;
    }
    return points;
}

void add_best(const ScreeningPlan& plan, const std::vector<Ranked>& best,
              study::DatasetBuilder& datasets) {
    Matrix rows(best.size(), plan.layout.width());
    std::vector<double> indices;
    for (std::size_t rank = 0; rank < best.size(); ++rank) {
        indices.push_back(static_cast<double>(best[rank].point));
        std::ranges::copy(best[rank].row, rows.row(rank).begin());
    }
    const Matrix points = points_of(plan, best);
    datasets.vector("best_point", "rank", std::move(indices));
    datasets.array("best_parameters", {"rank", "parameter"}, {points.rows, points.cols},
                   points.values);
    add_rows(plan.layout, rows, "rank", "best_", datasets);
}

/// Nominal and best; where no point succeeded the nominal one stands for both.
Matrix candidates_of(const ScreeningPlan& plan, const std::vector<Ranked>& best) {
    Matrix candidates = plan.points(0, 1);
    const Matrix chosen = best.empty()
                              ? candidates
                              : plan.points(static_cast<std::size_t>(best[0].point), 1);
    candidates.values.insert(candidates.values.end(), chosen.values.begin(),
                             chosen.values.end());
    candidates.rows = 2;
    return candidates;
}

/// How far the best points reach in each parameter; the first is the best.
std::vector<study::FoundValue> values_of(const ScreeningPlan& plan,
                                         const Matrix& points) {
    std::vector<study::FoundValue> values;
    values.reserve(points.cols);
    for (std::size_t k = 0; k < points.cols; ++k) {
        study::FoundValue value{plan.building.parameters[k].name, points(0, k),
                                points(0, k), points(0, k)};
        for (std::size_t r = 1; r < points.rows; ++r) {
            value.low = std::min(value.low, points(r, k));
            value.high = std::max(value.high, points(r, k));
        }
        values.push_back(std::move(value));
    }
    return values;
}

/// \param nominal  the row of point 0; empty where it is not kept
std::vector<study::FoundFit> fits_of(const RowLayout& layout,
                                     std::span<const double> nominal,
                                     std::span<const double> best) {
    std::vector<study::FoundFit> fits;
    for (std::size_t p = 0; p < layout.n_periods; ++p)
        for (std::size_t m = 0; m < layout.n_meters; ++m)
            fits.push_back(
                {p, m,
                 nominal.empty() ? nan : layout.value(nominal, layout.cv_rmse, p, m),
                 layout.value(best, layout.cv_rmse, p, m),
                 layout.value(best, layout.nmbe, p, m)});
    return fits;
}

/// Where no point succeeded the values are the nominal ones.
study::Summary summary_of(const ScreeningPlan& plan,
                          const std::vector<study::ItemAnswer>& answers,
                          const std::vector<Ranked>& best,
                          const std::vector<study::Failure>& failures) {
    study::Summary summary;
    summary.study = plan.name;
    if (best.empty()) {
        summary.values = values_of(plan, plan.points(0, 1));
        summary.failure =
            "no point could be simulated: " +
            (failures.empty() ? std::string("without a reason") : failures[0].reason);
        return summary;
    }
    for (const physics::Parameter& parameter : plan.building.parameters)
        summary.points.parameters.push_back(parameter.name);
    summary.points.rows = points_of(plan, best);
    summary.values = values_of(plan, summary.points.rows);
    std::span<const double> nominal;
    if (plan.options.keep_points && !answers[0].values.empty())
        nominal = std::span(answers[0].values).first(plan.layout.width());
    summary.fits = fits_of(plan.layout, nominal, best[0].row);
    summary.score = best[0].row[0];
    return summary;
}

}  // namespace

std::vector<double> best_point_of(const ScreeningPlan& plan,
                                  const std::vector<study::ItemAnswer>& answers) {
    const Ranking ranking = ranking_of(plan, answers);
    if (ranking.best().empty()) return {};
    return plan.points(static_cast<std::size_t>(ranking.best()[0].point), 1).values;
}

study::Conclusion conclude_screening(const ScreeningPlan& plan,
                                     const std::vector<study::ItemAnswer>& answers) {
    study::DatasetBuilder datasets(plan.name);
    datasets.kind("screening");
    add_names(plan, datasets);
    const Ranking ranking = ranking_of(plan, answers);
    datasets.array("guideline_14_count", {"period", "resolution"},
                   {plan.layout.n_periods, RowLayout::n_resolutions},
                   ranking.n_meeting());
    if (!ranking.best().empty()) add_best(plan, ranking.best(), datasets);
    if (plan.options.close_look)
        add_candidates({plan.building, plan.models, plan.options.hourly_outputs},
                       candidates_of(plan, ranking.best()), datasets);
    if (plan.options.keep_points) add_points(plan, answers, datasets);
    const std::vector<study::Failure> failures = failures_of(plan, answers);
    datasets.failures(failures);
    return {datasets.take(), {summary_of(plan, answers, ranking.best(), failures)}};
}

}  // namespace bemcal::calibration
