/// The emulator of series against the simulator that it learned from, differences, and
/// really leaving out.
#include "emulator/fold_check.hpp"
#include "emulator/series_emulator.hpp"
#include "emulator/series_model.hpp"

#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

const SeriesEmulator& of_40_runs() {
    static const SeriesEmulator made(design(40), simulated(design(40)),
                                     reading_weights());
    return made;
}

double norm_of(std::span<const double> values) {
    return std::sqrt(
        std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
}

double sum_of_squares(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t j = 0; j < a.size(); ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
    return sum;
}

/// Over rows of points the emulator has not seen. [%]
std::vector<double> cv_rmse_at(const SeriesEmulator& emulator, const Matrix& points) {
    std::vector<double> squares(2), sums(2), made;
    for (std::size_t i = 0; i < points.rows; ++i) {
        const std::vector<double> truth = exponentials(points.row(i)),
                                  told = emulator.predict(points.row(i));
        for (std::size_t c = 0; c < 2; ++c) {
            const std::span<const double> t(truth.data() + c * n_hours, n_hours);
            squares[c] += sum_of_squares(t, {told.data() + c * n_hours, n_hours});
            sums[c] += std::accumulate(t.begin(), t.end(), 0.0);
        }
    }
    const double n = static_cast<double>(points.rows * n_hours);
    for (std::size_t c = 0; c < 2; ++c)
        made.push_back(100 * std::sqrt(squares[c] / n) / (sums[c] / n));
    return made;
}

std::string refusal_of(const Matrix& points, const Matrix& series,
                       const std::vector<double>& weights) {
    try {
        SeriesEmulator(points, series, weights);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

void expect_finite(const SeriesEmulator& emulator, std::span<const double> point) {
    for (const double value : emulator.predict(point)) ASSERT_TRUE(std::isfinite(value));
    for (const double value : emulator.jacobian(point).values)
        ASSERT_TRUE(std::isfinite(value));
    for (const double value : emulator.variance(point)) {
        ASSERT_TRUE(std::isfinite(value));
        ASSERT_GE(value, 0);
    }
    const ChannelRange all{0, emulator.n_numbers()};
    ASSERT_TRUE(std::isfinite(emulator.leave_one_out({&all, 1})[0]));
}

TEST(SeriesEmulator, AtARunItGivesThatRunUpToNuggetAndComponents) {
    const SeriesEmulator& emulator = of_40_runs();
    double squares = 0, spread = 0;
    for (std::size_t i = 0; i < 40; ++i) {
        const std::vector<double> scores = emulator.scores(emulator.points().row(i));
        for (std::size_t c = 0; c < emulator.n_components(); ++c)
            EXPECT_NEAR(scores[c], emulator.parts().scores(c, i),
                        1e-3 * norm_of(emulator.parts().scores.row(c)))
                << c;
        const std::vector<double> weights = reading_weights();
        std::vector<double> error = emulator.predict(emulator.points().row(i)),
                            away = exponentials(emulator.points().row(i));
        for (std::size_t j = 0; j < n_shown; ++j) {
            error[j] = weights[j] * (error[j] - away[j]);
            away[j] = weights[j] * (away[j] - emulator.parts().mean[j]);
        }
        squares += norm_of(error) * norm_of(error);
        spread += norm_of(away) * norm_of(away);
    }
    EXPECT_LT(squares, 1.01e-4 * spread);  // components carry 99.99 % of the variance
}

TEST(SeriesEmulator, ForetellsPointsItHasNotSeenWithin3Percent) {
    const std::vector<double> errors = cv_rmse_at(of_40_runs(), design(200, 4, 77));
    for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_LT(errors[c], 3);
        EXPECT_GT(errors[c], 0);
    }
}

TEST(SeriesEmulator, ComponentsAreOrthonormalInTheWeights) {
    const Matrix& components = of_40_runs().parts().components;
    const std::vector<double> weights = reading_weights();
    ASSERT_GT(components.rows, 2U);
    for (std::size_t a = 0; a < components.rows; ++a)
        for (std::size_t b = 0; b <= a; ++b) {
            double sum = 0;
            for (std::size_t j = 0; j < n_shown; ++j)
                sum += weights[j] * weights[j] * components(a, j) * components(b, j);
            EXPECT_NEAR(sum, a == b ? 1 : 0, 1e-9);
        }
}

TEST(SeriesEmulator, JacobianIsThatOfDifferences) {
    const SeriesEmulator& emulator = of_40_runs();
    const std::vector<double> point{0.3, 0.62, 0.45, 0.81};
    const Matrix analytic = emulator.jacobian(point);
    constexpr double step = 1e-3;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto moved = [&](double by) {
            std::vector<double> to = point;
            to[k] += by;
            return emulator.predict(to);
        };
        const auto up = moved(step), down = moved(-step), up_2 = moved(2 * step),
                   down_2 = moved(-2 * step);
        for (std::size_t j = 0; j < n_shown; ++j)
            ASSERT_NEAR(analytic(j, k),
                        (8 * (up[j] - down[j]) - (up_2[j] - down_2[j])) / (12 * step),
                        1e-6 * (1 + std::abs(analytic(j, k))))
                << k;
    }
}

TEST(SeriesEmulator, VarianceMatchesTheErrorsAtNewPoints) {
    const SeriesEmulator& emulator = of_40_runs();
    const Matrix points = design(200, 4, 77);
    double squares = 0, variances = 0;
    for (std::size_t i = 0; i < points.rows; ++i) {
        const std::vector<double> truth = exponentials(points.row(i)),
                                  weights = reading_weights(),
                                  scores = emulator.scores(points.row(i)),
                                  variance = emulator.variance(points.row(i));
        const Matrix& components = emulator.parts().components;
        for (std::size_t c = 0; c < components.rows; ++c) {
            double score = 0;
            for (std::size_t j = 0; j < n_shown; ++j)
                score += weights[j] * weights[j] * components(c, j) *
                         (truth[j] - emulator.parts().mean[j]);
            squares += (score - scores[c]) * (score - scores[c]);
            variances += variance[c];
        }
    }
    EXPECT_GT(variances, squares / 4);
    EXPECT_LT(variances, squares * 4);
}

TEST(ScoreProcess, IsExactAtTheRunsWhereTheNuggetIsSmall) {
    const Matrix points = design(30, 3);
    std::vector<double> scores;
    for (std::size_t i = 0; i < 30; ++i)
        scores.push_back(100 * std::sin(3 * points(i, 0)) + 20 * points(i, 1));
    const ScoreProcess process(points, scores, {{1, 1, 1}, 1, 1e-10});
    const double between = process.variance(std::vector<double>{0.01, 0.97, 0.4});
    for (std::size_t i = 0; i < 30; ++i) {
        EXPECT_NEAR(process.mean(points.row(i)), scores[i], 1e-5);
        EXPECT_LT(process.variance(points.row(i)), 1e-6 * between);
    }
}

TEST(ScoreProcess, WithoutANuggetTheSamePointTwiceIsRefused) {
    Matrix points(3, 1, 0.5);
    points(2, 0) = 0;
    EXPECT_THROW(ScoreProcess(points, std::vector<double>{1, 2, 3}, {{1}, 0, 0}),
                 std::domain_error);
}

TEST(ScoreProcess, ANuggetThatRoundingTakesUpIsRaised) {
    constexpr double nugget = 1e-8, slope_variance = 1e17;
    Matrix points(21, 2, 0);
    std::vector<double> scores;
    for (std::size_t k = 0; k < 21; ++k) {
        points(k, 0) = static_cast<double>(k) / 20;
        points(k, 1) = static_cast<double>(k * k % 21) / 20;
        scores.push_back(3 * points(k, 0) - points(k, 1));
    }
    const ScoreProcess process(points, scores, {{0.2, 0.1}, slope_variance, nugget});
    EXPECT_GT(process.scales().nugget, nugget);
    EXPECT_NEAR(process.mean(std::vector<double>{0.3, 0.6}), 0.3, 1e-3);
}

TEST(ScoreProcess, LeavingOutInClosedFormIsReallyLeavingOut) {
    const SeriesEmulator& emulator = of_40_runs();
    const Matrix& points = emulator.points();
    for (std::size_t c = 0; c < emulator.n_components(); ++c) {
        const ScoreProcess& whole = emulator.processes()[c];
        const std::vector<double> errors = whole.leave_one_out();
        for (const std::size_t left : {0U, 11U, 39U}) {
            Matrix others(0, 4);
            std::vector<double> scores;
            for (std::size_t i = 0; i < 40; ++i) {
                if (i == left) continue;
                const auto row = points.row(i);
                others.values.insert(others.values.end(), row.begin(), row.end());
                ++others.rows;
                scores.push_back(emulator.parts().scores(c, i));
            }
            const ScoreProcess part(others, scores, whole.scales());
            const double error =
                emulator.parts().scores(c, left) - part.mean(points.row(left));
            EXPECT_NEAR(errors[left], error, 1e-6 * (1 + std::abs(error))) << c;
        }
    }
}

TEST(SeriesEmulator, LeaveOneOutForetellsTheErrorAtNewPoints) {
    const ChannelRange channels[] = {{0, n_hours}, {n_hours, n_hours}};
    const std::vector<double> told = of_40_runs().leave_one_out(channels),
                              errors = cv_rmse_at(of_40_runs(), design(200, 4, 77));
    for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_GT(told[c], errors[c] / 2);
        EXPECT_LT(told[c], errors[c] * 3);
    }
}

