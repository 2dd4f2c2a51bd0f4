/// Effective sample size of chains, from their mean autocovariance by FFT and Geyer's
/// initial positive and monotone sequence.
/// Source: Vehtari et al. 2021, eq. 10-13, as posterior 1.4 has it, up to its details for
/// few draws. Chains are not split here: callers do it.
#include "stats/effective_size.hpp"

#include "base/nan.hpp"
#include "stats/chain_moments.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numeric>

#include <unsupported/Eigen/FFT>

namespace bemcal::stats {
namespace {

using Spectrum = std::vector<std::complex<double>>;

/// Adds the squared magnitudes of a chain's spectrum; `padded` is as long as the
/// transform.
void add_power(Eigen::FFT<double>& fft, std::span<const double> chain,
               std::vector<double>& padded, Spectrum& power) {
    const double mean = mean_of(chain);
    std::fill(padded.begin(), padded.end(), 0.0);
    for (std::size_t k = 0; k < chain.size(); ++k) padded[k] = chain[k] - mean;
    Spectrum spectrum;
    fft.fwd(spectrum, padded);
    for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(spectrum[k]);
}

/// Autocorrelations up to where the sum of a pair is no longer positive.
struct InitialSequence {
    std::vector<double> rho;
    std::size_t last;  ///< lag of the pair that ended it
};

/// rho_t = 1 - (W - acov_t) / variance.
class Correlation {
  public:
    explicit Correlation(const Matrix& draws)
        : autocovariance_(mean_autocovariance(draws)) {
        const double n = static_cast<double>(draws.cols);
        within_ = autocovariance_[0] * n / (n - 1);
        variance_ = autocovariance_[0];
        if (draws.rows > 1) variance_ += variance_of(moments_of(draws).means);
    }
    double at(std::size_t lag) const {
        return 1 - (within_ - autocovariance_[lag]) / variance_;
    }

  private:
    std::vector<double> autocovariance_;
    double within_, variance_;
};

InitialSequence initial_positive(const Matrix& draws) {
    const Correlation correlation(draws);
    std::vector<double> rho(draws.cols, 0.0);
    double even = 1, odd = correlation.at(1);
    rho[0] = even;
    rho[1] = odd;
    std::size_t t = 0;
    while (t + 5 < draws.cols && even + odd > 0) {
        t += 2;
        even = correlation.at(t);
        odd = correlation.at(t + 1);
        if (!(even + odd >= 0)) continue;
        rho[t] = even;
        rho[t + 1] = odd;
    }
    if (even > 0) rho[t] = even;  // helps where draws are antithetic
    return {std::move(rho), t};
}

void make_monotone(InitialSequence& sequence) {
    auto& rho = sequence.rho;
    for (std::size_t t = 2; t + 2 <= sequence.last; t += 2) {
        const double before = rho[t - 2] + rho[t - 1];
        if (rho[t] + rho[t + 1] > before) rho[t] = rho[t + 1] = before / 2;
    }
}

}  // namespace

std::vector<double> mean_autocovariance(const Matrix& draws) {
    Eigen::FFT<double> fft;
    std::vector<double> padded(std::bit_ceil(2 * draws.cols));
    Spectrum power(padded.size());
    for (std::size_t chain = 0; chain < draws.rows; ++chain)
        add_power(fft, draws.row(chain), padded, power);
    fft.inv(padded, power);
    padded.resize(draws.cols);
    const double count =
        static_cast<double>(draws.rows) * static_cast<double>(draws.cols);
    for (double& value : padded) value /= count;
    return padded;
}

double effective_size(const Matrix& draws) {
    if (draws.cols < 3 || !is_finite_and_varied(draws)) return nan;
    InitialSequence sequence = initial_positive(draws);
    make_monotone(sequence);
    const auto& rho = sequence.rho;
    // posterior sums over 1:last, which for last = 0 (up to 5 draws) is the first term
    const auto n_terms =
        static_cast<std::ptrdiff_t>(std::max<std::size_t>(sequence.last, 1));
    const double sum = std::accumulate(rho.begin(), rho.begin() + n_terms, 0.0);
    const double size = static_cast<double>(draws.values.size());
    const double tau = -1 + 2 * sum + rho[sequence.last];
    return size / std::max(tau, 1 / std::log10(size));
}

}  // namespace bemcal::stats
