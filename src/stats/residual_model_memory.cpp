/// The log density of scaled residuals that are white or AR(1), with slopes by each
/// residual and by phi; over a gap of g intervals the correlation is phi^g.
/// Source: textbook, stationary start. Negative correlation and slow parts are left out:
/// the latter are residual_model_filter's.
#include "stats/residual_model_memory.hpp"

#include <vector>

namespace bemcal::stats::residual {

Power power_of(const Lanes& phi, std::size_t n) {
    Lanes below = all(1), square = phi;  // phi^(n - 1)
    for (std::size_t left = n - 1; left > 0; left /= 2) {
        if (left % 2 == 1) below *= square;
        square *= square;
    }
    return {below * phi, below * static_cast<double>(n)};
}

Lanes white_log_density(std::size_t n_present, const Scaled& scaled) {
    Lanes sum = all(0);
    for (std::size_t t = 0; t < n_present; ++t) {
        const Lanes z = row(scaled.z, t);
        sum += z * z;
        row(scaled.slope, t) = -z;
    }
    return -0.5 * sum;
}

namespace {

/// From one reading to the next: e = z - rho (z before) has the variance 1 - rho^2.
struct Step {
    Lanes rho, slope, precision;
    Lanes squares = all(0), products = all(0);  ///< sums of e^2 and of e (z before)
    double count = 0;

    explicit Step(const Power& power)
        : rho(power.value),
          slope(power.slope),
          precision(((1 - rho) * (1 + rho)).inverse()) {}

    Lanes log_density() const {
        return 0.5 * (count * precision.log() - precision * squares);
    }
    Lanes by_phi() const {
        const Lanes by_variance = count - precision * squares;
        return slope * precision * (products + rho * by_variance);
    }
};

/// Where the pass over the readings stands: the last z, and its slope so far.
struct Before {
    Lanes z = all(0), slope = all(0);
};

void advance(std::size_t begin, std::size_t end, const Scaled& scaled, Step& step,
             Before& before) {
    const Lanes rho = step.rho, precision = step.precision;
    Lanes squares = step.squares, products = step.products, last = before.z;
    Lanes slope = before.slope;
    for (std::size_t t = begin; t < end; ++t) {
        const Lanes z = row(scaled.z, t);
        const Lanes e = z - rho * last;
        const Lanes scaled_e = precision * e;
        squares += e * e;
        products += e * last;
        if (t > 0) row(scaled.slope, t - 1) = slope + rho * scaled_e;
        slope = -scaled_e;
        last = z;
    }
    step.squares = squares;
    step.products = products;
    step.count += static_cast<double>(end - begin);
    before = {last, slope};
}

std::vector<Step> steps_of(const ReadingTimes& times, const Lanes& phi) {
    std::vector<Step> steps;
    steps.reserve(times.gaps.size());
    steps.emplace_back(Power{all(0), all(0)});
    for (std::size_t k = ReadingTimes::unit; k < times.gaps.size(); ++k)
        steps.emplace_back(power_of(phi, times.gaps[k]));
    return steps;
}

}  // namespace

Ar1Density ar1_log_density(const ReadingTimes& times, const Lanes& phi,
                           const Scaled& scaled) {
    std::vector<Step> steps = steps_of(times, phi);
    Before before;
    for (const auto& stretch : times.stretches) {
        advance(stretch.begin, stretch.begin + 1, scaled, steps[stretch.gap], before);
        advance(stretch.begin + 1, stretch.end, scaled, steps[ReadingTimes::unit],
                before);
    }
    row(scaled.slope, times.n_present() - 1) = before.slope;
    Ar1Density density{all(0), all(0)};
    for (const Step& step : steps) {
        density.value += step.log_density();
        density.by_phi += step.by_phi();
    }
    return density;
}

}  // namespace bemcal::stats::residual
