/// Means, variances and covariances of chains, in two passes; and chains cut into halves.
/// Source: the textbook estimators with n - 1; halves as in Vehtari et al. 2021. Left
/// out: weights, running updates; what is not defined is NaN.
#include "stats/chain_moments.hpp"

#include "base/error.hpp"
#include "base/nan.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::stats {

double mean_of(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double variance_of(std::span<const double> values) {
    return covariance_of(values, values);
}

double covariance_of(std::span<const double> a, std::span<const double> b) {
    require(a.size() == b.size(), "a covariance needs as many of either");
    if (a.size() < 2) return nan;
    const double mean_a = mean_of(a), mean_b = mean_of(b);
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - mean_a) * (b[k] - mean_b);
    return sum / (static_cast<double>(a.size()) - 1);
}

ChainMoments moments_of(const Matrix& draws) {
    ChainMoments moments{static_cast<double>(draws.cols), {}, {}};
    moments.means.reserve(draws.rows);
    moments.variances.reserve(draws.rows);
    for (std::size_t chain = 0; chain < draws.rows; ++chain) {
        moments.means.push_back(mean_of(draws.row(chain)));
        moments.variances.push_back(variance_of(draws.row(chain)));
    }
    return moments;
}

bool is_finite_and_varied(const Matrix& draws) {
    const auto& values = draws.values;
    const auto is_finite = [](double value) { return std::isfinite(value); };
    return std::all_of(values.begin(), values.end(), is_finite) &&
           std::any_of(values.begin(), values.end(),
                       [&values](double value) { return value != values.front(); });
}

Matrix split_chains(const Matrix& draws) {
    const std::size_t half = draws.cols / 2;
    Matrix halves(2 * draws.rows, half);
    for (std::size_t chain = 0; chain < draws.rows; ++chain) {
        const auto row = draws.row(chain);
        std::copy_n(row.begin(), half, halves.row(2 * chain).begin());
        std::copy_n(row.end() - static_cast<std::ptrdiff_t>(half), half,
                    halves.row(2 * chain + 1).begin());
    }
    return halves;
}

}  // namespace bemcal::stats
