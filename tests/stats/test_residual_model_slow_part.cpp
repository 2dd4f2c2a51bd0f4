/// The residual model's Matern-3/2 part: extremes of its parameters, the held gain,
/// draws.
#include "residual_model_cases.hpp"

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

using namespace residual_cases;

const ResidualOptions ar1{true, false}, white{false, false};
const ResidualOptions full{true, true, false}, steady{true, true, true};

void expect_dense(const ResidualOptions& options, const std::vector<double>& point) {
    const std::size_t n = 150;
    const auto readings = some_readings(n, true);
    const auto prediction = some_predictions(n, 1).values;
    const double dense =
        dense_log_likelihood(readings, prediction, point_of(options, point));
    const ResidualModel model(readings, unit, options);
    EXPECT_NEAR(value_of(model, prediction, point), dense, 1e-8 * std::abs(dense));
}

TEST(SlowPart, IsTheDenseGaussianProcessOnAllTimescales) {
    for (const double timescale : {0.01, 0.3, 1.0, 3.5, 30.0, 1e3, 1e5}) {
        SCOPED_TRACE(timescale);
        expect_dense(full, {0.2, 0.1, 0.7, 0.4, timescale});
        expect_dense({false, true, false}, {0.2, 0.1, 0.4, timescale});
    }
}

TEST(SlowPart, IsTheDenseGaussianProcessNearTheBoundsOfItsShareAndOfPhi) {
    expect_dense(full, {0.2, 0.1, 0.0, 0.4, 20});
    expect_dense(full, {0.2, 0.1, 0.9999, 0.4, 20});
    expect_dense(full, {0.2, 0.1, 0.7, 0.0, 20});
    expect_dense(full, {0.2, 0.1, 0.7, 0.9999, 20});
    expect_dense(full, {0.2, 0.1, 0.7, 1.0, 1.5});
}

TEST(SlowPart, WithoutAShareIsTheShortMemoryAlone) {
    const ResidualModel with(some_readings(300, true), unit, steady);
    const ResidualModel without(some_readings(300, true), unit, ar1);
    const Rows f = some_predictions(300, 1);
    const Answer slow = answer_of(with, f, {1, {0.2, 0.1, 0.7, 0, 20}});
    const Answer alone = answer_of(without, f, {1, {0.2, 0.1, 0.7}});
    EXPECT_NEAR(slow.values[0], alone.values[0], 1e-10 * std::abs(alone.values[0]));
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(slow.by_parameter(k, 0), alone.by_parameter(k, 0),
                    1e-8 * std::abs(alone.by_parameter(k, 0)));
    for (std::size_t t = 0; t < 300; ++t)
        EXPECT_NEAR(slow.by_prediction(t, 0), alone.by_prediction(t, 0), 1e-9);
    EXPECT_EQ(slow.by_parameter(4, 0), 0);
}

double relative(double value, double reference) {
    return std::abs(value - reference) / (1 + std::abs(reference));
}

// With a change that counts as settled of 1e-10, 1e-7 and 2e-4 are met with room to
// spare; what is asked for is 1e-4 of the value.
TEST(HeldGain, IsCloseToTheFilterWithGapsAndWithout) {
    const std::size_t n = 3000;
    const Rows f = some_predictions(n, 4);
    const Rows parameters{4, {0.2, 0.2,  0.2, 0.2, 0.1, 0.1, 0.1, 0.1, 0.8, 0.95,
                              0.5, 0.97, 0.4, 0.2, 0.8, 0.5, 168, 24,  500, 300}};
    for (const bool has_gaps : {false, true}) {
        const auto readings = some_readings(n, has_gaps);
        const Answer filter = answer_of({readings, unit, full}, f, parameters);
        const Answer held = answer_of({readings, unit, steady}, f, parameters);
        for (std::size_t lane = 0; lane < 4; ++lane) {
            EXPECT_NE(held.values[lane], filter.values[lane]) << "nothing was held";
            EXPECT_LT(relative(held.values[lane], filter.values[lane]), 1e-7);
        }
        for (std::size_t k = 0; k < parameters.values.size(); ++k)
            EXPECT_LT(
                relative(held.by_parameter.values[k], filter.by_parameter.values[k]),
                1e-5);
        for (std::size_t k = 0; k < f.values.size(); ++k)
            EXPECT_LT(
                relative(held.by_prediction.values[k], filter.by_prediction.values[k]),
                1e-5);
    }
}

/// Readings minus predictions are linear in the normals: [normals][readings].
std::vector<std::vector<double>> responses(const ResidualModel& model,
                                           const std::vector<double>& prediction,
                                           const std::vector<double>& point) {
    std::vector<std::vector<double>> columns;
    for (std::size_t k = 0; k < model.n_normals(); ++k) {
        std::vector<double> normals(model.n_normals());
        normals[k] = 1;
        columns.push_back(model.draw(prediction, point, normals));
        for (std::size_t t = 0; t < prediction.size(); ++t)
            columns.back()[t] -= prediction[t];
    }
    return columns;
}

class Draws : public testing::TestWithParam<ResidualOptions> {};
INSTANTIATE_TEST_SUITE_P(Residuals, Draws,
                         testing::Values(white, ar1, steady,
                                         ResidualOptions{false, true}));

// Exactly, and so without the error of a sample: the covariance of J x, with x standard
// normal, is J J'.
TEST_P(Draws, HaveTheModelsCovarianceAlsoWhereReadingsAreMissing) {
    const std::size_t n = 40;
    const ResidualModel model(some_readings(n, true), unit, GetParam());
    const auto prediction = some_predictions(n, 1).values;
    const auto values = some_parameters(GetParam(), 1).values;
    const Point point = point_of(GetParam(), values);
    const auto columns = responses(model, prediction, values);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            double covariance = 0;
            for (const auto& column : columns) covariance += column[i] * column[j];
            const double scales =
                scale_at(point, prediction[i]) * scale_at(point, prediction[j]);
            EXPECT_NEAR(covariance / scales, correlation_at(point, i > j ? i - j : j - i),
                        1e-12);
        }
}

TEST_P(Draws, AreThePredictionWhereTheNormalsAreZero) {
    const ResidualModel model(some_readings(40, true), unit, GetParam());
    const auto prediction = some_predictions(40, 1).values;
    const std::vector<double> zeros(model.n_normals());
    EXPECT_EQ(model.draw(prediction, some_parameters(GetParam(), 1).values, zeros),
              prediction);
}

TEST_P(Draws, OfNoReadingsAreEmpty) {
    const ResidualModel model({}, unit, GetParam());
    EXPECT_TRUE(model.draw({}, some_parameters(GetParam(), 1).values, {}).empty());
}

}  // namespace
}  // namespace bemcal::stats
