/// Writes what a Kennedy-O'Hagan calibration predicts at its own field points: process
/// and measurements with intervals, errors with n and n - 1, coverage, the form of the
/// covariance.
/// Source: paper 1, step 5; bc-stan for n - 1.
/// Coverage tells of the fit only: points that were not learned from are left out.
#include "posterior/koh_results.hpp"

#include "emulator/prediction.hpp"
#include "stats/coverage.hpp"
#include "stats/metrics.hpp"
#include "study/some_draws.hpp"

#include <numeric>

namespace bemcal::posterior {
namespace {

using emulator::KohDensity;
using emulator::Prediction;

/// Of the job's random numbers.
constexpr std::uint32_t koh_predictive_stream = 0x6b6f6870;

Matrix rows_of(const Matrix& from, const std::vector<std::size_t>& rows) {
    Matrix made(rows.size(), from.cols);
    for (std::size_t k = 0; k < rows.size(); ++k)
        std::ranges::copy(from.row(rows[k]), made.row(k).begin());
    return made;
}

std::vector<double> column_means(const Matrix& matrix) {
    std::vector<double> means(matrix.cols);
    for (std::size_t k = 0; k < matrix.cols; ++k) {
        for (std::size_t r = 0; r < matrix.rows; ++r) means[k] += matrix(r, k);
        means[k] /= static_cast<double>(matrix.rows);
    }
    return means;
}

/// How the covariance is computed, and for how many of these draws it is not positive
/// definite in doubles as it stands.
void add_form(KohDensity& density, const Matrix& positions,
              study::DatasetBuilder& datasets) {
    datasets.text("covariance_form", density.is_kronecker() ? "kronecker" : "dense");
    sampling::Evaluations unused;
    density.evaluate(positions, false, unused);
    const emulator::JitterReport& jitter = density.jitter();
    const std::size_t n =
        std::accumulate(jitter.n_with.begin() + 1, jitter.n_with.end(), jitter.n_failed);
    datasets.scalar("n_predictive", static_cast<double>(positions.rows));
    datasets.scalar("n_with_jitter", static_cast<double>(n));
}

void add_points(const KohOptions& options, const Prediction& prediction,
                study::DatasetBuilder& datasets) {
    const emulator::Observations& o = options.observations;
    datasets.texts("known_input", "known_input", o.x_names);
    datasets.array("field_input", {"field_point", "known_input"},
                   {o.measured_x.rows, o.measured_x.cols}, o.measured_x.values);
    const auto add = [&](const char* leaf, std::vector<double> values) {
        const std::size_t n = values.size();
        datasets.array(leaf, {"field_point"}, {n}, std::move(values),
                       options.output_unit);
    };
    add("field_measured", o.measured);
    add("process_mean", column_means(prediction.mean));
    add("process_q05", study::column_quantiles(prediction.process, 0.05));
    add("process_q95", study::column_quantiles(prediction.process, 0.95));
    add("measurement_q05", study::column_quantiles(prediction.measurement, 0.05));
    add("measurement_q95", study::column_quantiles(prediction.measurement, 0.95));
}

/// Of single draws of the process, on average over the draws.
double mean_error_of_draws(const Matrix& process, const std::vector<double>& measured) {
    double sum = 0;
    for (std::size_t d = 0; d < process.rows; ++d)
        sum += stats::metrics_of(process.row(d), measured).cv_rmse_n1;
    return sum / static_cast<double>(process.rows);
}

void add_fit(const std::vector<double>& measured, const Prediction& prediction,
             study::DatasetBuilder& datasets) {
    const stats::FitMetrics fit =
        stats::metrics_of(column_means(prediction.mean), measured);
    datasets.scalar("field_cv_rmse", fit.cv_rmse);
    datasets.scalar("field_cv_rmse_n1", fit.cv_rmse_n1);
    datasets.scalar("field_nmbe", fit.nmbe);
    datasets.scalar("field_nmbe_n1", fit.nmbe * fit.n / (fit.n - 1));
    datasets.scalar("field_cv_rmse_n1_of_draws",
                    mean_error_of_draws(prediction.process, measured));
}

void add_coverage(const std::vector<double>& measured, const Prediction& prediction,
                  study::DatasetBuilder& datasets) {
    const auto add = [&](const char* leaf, const Matrix& draws) {
        const stats::Coverage coverage = stats::coverage_of(measured, draws);
        datasets.vector(leaf, "interval", {coverage.inside_50, coverage.inside_90});
    };
    add("process_coverage", prediction.process);
    add("measurement_coverage", prediction.measurement);
}

}  // namespace

void add_koh_results(KohDensity& density, const KohOptions& options,
                     const ChainDraws& draws, study::DatasetBuilder& datasets) {
    const emulator::Observations& o = options.observations;
    const Matrix positions = rows_of(
        draws.positions, study::chosen_rows(draws.positions.rows, options.n_predictive));
    add_form(density, positions, datasets);
    Stream random(options.chains.seed, koh_predictive_stream, 0);
    const Prediction prediction =
        emulator::predict(density, positions, o.measured_x, random);
    add_points(options, prediction, datasets);
    add_fit(o.measured, prediction, datasets);
    add_coverage(o.measured, prediction, datasets);
}

}  // namespace bemcal::posterior
