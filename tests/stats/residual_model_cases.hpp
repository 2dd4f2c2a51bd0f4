/// A meter with gaps, points of the residual model side by side, and the dense Gaussian
/// process that the model is, in O(n^3).
#pragma once

#include "base/random.hpp"
#include "stats/residual_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace bemcal::stats::residual_cases {

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// [rows x lanes].
struct Rows {
    std::size_t lanes;
    std::vector<double> values;
    double& operator()(std::size_t row, std::size_t lane) {
        return values[row * lanes + lane];
    }
    double operator()(std::size_t row, std::size_t lane) const {
        return values[row * lanes + lane];
    }
    std::vector<double> lane(std::size_t l) const {
        std::vector<double> column;
        for (std::size_t k = l; k < values.size(); k += lanes)
            column.push_back(values[k]);
        return column;
    }
};

/// Parameters in the order of residual_parameters().
inline Rows some_parameters(const ResidualOptions& options, std::size_t lanes) {
    Rows rows{lanes, std::vector<double>(residual_parameters(options).size() * lanes)};
    Stream stream(4, 0, 0);
    for (std::size_t l = 0; l < lanes; ++l) {
        std::vector<double> point{0.1 + 0.2 * stream.uniform(),
                                  0.05 + 0.2 * stream.uniform()};
        const double phi = 0.3 + 0.65 * stream.uniform();
        const double share = 0.1 + 0.6 * stream.uniform();
        const double timescale = 5 + 40 * stream.uniform();
        if (options.autocorrelated) point.push_back(phi);
        if (options.discrepancy) point.insert(point.end(), {share, timescale});
        for (std::size_t k = 0; k < point.size(); ++k) rows(k, l) = point[k];
    }
    return rows;
}

inline Rows some_predictions(std::size_t n, std::size_t lanes) {
    Rows rows{lanes, std::vector<double>(n * lanes)};
    for (std::size_t l = 0; l < lanes; ++l)
        for (std::size_t t = 0; t < n; ++t)
            rows(t, l) = 10 + 8 * std::sin(0.26 * static_cast<double>(t)) +
                         0.3 * static_cast<double>(l);
    return rows;
}

/// Readings about some_predictions(), some of them missing: the first, a few single ones
/// and two long stretches.
inline std::vector<double> some_readings(std::size_t n, bool has_gaps) {
    const std::vector<double> prediction = some_predictions(n, 1).values;
    std::vector<double> readings;
    Stream stream(5, 0, 0);
    double slow = 0;
    for (std::size_t t = 0; t < n; ++t) {
        slow = 0.9 * slow + 0.8 * (stream.uniform() - 0.5);
        readings.push_back(prediction[t] * (1 + 0.2 * slow) + stream.uniform() - 0.3);
    }
    if (!has_gaps) return readings;
    for (const std::size_t from : {0, 1, 17, 18, 40, 42, 90})
        if (from < n) readings[from] = missing;
    for (std::size_t t = n / 2; t < n / 2 + n / 10; ++t) readings[t] = missing;
    for (std::size_t t = 3 * n / 4; t < 3 * n / 4 + 5; ++t) readings[t] = missing;
    return readings;
}

/// Meter unit of the constant part in all cases.
inline constexpr double unit = 8;

/// Parameters by name; what the options leave out has no effect.
struct Point {
    double constant, proportional, phi = 0, share = 0, timescale = 1;
};
inline Point point_of(const ResidualOptions& options, const std::vector<double>& values) {
    Point point{values[0], values[1]};
    std::size_t next = 2;
    if (options.autocorrelated) point.phi = values[next++];
    if (options.discrepancy) {
        point.share = values[next++];
        point.timescale = values[next];
    }
    return point;
}

inline double scale_at(const Point& point, double f) {
    return std::hypot(point.constant * unit, point.proportional * f);
}

/// Correlation of two scaled residuals this far apart.
inline double correlation_at(const Point& point, std::size_t distance) {
    const auto d = static_cast<double>(distance);
    const double near = distance == 0 ? 1 : std::pow(point.phi, d);
    const double r = std::sqrt(3.0) * d / point.timescale;
    return (1 - point.share) * near + point.share * (1 + r) * std::exp(-r);
}

/// By Cholesky's factors of the covariance of the readings that are there.
inline double dense_log_likelihood(const std::vector<double>& readings,
                                   const std::vector<double>& prediction,
                                   const Point& point) {
    std::vector<std::size_t> times;
    for (std::size_t t = 0; t < readings.size(); ++t)
        if (!std::isnan(readings[t])) times.push_back(t);
    const std::size_t n = times.size();
    std::vector<double> lower(n * n), white(n);
    double sum = -0.5 * static_cast<double>(n) * std::log(2 * std::numbers::pi);
    for (std::size_t i = 0; i < n; ++i) {
        const double s = scale_at(point, prediction[times[i]]);
        const auto left_of = [&](std::size_t row, const std::vector<double>& other,
                                 std::size_t start, std::size_t count) {
            double product = 0;
            for (std::size_t k = 0; k < count; ++k)
                product += lower[row * n + k] * other[start + k];
            return product;
        };
        for (std::size_t j = 0; j <= i; ++j) {
            const double covariance = s * scale_at(point, prediction[times[j]]) *
                                      correlation_at(point, times[i] - times[j]);
            const double rest = covariance - left_of(i, lower, j * n, j);
            lower[i * n + j] = i == j ? std::sqrt(rest) : rest / lower[j * n + j];
        }
        const double r = readings[times[i]] - prediction[times[i]];
        white[i] = (r - left_of(i, white, 0, i)) / lower[i * n + i];
        sum -= std::log(lower[i * n + i]) + 0.5 * white[i] * white[i];
    }
    return sum;
}

/// One call of log_likelihood.
struct Answer {
    std::vector<double> values;
    Rows by_prediction, by_parameter;
};
inline Answer answer_of(const ResidualModel& model, const Rows& predictions,
                        const Rows& parameters) {
    const std::size_t lanes = predictions.lanes;
    Answer answer{std::vector<double>(lanes),
                  {lanes, std::vector<double>(predictions.values.size(), missing)},
                  {lanes, std::vector<double>(parameters.values.size(), missing)}};
    ResidualModel::Work work;
    model.log_likelihood(predictions.values.data(), parameters.values.data(),
                         static_cast<int>(lanes), answer.values.data(),
                         answer.by_prediction.values.data(),
                         answer.by_parameter.values.data(), work);
    return answer;
}

inline double value_of(const ResidualModel& model, const std::vector<double>& prediction,
                       const std::vector<double>& parameters) {
    ResidualModel::Work work;
    double value = 0;
    model.log_likelihood(prediction.data(), parameters.data(), 1, &value, nullptr,
                         nullptr, work);
    return value;
}

}  // namespace bemcal::stats::residual_cases
