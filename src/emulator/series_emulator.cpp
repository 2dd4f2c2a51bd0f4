/// A series from its scores, and back from the runs to the processes of the scores.
/// Source: Higdon, Gattiker, Williams and Rightley 2008; scores are taken one by one, not
/// jointly. Left out: what the components leave out has no process of its own.
#include "emulator/series_emulator.hpp"

#include "emulator/eigen_views.hpp"
#include "emulator/fold_check.hpp"
#include "emulator/refusals.hpp"

#include <algorithm>
#include <utility>

namespace bemcal::emulator {
namespace {

/// Of the runs' variance: a score that carries more has scales of its own, the others
/// share theirs, for alone they would take noise for bends.
constexpr double share_of_own = 0.003;
constexpr std::size_t least_runs = 2;  ///< one run tells nothing of any parameter

void check_series_runs(const Matrix& points, const Matrix& series,
                       std::span<const double> weights) {
    refuse_if(points.rows < least_runs,
              "{} runs of the simulator: an emulator needs at least {}", points.rows,
              least_runs);
    refuse_if(points.cols == 0, "the runs have no parameters: expected at least 1");
    refuse_if(series.rows != points.rows, "{} points of runs, but {} series", points.rows,
              series.rows);
    refuse_if(series.cols == 0, "the series are empty");
    refuse_if(weights.size() != series.cols, "{} weights for {} numbers of a series",
              weights.size(), series.cols);
    refuse_not_finite(points.values, points.cols, "points");
    refuse_not_finite(series.values, series.cols, "series");
    refuse_not_finite(weights, weights.size(), "weights");
}

void check_scales(const Matrix& points, std::span<const double> weights) {
    for (std::size_t i = 0; i < points.values.size(); ++i)
        refuse_if(points.values[i] < 0 || points.values[i] > 1,
                  "points: row {}, column {} is {}: expected a number from 0 to 1",
                  i / points.cols + 1, i % points.cols + 1, points.values[i]);
    double most = 0;
    for (std::size_t j = 0; j < weights.size(); ++j) {
        refuse_if(weights[j] < 0, "weight {} is {}: expected 0 or more", j + 1,
                  weights[j]);
        most = std::max(most, weights[j]);
    }
    refuse_if(most == 0, "all weights are 0: no number of the series is of interest");
}

void check_channels(std::span<const ChannelRange> channels, std::size_t n) {
    std::size_t end = 0;
    for (const ChannelRange& channel : channels) {
        refuse_if(channel.first != end || channel.size == 0 || channel.size > n - end,
                  "a channel of {} numbers from {} on: expected one from {} on, in a "
                  "series of {}",
                  channel.size, channel.first, end, n);
        end += channel.size;
    }
    refuse_if(!channels.empty() && end != n, "channels of {} numbers, in a series of {}",
              end, n);
}

Matrix columns_of(const Matrix& series, const ChannelRange& channel) {
    Matrix made(series.rows, channel.size);
    for (std::size_t i = 0; i < series.rows; ++i)
        std::ranges::copy(series.row(i).subspan(channel.first, channel.size),
                          made.row(i).begin());
    return made;
}

/// All 1 where none is above 0: its runs are to be learned all the same.
std::vector<double> weights_within(std::span<const double> weights,
                                   const ChannelRange& channel) {
    const auto own = weights.subspan(channel.first, channel.size);
    if (std::ranges::all_of(own, [](double weight) { return weight == 0; }))
        return std::vector<double>(channel.size, 1.0);
    return {own.begin(), own.end()};
}

/// A channel's components beside others, 0 outside it.
void join(const SeriesComponents& own, std::size_t first, SeriesComponents& all) {
    const auto at = static_cast<std::ptrdiff_t>(first);
    std::ranges::copy(own.mean, all.mean.begin() + at);
    for (std::size_t i = 0; i < own.remainder.rows; ++i)
        std::ranges::copy(own.remainder.row(i), all.remainder.row(i).begin() + at);
    for (std::size_t c = 0; c < own.components.rows; ++c) {
        std::vector<double> component(all.mean.size());
        std::ranges::copy(own.components.row(c), component.begin() + at);
        all.components.add_row(component);
        all.scores.add_row(own.scores.row(c));
    }
}

/// Rows [first, last).
Matrix some_rows(const Matrix& matrix, std::size_t first, std::size_t last) {
    Matrix made(last - first, matrix.cols);
    std::copy(matrix.row(first).data(), matrix.row(first).data() + made.values.size(),
              made.values.begin());
    return made;
}

/// Of each score.
std::vector<ScoreScales> scales_of(const Matrix& points, const Matrix& scores) {
    const double total = eigen_view(scores).squaredNorm();
    std::vector<ScoreScales> made;
    std::size_t c = 0;
    for (; c < scores.rows &&
           eigen_view(scores.row(c)).squaredNorm() >= share_of_own * total;
         ++c)
        made.push_back(learn_scales(points, some_rows(scores, c, c + 1)));
    if (c < scores.rows)
        made.resize(scores.rows, learn_scales(points, some_rows(scores, c, scores.rows)));
    return made;
}

}  // namespace

SeriesEmulator::SeriesEmulator(const Matrix& points, Matrix series,
                               std::span<const double> weights, double share,
                               std::span<const ChannelRange> channels)
    : points_(points) {
    check_series_runs(points, series, weights);
    check_scales(points, weights);
    check_channels(channels, series.cols);
    if (channels.empty()) {
        parts_ = components_of(std::move(series), weights, share);
        learn(parts_);
        return;
    }
    parts_.mean.resize(series.cols);
    parts_.components = Matrix(0, series.cols);
    parts_.scores = Matrix(0, series.rows);
    parts_.remainder = Matrix(series.rows, series.cols);
    for (const ChannelRange& channel : channels) {
        const auto own = components_of(columns_of(series, channel),
                                       weights_within(weights, channel), share);
        learn(own);
        join(own, channel.first, parts_);
    }
}

void SeriesEmulator::learn(const SeriesComponents& parts) {
    const std::vector<ScoreScales> scales = scales_of(points_, parts.scores);
    const std::vector<double> factors = variance_factors(points_, parts.gram, scales);
    for (std::size_t c = 0; c < scales.size(); ++c) {
        processes_.emplace_back(points_, parts.scores.row(c), scales[c]);
        processes_.back().multiply_variance(factors[c]);
    }
}

void SeriesEmulator::check_point(std::span<const double> point) const {
    refuse_if(point.size() != n_parameters(), "a point of {} parameters, expected {}",
              point.size(), n_parameters());
    refuse_not_finite(point, point.size(), "point");
}

std::vector<double> SeriesEmulator::scores(std::span<const double> point) const {
    check_point(point);
    std::vector<double> made;
    made.reserve(n_components());
    for (const ScoreProcess& process : processes_) made.push_back(process.mean(point));
    return made;
}

Matrix SeriesEmulator::score_jacobian(std::span<const double> point) const {
    check_point(point);
    Matrix made(n_components(), n_parameters());
    for (std::size_t c = 0; c < n_components(); ++c)
        std::ranges::copy(processes_[c].gradient(point), made.row(c).begin());
    return made;
}

std::vector<double> SeriesEmulator::variance(std::span<const double> point) const {
    check_point(point);
    std::vector<double> made;
    made.reserve(n_components());
    for (const ScoreProcess& process : processes_)
        made.push_back(process.variance(point));
    return made;
}

std::vector<double> SeriesEmulator::predict(std::span<const double> point) const {
    const std::vector<double> at_point = scores(point);
    std::vector<double> series = parts_.mean;
    eigen_view(std::span<double>(series)).noalias() +=
        eigen_view(parts_.components).transpose() *
        eigen_view(std::span<const double>(at_point));
    return series;
}

Matrix SeriesEmulator::jacobian(std::span<const double> point) const {
    const Matrix of_scores = score_jacobian(point);
    Matrix made(n_numbers(), n_parameters());
    eigen_view(made).noalias() =
        eigen_view(parts_.components).transpose() * eigen_view(of_scores);
    return made;
}

std::vector<double> SeriesEmulator::leave_one_out(
    std::span<const ChannelRange> channels) const {
    for (const ChannelRange& channel : channels)
        refuse_if(channel.size == 0 || channel.first > n_numbers() ||
                      channel.size > n_numbers() - channel.first,
                  "a channel of {} numbers from {} on, in a series of {}", channel.size,
                  channel.first, n_numbers());
    Matrix errors(n_components(), n_runs());
    for (std::size_t c = 0; c < n_components(); ++c)
        std::ranges::copy(processes_[c].leave_one_out(), errors.row(c).begin());
    const auto mean = eigen_view(std::span<const double>(parts_.mean));
    std::vector<double> squares(channels.size()), sizes(channels.size());
    for (std::size_t i = 0; i < n_runs(); ++i) {
        const Eigen::Index run = eigen_index(i);
        const auto rest = eigen_view(parts_.remainder).row(run).transpose();
        const auto components = eigen_view(parts_.components).transpose();
        const Eigen::VectorXd error = rest + components * eigen_view(errors).col(run);
        const Eigen::VectorXd shown =
            mean + rest + components * eigen_view(parts_.scores).col(run);
        for (std::size_t k = 0; k < channels.size(); ++k) {
            const Eigen::Index first = eigen_index(channels[k].first),
                               size = eigen_index(channels[k].size);
            squares[k] += error.segment(first, size).squaredNorm();
            sizes[k] += shown.segment(first, size).lpNorm<1>();
        }
    }
    std::vector<double> percents(channels.size(), 0.0);
    for (std::size_t k = 0; k < channels.size(); ++k) {
        const double n = static_cast<double>(n_runs() * channels[k].size);
        if (sizes[k] > 0) percents[k] = 100 * std::sqrt(squares[k] / n) / (sizes[k] / n);
    }
    return percents;
}

}  // namespace bemcal::emulator
