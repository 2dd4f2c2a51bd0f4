/// The fit through an emulator against a plain grid of its own objective, the truth of a
/// made-up simulator, and how often it covers it.
#include "emulator/series_fit.hpp"
#include "emulator/series_model.hpp"
#include "sampling/normal.hpp"
#include "stats/distributions.hpp"

#include <functional>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

const std::vector<ScaledPrior> wide(4, ScaledPrior{0.5, 1});

const SeriesEmulator& of_60_runs() {
    static const SeriesEmulator made(design(60), simulated(design(60)),
                                     reading_weights());
    return made;
}

/// The truth with independent errors of the standard deviations that the weights tell.
std::vector<double> readings_at(std::span<const double> truth,
                                std::span<const double> weights, std::uint64_t seed) {
    std::vector<double> made = exponentials(truth), normals(n_shown);
    Stream random(seed, 0, 0);
    sampling::fill_standard_normal(random, normals);
    for (std::size_t j = 0; j < n_shown; ++j) made[j] += normals[j] / weights[j];
    return made;
}

/// The series' objective with C as a matrix of readings: (1 + B V B')^-1 by Woodbury on
/// plain sums would be the code again, so for one component only, where it is
/// Sherman and Morrison's.
struct PlainObjective {
    const SeriesEmulator& emulator;
    std::span<const double> measured, weights;
    std::span<const ScaledPrior> priors;
    double variance;

    double at(std::span<const double> point) const {
        const std::vector<double> told = emulator.predict(point);
        double square = 0, along = 0, length = 0, prior = 0;
        for (std::size_t j = 0; j < told.size(); ++j) {
            if (weights[j] == 0) continue;
            const double r = weights[j] * (measured[j] - told[j]),
                         b = weights[j] * emulator.parts().components(0, j);
            square += r * r;
            along += r * b;
            length += b * b;
        }
        for (std::size_t k = 0; k < point.size(); ++k)
            prior += std::pow((point[k] - priors[k].mean) / priors[k].sd, 2);
        return (square - variance * along * along / (1 + variance * length) + prior) / 2;
    }
};

TEST(SeriesFit, IsTheLowestPointOfAPlainGrid) {
    // a series of one component: a bent number of two parameters times one profile
    const auto number = [](std::span<const double> x) {
        return std::exp(x[0]) + 0.7 * x[1] * x[1];
    };
    const Matrix points = design(25, 2);
    Matrix series(25, 50);
    std::vector<double> weights(50, 2), measured(50);
    for (std::size_t j = 0; j < 50; ++j) {
        const double profile = 1 + 0.3 * std::sin(static_cast<double>(j));
        for (std::size_t i = 0; i < 25; ++i)
            series(i, j) = profile * number(points.row(i));
        measured[j] = profile * 1.9 + 0.05 * std::cos(3 * static_cast<double>(j));
        if (j % 7 == 3) weights[j] = 0;
    }
    const std::vector<ScaledPrior> priors{{0.3, 0.2}, {0.8, 0.3}};
    const SeriesEmulator emulator(points, series, std::vector<double>(50, 2));
    ASSERT_EQ(emulator.n_components(), 1U);
    const SeriesFit fit = fit_series(emulator, measured, weights, priors);
    const PlainObjective plain{emulator, measured, weights, priors,
                               fit.emulator_variance[0]};
    EXPECT_NEAR(plain.at(fit.point), fit.objective_after, 1e-6 * fit.objective_after);
    std::vector<double> lowest(2);
    constexpr std::size_t n = 400;
    for (std::size_t a = 0; a <= n; ++a)
        for (std::size_t b = 0; b <= n; ++b) {
            const std::vector<double> point{static_cast<double>(a) / n,
                                            static_cast<double>(b) / n};
            if (plain.at(point) < plain.at(lowest)) lowest = point;
        }
    EXPECT_NEAR(fit.point[0], lowest[0], 1.0 / n);
    EXPECT_NEAR(fit.point[1], lowest[1], 1.0 / n);
    EXPECT_LE(fit.objective_after, plain.at(lowest) + 1e-9);
    EXPECT_LT(fit.objective_after, fit.objective_before);
}