TEST(FoldCheck, RaisesVariancesAndNeverLowersThem) {
    const SeriesEmulator& emulator = of_40_runs();
    const std::size_t n = emulator.n_components();
    const std::vector<ScoreScales> modest(n, ScoreScales{{1, 1, 1, 1}, 1, 1e-6});
    const std::vector<double> factors =
        variance_factors(emulator.points(), emulator.parts().gram, modest);
    for (const double factor : factors) {
        EXPECT_GE(factor, 1);
        EXPECT_LT(factor, 5);
    }
    // noise that a process of long lengths takes for a smooth function
    Matrix noise(40, n_shown);
    Stream random(1, 0, 0);
    for (double& value : noise.values) value = random.uniform();
    const Matrix gram = components_of(noise, reading_weights()).gram;
    const ScoreScales smooth{{0.5, 9, 9, 9}, 1, 1e-8};
    for (const double factor :
         variance_factors(emulator.points(), gram, std::vector<ScoreScales>(5, smooth)))
        EXPECT_GT(factor, 1.2);
    const std::vector<double> of_few = variance_factors(design(9), Matrix(9, 9), modest);
    EXPECT_EQ(of_few, std::vector<double>(n, 1.0));
}

TEST(SeriesEmulator, TheSameRunsGiveTheSameBits) {
    const SeriesEmulator again(design(40), simulated(design(40)), reading_weights());
    const std::vector<double> point{0.3, 0.62, 0.45, 0.81};
    EXPECT_EQ(again.predict(point), of_40_runs().predict(point));
}

