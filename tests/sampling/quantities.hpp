/// Means over chains with errors that allow for their autocorrelation.
#pragma once

#include "sampling/chains.hpp"

#include <cmath>
#include <functional>

namespace bemcal::test {

/// Warm-up and one round of so many chains.
inline std::vector<sampling::ChainPart> sample(sampling::Density& density,
                                               const sampling::SamplerOptions& options,
                                               std::uint32_t n_chains, int n_draws,
                                               std::uint64_t seed = 1) {
    std::vector<sampling::ChainTask> tasks;
    for (std::uint32_t chain = 0; chain < n_chains; ++chain)
        tasks.push_back({seed, chain, 0, {}});
    const auto warm = sampling::run_chains(density, options, tasks, 0);
    for (std::uint32_t chain = 0; chain < n_chains; ++chain) {
        tasks[chain].round = 1;
        tasks[chain].state = warm[chain].state;
    }
    return sampling::run_chains(density, options, tasks, n_draws);
}

struct Estimate {
    double mean = 0, error = 0, ess = 0;
};

using Quantity = std::function<double(std::span<const double>)>;

/// By batch means: 50 batches a chain, so the error has some 50 n_chains - 1 degrees of
/// freedom and (mean - truth) / error is near normal.
inline Estimate estimate(const std::vector<sampling::ChainPart>& parts,
                         const Quantity& quantity) {
    constexpr std::size_t n_batches = 50;
    std::vector<double> batches;
    double sum = 0, squares = 0, n = 0;
    for (const sampling::ChainPart& part : parts) {
        const std::size_t size = part.draws.rows / n_batches;
        for (std::size_t b = 0; b < n_batches; ++b) {
            double batch = 0;
            for (std::size_t i = 0; i < size; ++i) {
                const double q = quantity(part.draws.row(b * size + i));
                batch += q;
                squares += q * q;
            }
            sum += batch;
            n += static_cast<double>(size);
            batches.push_back(batch / static_cast<double>(size));
        }
    }
    const double mean = sum / n;
    double scatter = 0;
    for (const double b : batches) scatter += (b - mean) * (b - mean);
    const auto m = static_cast<double>(batches.size());
    const double error = std::sqrt(scatter / (m - 1) / m);
    return {mean, error, (squares / n - mean * mean) / (error * error)};
}

/// (mean - truth) / error.
inline double z_score(const std::vector<sampling::ChainPart>& parts, double truth,
                      const Quantity& quantity) {
    const Estimate e = estimate(parts, quantity);
    return (e.mean - truth) / e.error;
}

}  // namespace bemcal::test