TEST(SeriesFit, CovarianceIsTheCurvatureOfItsObjective) {
    const Matrix points = design(25, 1);
    Matrix series(25, 30);
    std::vector<double> weights(30, 5), measured(30);
    for (std::size_t j = 0; j < 30; ++j) {
        const double profile = 1 + 0.1 * static_cast<double>(j);
        for (std::size_t i = 0; i < 25; ++i)
            series(i, j) =
                profile * (1 + points(i, 0) + 0.1 * points(i, 0) * points(i, 0));
        measured[j] = profile * 1.52;
    }
    const std::vector<ScaledPrior> priors{{0.5, 0.5}};
    const SeriesEmulator emulator(points, series, weights);
    const SeriesFit fit = fit_series(emulator, measured, weights, priors);
    const PlainObjective plain{emulator, measured, weights, priors,
                               fit.emulator_variance[0]};
    constexpr double step = 1e-3;
    const auto at = [&](double by) {
        return plain.at(std::vector<double>{fit.point[0] + by});
    };
    const double curvature = (at(step) - 2 * at(0) + at(-step)) / (step * step);
    EXPECT_NEAR(fit.covariance(0, 0) * curvature, 1, 0.02);
}

TEST(SeriesFit, FindsTheTruthOfASimulator) {
    const std::vector<double> truth{0.35, 0.6, 0.4, 0.7};
    const SeriesFit fit =
        fit_series(of_60_runs(), exponentials(truth), reading_weights(), wide);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(fit.point[k], truth[k], 0.02) << k;
    EXPECT_LT(fit.objective_after, 0.05 * fit.objective_before);
}

/// Share of 90 % intervals of 4 parameters that have the truth, in 100 fits. Within a fit
/// they are alike: a standard error of 2 to 3 %.
double coverage_of(const SeriesEmulator& emulator, double weight_factor) {
    constexpr std::size_t n_fits = 100;
    const Matrix truths = design(n_fits, 4, 5);
    std::vector<double> weights = reading_weights();
    for (double& weight : weights) weight *= weight_factor;
    int n_covered = 0;
    for (std::size_t i = 0; i < n_fits; ++i) {
        std::vector<double> truth(4);
        for (std::size_t k = 0; k < 4; ++k) truth[k] = 0.1 + 0.8 * truths(i, k);
        const SeriesFit fit =
            fit_series(emulator, readings_at(truth, weights, i), weights, wide);
        for (std::size_t k = 0; k < 4; ++k)
            n_covered += std::abs(fit.point[k] - truth[k]) <
                         stats::z_90_two_sided * std::sqrt(fit.covariance(k, k));
    }
    return n_covered / (4.0 * n_fits);
}

TEST(SeriesFit, CoversTheTruthAsOftenAsItSaysWhereReadingsScatter) {
    const double coverage = coverage_of(of_60_runs(), 0.1);
    EXPECT_GT(coverage, 0.84);
    EXPECT_LT(coverage, 0.96);
}

/// Without the emulator's variance it is below a half. With it intervals are rather too
/// wide: the simulator is smoother than Matern's process.
TEST(SeriesFit, CoversTheTruthWhereTheEmulatorErrsMoreThanReadings) {
    const SeriesEmulator emulator(design(40), simulated(design(40)), reading_weights());
    const double coverage = coverage_of(emulator, 1);
    EXPECT_GT(coverage, 0.84);
}

TEST(SeriesFit, MissingReadingsAreLeftOut) {
    const std::vector<double> truth{0.35, 0.6, 0.4, 0.7};
    std::vector<double> measured = exponentials(truth), weights = reading_weights();
    const SeriesFit whole = fit_series(of_60_runs(), measured, weights, wide);
    std::vector<double> with_gap = measured;
    for (std::size_t j = 100; j < 300; ++j) {
        with_gap[j] = std::numeric_limits<double>::quiet_NaN();
        measured[j] = 1e6;
        weights[j] = 0;
    }
    const SeriesFit by_nan = fit_series(of_60_runs(), with_gap, reading_weights(), wide),
                    by_weight = fit_series(of_60_runs(), measured, weights, wide);
    EXPECT_EQ(by_nan.point, by_weight.point);
    EXPECT_EQ(by_nan.covariance.values, by_weight.covariance.values);
    EXPECT_NE(by_nan.point, whole.point);
}

