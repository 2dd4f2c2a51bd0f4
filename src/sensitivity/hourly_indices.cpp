/// Adds up the sums of blocks to indices of every step and of the series, with 95 %
/// intervals by the jackknife over blocks.
/// Source: Lamboni, Monod and Makowski 2011 for the series (generalised indices).
/// Where nothing varies an index is NaN. Student's t keeps 31 degrees of freedom, also
/// where blocks have failed.
#include "sensitivity/hourly_indices.hpp"

#include "base/nan.hpp"

#include <algorithm>
#include <cmath>

namespace bemcal::sensitivity {
namespace {

constexpr double t_975_31 = 2.0395134463964077;  ///< Student's t, 31 degrees of freedom

/// Half width of the 95 % jackknife interval.
double jackknife_half_width(const std::vector<double>& without) {
    const double n = static_cast<double>(without.size());
    double sum = 0, square = 0;
    for (const double value : without) sum += value;
    for (const double value : without) square += std::pow(value - sum / n, 2);
    return t_975_31 * std::sqrt((n - 1) / n * square);
}

void add_to(StepEstimate& sum, const StepEstimate& step) {
    sum.parts.resize(step.parts.size(), 0.0);
    sum.variance += step.variance;
    for (std::size_t k = 0; k < step.parts.size(); ++k) sum.parts[k] += step.parts[k];
}

}  // namespace

Blocks::Blocks(const std::vector<study::ItemAnswer>& answers, std::size_t n_steps,
               std::size_t dimension)
    : n_steps_(n_steps), n_terms_(HourlySums::n_terms(dimension)) {
    for (const study::ItemAnswer& answer : answers)
        if (answer.error.empty() && answer.values[0] > 0)
            blocks_.push_back(&answer.values);
    for (const auto* block : blocks_) n_ += (*block)[0];
}

double Blocks::shift(std::size_t step) const {
    return blocks_.empty() ? nan : (*blocks_[0])[1 + step];
}

StepEstimates Blocks::at(std::size_t step) const {
    std::vector<double> all(n_terms_, 0.0), rest(n_terms_);
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        for (std::size_t k = 0; k < n_terms_; ++k) all[k] += term(b, k, step);
    StepEstimates found{estimate(all, n_), {}};
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        for (std::size_t k = 0; k < n_terms_; ++k) rest[k] = all[k] - term(b, k, step);
        found.without.push_back(estimate(rest, n_ - (*blocks_[b])[0]));
    }
    return found;
}

void add_to(StepEstimates& sum, const StepEstimates& step) {
    sum.without.resize(step.without.size());
    add_to(sum.all, step.all);
    for (std::size_t b = 0; b < step.without.size(); ++b)
        add_to(sum.without[b], step.without[b]);
}

Indices indices_of(const StepEstimates& estimates, double shift) {
    const std::size_t n = estimates.all.parts.size();
    Indices found{std::vector<double>(n, nan), std::vector<double>(n, nan)};
    const double mean = shift + estimates.all.mean;
    if (!(estimates.all.variance > 1e-24 * mean * mean)) return found;
    std::vector<double> without(estimates.without.size());
    for (std::size_t k = 0; k < n; ++k) {
        found.values[k] = estimates.all.parts[k] / estimates.all.variance;
        std::ranges::transform(
            estimates.without, without.begin(),
            [k](const StepEstimate& rest) { return rest.parts[k] / rest.variance; });
        found.half_widths[k] = jackknife_half_width(without);
    }
    return found;
}

}  // namespace bemcal::sensitivity
