/// First- and total-order indices. With outputs standardised each is a ratio of sums over
/// base points; a bootstrap resample is a sum of their terms with whole-number weights.
/// Source: Saltelli et al. 2010, table 2 (b) and (f). Plain loops in place of a library's
/// matrix product, whose bits depend on the machine. Left out: second order; base points
/// with a failed row.
#include "base/error.hpp"
#include "base/nan.hpp"
#include "base/random.hpp"
#include "stats/saltelli.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace bemcal::stats {
namespace {

constexpr double normal_975 = 1.959963984540054;  ///< 97.5 % quantile
constexpr std::uint32_t bootstrap_stream = 0x424F4F54;
constexpr std::size_t n_abreast = 4;  ///< resamples summed in one pass over the terms

/// Rows of the design whose outputs are all finite. \return [n_used x d + 2]
Matrix whole_base_points(const std::vector<double>& outputs, std::size_t n_rows) {
    Matrix kept(0, n_rows);
    for (std::size_t begin = 0; begin + n_rows <= outputs.size(); begin += n_rows) {
        const std::span row(outputs.data() + begin, n_rows);
        if (!std::ranges::all_of(row, [](double y) { return std::isfinite(y); }))
            continue;
        kept.values.insert(kept.values.end(), row.begin(), row.end());
        ++kept.rows;
    }
    return kept;
}

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments_of(std::span<const double> values) {
    double sum = 0, square = 0;
    for (const double y : values) sum += y;
    const double mean = sum / static_cast<double>(values.size());
    for (const double y : values) square += (y - mean) * (y - mean);
    return {mean, square / static_cast<double>(values.size())};
}

/// Columns: B (AB_i - A) for each i, (A - AB_i)^2 for each i, A + B, A^2 + B^2.
Matrix terms_of(const Matrix& outputs, const Moments& moments) {
    const std::size_t d = outputs.cols - 2;
    const double scale = 1 / std::sqrt(moments.variance);
    Matrix terms(outputs.rows, 2 * d + 2);
    for (std::size_t j = 0; j < outputs.rows; ++j) {
        const auto y = outputs.row(j);
        const auto term = terms.row(j);
        const double a = (y[0] - moments.mean) * scale,
                     b = (y[d + 1] - moments.mean) * scale;
        for (std::size_t i = 0; i < d; ++i) {
            const double difference = (y[1 + i] - y[0]) * scale;
            term[i] = b * difference;
            term[d + i] = difference * difference;
        }
        term[2 * d] = a + b;
        term[2 * d + 1] = a * a + b * b;
    }
    return terms;
}

/// Variance over the rows A and B, from sums of the last two terms over n base points.
double variance_of(std::span<const double> sums, double n) {
    const double mean = sums[sums.size() - 2] / (2 * n);
    return sums.back() / (2 * n) - mean * mean;
}

/// Turns sums of terms over n base points into [first order, total order] in place.
void indices_from_sums(std::span<double> sums, double n) {
    const double variance = variance_of(sums, n);
    const std::size_t d = (sums.size() - 2) / 2;
    for (std::size_t i = 0; i < d; ++i) {
        sums[i] /= n * variance;
        sums[d + i] /= 2 * n * variance;
    }
}

std::vector<double> sum_of(const Matrix& terms) {
    std::vector<double> sums(terms.cols, 0.0);
    for (std::size_t j = 0; j < terms.rows; ++j)
        for (std::size_t k = 0; k < terms.cols; ++k) sums[k] += terms(j, k);
    return sums;
}

using Weights = std::array<double, n_abreast>;  ///< of one base point in each resample

/// How often each base point is drawn in resamples [first, first + n_abreast).
std::vector<Weights> draw_weights(std::size_t n, std::size_t first, std::uint64_t seed) {
    std::vector<Weights> weights(n, Weights{});
    for (std::size_t r = 0; r < n_abreast; ++r) {
        Stream random(seed, bootstrap_stream, first + r);
        for (std::size_t draw = 0; draw < n; ++draw)
            weights[random.below(static_cast<std::uint32_t>(n))][r] += 1;
    }
    return weights;
}

/// In blocks of a fixed size, which the compiler turns into vector instructions.
void add_scaled(std::span<const double> term, double weight, double* sum) {
    constexpr std::size_t block = 8;
    std::size_t k = 0;
    for (; k + block <= term.size(); k += block)
        for (std::size_t i = 0; i < block; ++i) sum[k + i] += weight * term[k + i];
    for (; k < term.size(); ++k) sum[k] += weight * term[k];
}

/// Weighted sums of the terms. \return [n_abreast x terms.cols]
Matrix weighted_sums(const Matrix& terms, const std::vector<Weights>& weights) {
    Matrix sums(n_abreast, terms.cols);
    for (std::size_t j = 0; j < terms.rows; ++j)
        for (std::size_t r = 0; r < n_abreast; ++r)
            add_scaled(terms.row(j), weights[j][r], sums.row(r).data());
    return sums;
}

/// Indices of each resample. \return [n_bootstrap x 2 d + 2]
Matrix bootstrap(const Matrix& terms, std::size_t n_bootstrap, std::uint64_t seed) {
    Matrix resamples(n_bootstrap, terms.cols);
    for (std::size_t first = 0; first < n_bootstrap; first += n_abreast) {
        Matrix sums = weighted_sums(terms, draw_weights(terms.rows, first, seed));
        for (std::size_t r = 0; r < std::min(n_abreast, n_bootstrap - first); ++r) {
            indices_from_sums(sums.row(r), static_cast<double>(terms.rows));
            std::ranges::copy(sums.row(r), resamples.row(first + r).begin());
        }
    }
    return resamples;
}

double half_width(const Matrix& resamples, std::size_t column) {
    if (resamples.rows < 2) return nan;
    std::vector<double> values(resamples.rows);
    for (std::size_t r = 0; r < resamples.rows; ++r) values[r] = resamples(r, column);
    const double n = static_cast<double>(resamples.rows);
    return normal_975 * std::sqrt(moments_of(values).variance * n / (n - 1));
}

/// The output's spread is rounding only.
bool is_constant(const Moments& moments) {
    return !(moments.variance > 1e-24 * moments.mean * moments.mean);
}

Moments moments_of_a_and_b(const Matrix& outputs) {
    std::vector<double> both;
    for (std::size_t j = 0; j < outputs.rows; ++j)
        both.insert(both.end(), {outputs(j, 0), outputs(j, outputs.cols - 1)});
    return moments_of(both);
}

}  // namespace