TEST(SeriesFit, WhereTheReadingsSayNothingThePriorStays) {
    const std::vector<ScaledPrior> priors{{0.3, 0.1}, {0.8, 0.2}, {0.5, 0.1}, {1.2, 0.1}};
    const Matrix same(6, n_shown, 3.0);
    const SeriesEmulator constant(design(6), same, reading_weights());
    const SeriesFit fit = fit_series(constant, std::vector<double>(n_shown, 4.0),
                                     reading_weights(), priors);
    const std::vector<double> expected{0.3, 0.8, 0.5, 1.0};  // 1.2 is cut at the bound
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(fit.point[k], expected[k], 1e-8);
        EXPECT_NEAR(std::sqrt(fit.covariance(k, k)), priors[k].sd, 1e-8);
    }
}

TEST(SeriesFit, StaysWithinTheBounds) {
    std::vector<double> beyond = exponentials(std::vector<double>{1.2, 0.5, -0.2, 0.5});
    const SeriesFit fit = fit_series(of_60_runs(), beyond, reading_weights(), wide);
    EXPECT_EQ(fit.point[0], 1);
    EXPECT_EQ(fit.point[2], 0);
    for (const double value : fit.covariance.values) EXPECT_TRUE(std::isfinite(value));
}

TEST(SeriesFit, NextPointsBeginWithTheOptimumAndSpreadByTheCovariance) {
    SeriesFit fit;
    fit.point = {0.5, 0.98};
    fit.covariance = Matrix(2, 2);
    fit.covariance.values = {0.01, 0.006, 0.006, 0.01};
    const Matrix points = next_points(fit, 129);
    ASSERT_EQ(points.rows, 129U);
    EXPECT_EQ(points(0, 0), 0.5);
    EXPECT_EQ(points(0, 1), 0.98);
    double square = 0;
    int n_at_bound = 0;
    for (std::size_t i = 1; i < 129; ++i) {
        square += (points(i, 0) - 0.5) * (points(i, 0) - 0.5) / 128;
        n_at_bound += points(i, 1) == 1;
        for (const double value : points.row(i)) {
            EXPECT_GE(value, 0);
            EXPECT_LE(value, 1);
        }
    }
    EXPECT_NEAR(square, 0.0104, 0.001);  // 0.1^2 + 0.02^2
    EXPECT_GT(n_at_bound, 30);           // 0.42 of 128 in the mean
    EXPECT_LT(n_at_bound, 70);
    EXPECT_EQ(next_points(fit, 0).rows, 0U);
    EXPECT_EQ(next_points(fit, 1).values, fit.point);
}

TEST(SeriesFit, RunsAtTheNextPointsBringTheEmulatorCloser) {
    const std::vector<double> truth{0.35, 0.6, 0.4, 0.7}, measured = exponentials(truth);
    Matrix points = design(20), series = simulated(points);
    const auto distance = [&](const SeriesFit& fit) {
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
            sum += (fit.point[k] - truth[k]) * (fit.point[k] - truth[k]);
        return std::sqrt(sum);
    };
    const SeriesFit first = fit_series({points, series, reading_weights()}, measured,
                                       reading_weights(), wide);
    const Matrix more = next_points(first, 8), made = simulated(more);
    points.rows += 8;
    series.rows += 8;
    points.values.insert(points.values.end(), more.values.begin(), more.values.end());
    series.values.insert(series.values.end(), made.values.begin(), made.values.end());
    const SeriesFit second = fit_series({points, series, reading_weights()}, measured,
                                        reading_weights(), wide);
    EXPECT_LT(distance(second), 0.5 * distance(first));
}

TEST(SeriesFit, WhatCannotBeFittedIsRefused) {
    const std::vector<double> measured(n_shown, 1), weights = reading_weights();
    const auto refusal = [&](const std::vector<double>& m, const std::vector<double>& w,
                             const std::vector<ScaledPrior>& p) -> std::string {
        try {
            fit_series(of_60_runs(), m, w, p);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(refusal({1}, weights, wide), "1 readings for an emulator of 1000 numbers");
    EXPECT_EQ(refusal(measured, {1}, wide), "1 weights for 1000 readings");
    EXPECT_EQ(refusal(measured, weights, {{0.5, 1}}), "1 priors for 4 parameters");
    EXPECT_EQ(refusal(measured, weights, {{0.5, 1}, {0.5, 0}, {0.5, 1}, {0.5, 1}}),
              "prior 2 has the sd 0: expected a number above 0");
    EXPECT_EQ(refusal(measured, std::vector<double>(n_shown), wide),
              "no reading has a weight: nothing to fit");
    EXPECT_EQ(refusal(std::vector<double>(n_shown, NAN), weights, wide),
              "no reading has a weight: nothing to fit");
}

}  // namespace
}  // namespace bemcal::emulator::test