TEST(SeriesEmulator, ANumberOfNoInterestIsForetoldByTheComponentsOfTheOthers) {
    std::vector<double> weights = reading_weights();
    for (std::size_t h = 0; h < n_hours; h += 2) weights[h] = 0;
    const SeriesEmulator emulator(design(40), simulated(design(40)), weights);
    EXPECT_LT(cv_rmse_at(emulator, design(50, 4, 77))[0], 3);
}

TEST(SeriesEmulator, OneParameterOrVeryFewRunsAreEnough) {
    for (const std::size_t runs : {2U, 3U, 8U}) {
        const Matrix points = design(runs, 1);
        Matrix all(runs, 4, 0.5);
        for (std::size_t i = 0; i < runs; ++i) all(i, 0) = points(i, 0);
        const SeriesEmulator emulator(points, simulated(all), reading_weights());
        expect_finite(emulator, std::vector<double>{0.4});
    }
    const SeriesEmulator emulator(design(5), simulated(design(5)), reading_weights());
    expect_finite(emulator, std::vector<double>{0.3, 0.6, 0.5, 0.8});
}

TEST(SeriesEmulator, RunsThatAreAllTheSameGiveThatSeries) {
    Matrix series(6, n_shown);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < n_shown; ++j)
            series(i, j) = 0.1 * static_cast<double>(j);
    const SeriesEmulator emulator(design(6), series, reading_weights());
    const std::vector<double> point{0.3, 0.6, 0.5, 0.8};
    EXPECT_EQ(emulator.n_components(), 0U);
    EXPECT_NEAR(emulator.predict(point)[7], 0.7, 1e-12);
    expect_finite(emulator, point);
    const SeriesEmulator of_zeros(design(6), Matrix(6, n_shown), reading_weights());
    expect_finite(of_zeros, point);
    EXPECT_EQ(of_zeros.leave_one_out(std::vector<ChannelRange>{{0, 5}})[0], 0);
}

TEST(SeriesEmulator, ThePointTwiceIsTakenAsItsMean) {
    Matrix points = design(20);
    std::copy_n(points.row(4).begin(), 4, points.row(9).begin());
    Matrix series = simulated(points);
    expect_finite(SeriesEmulator(points, series, reading_weights()), points.row(4));
    for (double& value : series.row(9)) value *= 1.01;  // a simulator that is not exact
    const SeriesEmulator emulator(points, series, reading_weights());
    expect_finite(emulator, points.row(4));
    const double told = emulator.predict(points.row(4))[0];
    EXPECT_NEAR(told, (series(4, 0) + series(9, 0)) / 2, 0.01 * series(4, 0));
}

