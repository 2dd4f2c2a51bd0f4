/// Draws of predictions against the conditional distributions they are from. False
/// alarms: 5 standard errors on some 40 statistics, 2e-5 in all; the seeds are fixed.
#include "emulator/prediction.hpp"
#include "emulator/small_study.hpp"

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

constexpr std::size_t n_draws = 4000;

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments_of(const Matrix& draws, std::size_t column) {
    Moments made;
    for (std::size_t d = 0; d < draws.rows; ++d) made.mean += draws(d, column);
    made.mean /= static_cast<double>(draws.rows);
    for (std::size_t d = 0; d < draws.rows; ++d)
        made.variance += (draws(d, column) - made.mean) * (draws(d, column) - made.mean);
    made.variance /= static_cast<double>(draws.rows - 1);
    return made;
}

Matrix the_same_point(std::size_t dimension) {
    return {n_draws, dimension, 0.4};
}

TEST(KohPrediction, DrawsHaveTheMomentsOfTheConditionalInPhysicalUnits) {
    const Observations o = small_study({}, 1);
    for (const Form form : {Form::dense, Form::kronecker_if_grid}) {
        ModelOptions options;
        options.form = form;
        KohDensity density(standardise(o), options);
        const Matrix draws = the_same_point(density.dimension());
        Stream random(3, 0, 0);
        const Prediction made = predict(density, draws, o.measured_x, random);
        std::vector<double> arguments(density.layout().size()), scratch(2 * draws.cols);
        density.coordinates().place(draws.row(0).data(), arguments.data(), scratch.data(),
                                    scratch.data() + draws.cols);
        const Conditional expected = density.likelihood().condition(
            arguments.data(), density.data().data.measured_x);
        const double width = density.data().output.width;
        const double noise =
            width * width * std::exp(-arguments[density.layout().log_lambda_e()]);
        for (std::size_t i = 0; i < o.measured.size(); ++i) {
            const double mean = density.data().output.physical(expected.mean[i]);
            const double variance = width * width * expected.covariance(i, i);
            EXPECT_DOUBLE_EQ(made.mean(7, i), mean);
            const Moments process = moments_of(made.process, i),
                          measurement = moments_of(made.measurement, i);
            EXPECT_NEAR(process.mean, mean, 5 * std::sqrt(variance / n_draws));
            EXPECT_NEAR(process.variance, variance,
                        5 * variance * std::sqrt(2. / n_draws));
            EXPECT_NEAR(measurement.variance, variance + noise,
                        5 * (variance + noise) * std::sqrt(2. / n_draws));
        }
    }
}

TEST(KohPrediction, IntegratedCoefficientsAreDrawnFromTheirPosterior) {
    ModelOptions options;
    options.emulator_mean = Mean::constant;
    options.discrepancy_mean = Mean::constant;
    const Observations o = small_study({}, 1);
    KohDensity density(standardise(o), options);
    const Matrix draws = the_same_point(density.dimension());
    std::vector<double> arguments(density.layout().size()), scratch(2 * draws.cols);
    density.coordinates().place(draws.row(0).data(), arguments.data(), scratch.data(),
                                scratch.data() + draws.cols);
    const CoefficientPosterior beta = density.likelihood().coefficients(arguments.data());
    Stream random(4, 0, 0);
    const Prediction made = predict(density, draws, o.measured_x, random);
    for (std::size_t a = 0; a < 2; ++a) {
        const Moments got = moments_of(made.coefficients, a);
        const double variance = beta.covariance(a, a);
        EXPECT_NEAR(got.mean, beta.mean[a], 5 * std::sqrt(variance / n_draws));
        EXPECT_NEAR(got.variance, variance, 5 * variance * std::sqrt(2. / n_draws));
    }
}

}  // namespace
}  // namespace bemcal::emulator::test