SobolIndices sobol_indices(const std::vector<double>& outputs, int dimension,
                           int n_bootstrap, std::uint64_t seed) {
    const auto d = static_cast<std::size_t>(dimension);
    require(outputs.size() % (d + 2) == 0, "outputs are not whole base points");
    const std::vector<double> unknown(d, nan);
    SobolIndices found{unknown, unknown, unknown, unknown, nan, nan, 0, true};
    const Matrix used = whole_base_points(outputs, d + 2);
    found.n_used = static_cast<int>(used.rows);
    if (used.rows < 2) return found;
    const Moments moments = moments_of(used.values),
                  of_a_and_b = moments_of_a_and_b(used);
    found.mean = moments.mean;
    found.variance = of_a_and_b.variance;
    found.degenerate = is_constant(of_a_and_b);
    if (found.degenerate) return found;

    const Matrix terms = terms_of(used, moments);
    std::vector<double> indices = sum_of(terms);
    indices_from_sums(indices, static_cast<double>(used.rows));
    const Matrix resamples =
        bootstrap(terms, static_cast<std::size_t>(n_bootstrap), seed);
    for (std::size_t i = 0; i < d; ++i) {
        found.first_order[i] = indices[i];
        found.total_order[i] = indices[d + i];
        found.first_half_width[i] = half_width(resamples, i);
        found.total_half_width[i] = half_width(resamples, d + i);
    }
    return found;
}

}  // namespace bemcal::stats
