/// Both forms of the likelihood against plain algebra in extended precision, against each
/// other, and their gradients against central differences; with every choice of means.
#include "emulator/small_study.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::emulator::test {
namespace {

struct Choice {
    Mean eta, delta;
    Coefficients coefficients;
    bool has_regression;
};

constexpr Choice choices[] = {
    {Mean::none, Mean::none, Coefficients::integrated, false},
    {Mean::none, Mean::none, Coefficients::integrated, true},
    {Mean::constant, Mean::none, Coefficients::integrated, true},
    {Mean::none, Mean::linear, Coefficients::integrated, true},
    {Mean::linear, Mean::constant, Coefficients::integrated, true},
    {Mean::linear, Mean::linear, Coefficients::sampled, true},
    {Mean::constant, Mean::constant, Coefficients::sampled, false},
};

ModelOptions options_of(const Choice& choice, Form form) {
    ModelOptions options;
    options.emulator_mean = choice.eta;
    options.discrepancy_mean = choice.delta;
    options.coefficients = choice.coefficients;
    options.form = form;
    if (choice.has_regression)
        options.priors.regression = {stats::PriorKind::normal, 1, 0.25};
    return options;
}

/// Moderate correlations, so that differences are precise.
Matrix some_points(std::size_t n, std::size_t dimension, const Coordinates& coordinates) {
    Stream random(7, 1, 0);
    Matrix points(n, dimension);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < dimension; ++k) {
            const Role role = coordinates.free()[k].role;
            const double centre = role == Role::plain ? 0.8 : role == Role::precision;
            points(i, k) = centre + 1.6 * (random.uniform() - 0.5);
        }
    return points;
}

std::vector<double> arguments_of(const KohDensity& density, std::span<const double> u) {
    std::vector<double> arguments(density.layout().size()), slopes(u.size()),
        gradient(u.size());
    density.coordinates().place(u.data(), arguments.data(), slopes.data(),
                                gradient.data());
    return arguments;
}

TEST(KohLikelihood, BothFormsAreThePlainOneForEveryChoiceOfMeans) {
    const Standardised data = standardise(small_study({}, 1));
    for (const Choice& choice : choices)
        for (const Form form : {Form::dense, Form::kronecker_if_grid}) {
            KohDensity density(data, options_of(choice, form));
            ASSERT_EQ(density.is_kronecker(), form != Form::dense);
            const Matrix points =
                some_points(4, density.dimension(), density.coordinates());
            sampling::Evaluations out;
            density.evaluate(points, false, out);
            for (std::size_t i = 0; i < points.rows; ++i) {
                const std::vector<double> arguments =
                    arguments_of(density, points.row(i));
                const PlainModel plain{data.data, density.layout(), arguments.data()};
                const double expected =
                    static_cast<double>(choice.coefficients == Coefficients::sampled
                                            ? plain.log_likelihood()
                                            : plain.integrated_log_likelihood());
                EXPECT_NEAR(out.likelihood[i], expected, 1e-9 * (1 + std::abs(expected)));
            }
        }
}

TEST(KohLikelihood, GradientsAreCentralDifferences) {
    const Standardised data = standardise(small_study({}, 1));
    constexpr double step = 1e-5;
    for (const Choice& choice : choices)
        for (const Form form : {Form::dense, Form::kronecker_if_grid}) {
            KohDensity density(data, options_of(choice, form));
            const std::size_t d = density.dimension();
            const Matrix points = some_points(3, d, density.coordinates());
            sampling::Evaluations at, moved;
            density.evaluate(points, true, at);
            for (std::size_t i = 0; i < points.rows; ++i) {
                Matrix around(2 * d, d);
                for (std::size_t k = 0; k < 2 * d; ++k) {
                    std::ranges::copy(points.row(i), around.row(k).begin());
                    around(k, k / 2) += k % 2 == 0 ? step : -step;
                }
                density.evaluate(around, false, moved);
                for (std::size_t k = 0; k < d; ++k) {
                    const double slope =
                        (moved.likelihood[2 * k] - moved.likelihood[2 * k + 1]) /
                        (2 * step);
                    EXPECT_NEAR(at.likelihood_gradient(i, k), slope,
                                3e-7 * (1 + std::abs(slope)))
                        << density.names()[k];
                    const double prior =
                        (moved.prior[2 * k] - moved.prior[2 * k + 1]) / (2 * step);
                    EXPECT_NEAR(at.prior_gradient(i, k), prior,
                                3e-7 * (1 + std::abs(prior)));
                }
            }
        }
}