const ChannelRange two_meters[] = {{0, n_hours}, {n_hours, n_hours}};

/// The first meter is made rough: the noise of a simulator that the parameters do not
/// explain.
TEST(SeriesEmulator, AChannelWithComponentsOfItsOwnIsNotBentByAnother) {
    Matrix series = simulated(design(40));
    Stream random(5, 0, 0);
    for (std::size_t i = 0; i < 40; ++i)
        for (std::size_t j = 0; j < n_hours; ++j)
            series(i, j) += 20 * (random.uniform() - 0.5);
    const auto weights = reading_weights();
    const SeriesEmulator together(design(40), series, weights),
        each(design(40), series, weights, usual_share, two_meters);
    const Matrix points = design(200, 4, 77);
    EXPECT_LT(cv_rmse_at(each, points)[1], 0.5 * cv_rmse_at(together, points)[1]);
    const SeriesEmulator alone(design(40), simulated(design(40)), weights, usual_share,
                               two_meters);
    EXPECT_NEAR(cv_rmse_at(each, points)[1], cv_rmse_at(alone, points)[1], 1e-9);
}

TEST(SeriesEmulator, ComponentsOfAChannelAreZeroOutsideIt) {
    std::vector<double> weights = reading_weights();
    std::fill(weights.begin(), weights.begin() + n_hours, 0.0);  // no reading at all
    const SeriesEmulator emulator(design(40), simulated(design(40)), weights, usual_share,
                                  two_meters);
    const Matrix& components = emulator.parts().components;
    ASSERT_EQ(components.rows, emulator.n_components());
    for (std::size_t c = 0; c < components.rows; ++c)
        EXPECT_NE(norm_of(components.row(c).first(n_hours)) > 0,
                  norm_of(components.row(c).last(n_hours)) > 0);
    for (const double error : cv_rmse_at(emulator, design(50, 4, 77)))
        EXPECT_LT(error, 3);
    expect_finite(emulator, std::vector<double>{0.3, 0.62, 0.45, 0.81});
}

TEST(SeriesEmulator, ChannelsAreRefusedThatAreNotTheWholeSeries) {
    const Matrix points = design(4), series = simulated(points);
    const auto refused = [&](const std::vector<ChannelRange>& channels) {
        try {
            SeriesEmulator(points, series, reading_weights(), usual_share, channels);
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(refused({{0, 500}}), "channels of 500 numbers, in a series of 1000");
    EXPECT_EQ(refused({{0, 500}, {400, 600}}),
              "a channel of 600 numbers from 400 on: expected one from 500 on, in a "
              "series of 1000");
    EXPECT_EQ(refused({{0, 1001}}),
              "a channel of 1001 numbers from 0 on: expected one from 0 on, in a series "
              "of 1000");
}

TEST(SeriesEmulator, WhatCannotBeEmulatedIsRefusedWithItsPlace) {
    const std::vector<double> weights = reading_weights();
    const Matrix points = design(4), series = simulated(points);
    EXPECT_EQ(refusal_of(points, series, weights), "accepted");
    EXPECT_EQ(refusal_of(design(1), simulated(design(1)), weights),
              "1 runs of the simulator: an emulator needs at least 2");
    EXPECT_EQ(refusal_of(points, simulated(design(3)), weights),
              "4 points of runs, but 3 series");
    EXPECT_EQ(refusal_of(points, series, {1, 2}),
              "2 weights for 1000 numbers of a series");
    EXPECT_EQ(refusal_of(points, series, std::vector<double>(n_shown)),
              "all weights are 0: no number of the series is of interest");
    Matrix broken = series;
    broken(2, 7) = NAN;
    EXPECT_EQ(refusal_of(points, broken, weights),
              "series: row 3, column 8 is nan: expected a finite number");
    Matrix outside = points;
    outside(1, 2) = 1.5;
    EXPECT_EQ(refusal_of(outside, series, weights),
              "points: row 2, column 3 is 1.5: expected a number from 0 to 1");
    std::vector<double> negative = weights;
    negative[4] = -1;
    EXPECT_EQ(refusal_of(points, series, negative), "weight 5 is -1: expected 0 or more");
    EXPECT_THROW(of_40_runs().predict(std::vector<double>{0.5}), std::invalid_argument);
    EXPECT_THROW(of_40_runs().leave_one_out(std::vector<ChannelRange>{{900, 200}}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace bemcal::emulator::test