TEST(KohLikelihood, FormsAgreeOnMoreMeasurementsThanPoints) {
    const Standardised data = standardise(small_study({7, 9, 13}, 2));
    for (const Choice& choice : choices) {
        KohDensity dense(data, options_of(choice, Form::dense));
        KohDensity kronecker(data, options_of(choice, Form::kronecker_if_grid));
        ASSERT_TRUE(kronecker.is_kronecker());
        const Matrix points = some_points(5, dense.dimension(), dense.coordinates());
        sampling::Evaluations a, b;
        dense.evaluate(points, true, a);
        kronecker.evaluate(points, true, b);
        for (std::size_t i = 0; i < points.rows; ++i) {
            EXPECT_NEAR(a.likelihood[i], b.likelihood[i], 1e-7);
            for (std::size_t k = 0; k < dense.dimension(); ++k)
                EXPECT_NEAR(a.likelihood_gradient(i, k), b.likelihood_gradient(i, k),
                            1e-7 * (1 + std::abs(a.likelihood_gradient(i, k))));
        }
    }
}

TEST(KohLikelihood, ValuesWithAndWithoutGradientAreTheSameBits) {
    const Standardised data = standardise(small_study({}, 3));
    for (const Form form : {Form::dense, Form::kronecker_if_grid}) {
        KohDensity density(data, options_of(choices[4], form));
        const Matrix points = some_points(5, density.dimension(), density.coordinates());
        sampling::Evaluations with, without;
        density.evaluate(points, true, with);
        density.evaluate(points, false, without);
        EXPECT_EQ(with.likelihood, without.likelihood);
        EXPECT_EQ(with.prior, without.prior);
    }
}

TEST(KohLikelihood, JitterIsReportedWhereTheCovarianceIsSingular) {
    const Standardised data = standardise(small_study({}, 4));
    for (const Form form : {Form::dense, Form::kronecker_if_grid}) {
        ModelOptions options;
        options.form = form;
        KohDensity density(data, options);
        Matrix points(1, density.dimension(), 0.5);
        sampling::Evaluations out;
        density.evaluate(points, false, out);
        EXPECT_EQ(density.jitter().n_with[0], 1U);
        for (std::size_t k = 2; k < 6; ++k) points(0, k) = 23;  // all but the same
        density.evaluate(points, true, out);
        EXPECT_TRUE(std::isfinite(out.likelihood[0]));
        EXPECT_EQ(density.jitter().n_with[0], 1U);
        EXPECT_EQ(density.jitter().n_with[1] + density.jitter().n_with[2] +
                      density.jitter().n_with[3],
                  1U);
        points(0, density.dimension() - 3) = 1e4;  // exp overflows
        density.evaluate(points, true, out);
        EXPECT_EQ(out.likelihood[0], -std::numeric_limits<double>::infinity());
        EXPECT_EQ(density.jitter().n_failed, 1U);
        for (const double slope : out.likelihood_gradient.values) EXPECT_EQ(slope, 0);
    }
}

TEST(KohLikelihood, ConditionsAreThePlainOnesAtOldAndNewPoints) {
    const Standardised data = standardise(small_study({5, 6, 8}, 5));
    Matrix x(5, 2);
    for (std::size_t k = 0; k < 2; ++k) {
        x(0, k) = data.data.measured_x(0, k);
        x(1, k) = data.data.measured_x(3, k);
        x(2, k) = 0.5;
        x(3, k) = -0.1;
        x(4, k) = 0.3 + 0.5 * static_cast<double>(k);
    }
    for (const Choice& choice : choices)
        for (const Form form : {Form::dense, Form::kronecker_if_grid}) {
            KohDensity density(data, options_of(choice, form));
            const Matrix points =
                some_points(2, density.dimension(), density.coordinates());
            for (std::size_t i = 0; i < points.rows; ++i) {
                std::vector<double> arguments = arguments_of(density, points.row(i));
                for (std::size_t a = 0; a < density.layout().n_beta(); ++a)
                    arguments[density.layout().beta() + a] =
                        0.3 - 0.1 * static_cast<double>(a);
                const Conditional got =
                    density.likelihood().condition(arguments.data(), x);
                const Conditional expected =
                    PlainModel{data.data, density.layout(), arguments.data()}.condition(
                        x);
                for (std::size_t r = 0; r < x.rows; ++r) {
                    EXPECT_NEAR(got.mean[r], expected.mean[r], 1e-8);
                    for (std::size_t c = 0; c < x.rows; ++c)
                        EXPECT_NEAR(got.covariance(r, c), expected.covariance(r, c),
                                    1e-8);
                }
            }
        }
}

}  // namespace
}  // namespace bemcal::emulator::test
