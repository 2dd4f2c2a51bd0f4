/// The residual model against the dense Gaussian process that it is, its derivatives, and
/// its edges.
#include "residual_model_cases.hpp"

#include <gtest/gtest.h>

namespace bemcal::stats {
namespace {

using namespace residual_cases;

const ResidualOptions white{false, false, false};
const ResidualOptions ar1{true, false, false};
const ResidualOptions slow{false, true, false};
const ResidualOptions ar1_slow{true, true, false};
const ResidualOptions ar1_steady{true, true, true};

class EveryModel : public testing::TestWithParam<ResidualOptions> {};
INSTANTIATE_TEST_SUITE_P(Residuals, EveryModel,
                         testing::Values(white, ar1, slow, ar1_slow, ar1_steady));

TEST_P(EveryModel, IsTheDenseGaussianProcess) {
    for (const bool has_gaps : {false, true}) {
        const auto readings = some_readings(500, has_gaps);
        const ResidualModel model(readings, unit, GetParam());
        const Rows predictions = some_predictions(500, 2);
        const Rows parameters = some_parameters(GetParam(), 2);
        const Answer answer = answer_of(model, predictions, parameters);
        for (std::size_t lane = 0; lane < 2; ++lane) {
            const double dense =
                dense_log_likelihood(readings, predictions.lane(lane),
                                     point_of(GetParam(), parameters.lane(lane)));
            EXPECT_NEAR(answer.values[lane], dense, 1e-8 * std::abs(dense));
        }
    }
}

/// Of a smooth function, with an error of the order of step^4.
template <typename Function>
double central_difference(double step, const Function& function) {
    return (8 * (function(step) - function(-step)) -
            (function(2 * step) - function(-2 * step))) /
           (12 * step);
}

TEST_P(EveryModel, HasTheDerivativeOfItsValue) {
    const std::size_t n = 300;
    const ResidualModel model(some_readings(n, true), unit, GetParam());
    const Rows predictions = some_predictions(n, 3);
    const Rows parameters = some_parameters(GetParam(), 3);
    const Answer answer = answer_of(model, predictions, parameters);
    const auto prediction = predictions.lane(2), parameter = parameters.lane(2);
    for (std::size_t k = 0; k < parameter.size(); ++k) {
        const double slope = central_difference(1e-3 * parameter[k], [&](double step) {
            auto moved = parameter;
            moved[k] += step;
            return value_of(model, prediction, moved);
        });
        EXPECT_NEAR(answer.by_parameter.lane(2)[k], slope, 1e-6 * (1 + std::abs(slope)))
            << residual_parameters(GetParam())[k];
    }
    for (std::size_t t = 0; t < n; t += 7) {
        const double slope = central_difference(1e-2, [&](double step) {
            auto moved = prediction;
            moved[t] += step;
            return value_of(model, moved, parameter);
        });
        EXPECT_NEAR(answer.by_prediction.lane(2)[t], slope, 1e-6 * (1 + std::abs(slope)));
    }
}

TEST_P(EveryModel, GivesALaneTheSameBitsWhateverItsNeighbours) {
    const std::size_t n = 200, most = 16;
    const ResidualModel model(some_readings(n, true), unit, GetParam());
    const Rows predictions = some_predictions(n, most);
    const Rows parameters = some_parameters(GetParam(), most);
    const Answer all = answer_of(model, predictions, parameters);
    for (const std::size_t lanes : {1, 3, 4, 8})
        for (std::size_t first = 0; first + lanes <= most; first += lanes) {
            Rows some{lanes, std::vector<double>(n * lanes)};
            Rows point{lanes, std::vector<double>(model.n_parameters() * lanes)};
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto column = predictions.lane(first + l);
                const auto values = parameters.lane(first + l);
                for (std::size_t t = 0; t < n; ++t) some(t, l) = column[t];
                for (std::size_t k = 0; k < values.size(); ++k) point(k, l) = values[k];
            }
            const Answer few = answer_of(model, some, point);
            for (std::size_t l = 0; l < lanes; ++l) {
                EXPECT_EQ(few.values[l], all.values[first + l]);
                EXPECT_EQ(few.by_prediction.lane(l), all.by_prediction.lane(first + l));
                EXPECT_EQ(few.by_parameter.lane(l), all.by_parameter.lane(first + l));
            }
        }
}

TEST_P(EveryModel, GivesTheSameValueWithAndWithoutDerivatives) {
    const ResidualModel model(some_readings(120, true), unit, GetParam());
    const Rows predictions = some_predictions(120, 1);
    const Rows parameters = some_parameters(GetParam(), 1);
    EXPECT_EQ(answer_of(model, predictions, parameters).values[0],
              value_of(model, predictions.values, parameters.values));
}

TEST_P(EveryModel, SaysNothingWhereAllReadingsAreMissing) {
    const ResidualModel model(std::vector<double>(20, missing), unit, GetParam());
    EXPECT_EQ(model.n_present(), 0U);
    const Answer answer =
        answer_of(model, some_predictions(20, 2), some_parameters(GetParam(), 2));
    EXPECT_EQ(answer.values, (std::vector<double>{0, 0}));
    EXPECT_EQ(answer.by_prediction.values, std::vector<double>(40, 0.0));
    EXPECT_EQ(answer.by_parameter.values,
              std::vector<double>(2 * model.n_parameters(), 0.0));
}

TEST_P(EveryModel, NeverLooksAtPredictionsWithoutReadings) {
    auto readings = some_readings(50, true);
    const ResidualModel model(readings, unit, GetParam());
    Rows predictions = some_predictions(50, 1);
    const Rows parameters = some_parameters(GetParam(), 1);
    const double value = value_of(model, predictions.values, parameters.values);
    for (std::size_t t = 0; t < 50; ++t)
        if (std::isnan(readings[t])) predictions(t, 0) = missing;
    const Answer answer = answer_of(model, predictions, parameters);
    EXPECT_EQ(answer.values[0], value);
    for (std::size_t t = 0; t < 50; ++t)
        EXPECT_EQ(std::isnan(readings[t]), answer.by_prediction(t, 0) == 0);
}

/// Lane 1 of 3 alone is impossible, and has no slope.
void expect_only_lane_1_impossible(Answer answer) {
    EXPECT_EQ(answer.values[1], -std::numeric_limits<double>::infinity());
    for (const double slope : answer.by_prediction.lane(1)) EXPECT_EQ(slope, 0);
    for (const double slope : answer.by_parameter.lane(1)) EXPECT_EQ(slope, 0);
    for (const std::size_t lane : {0, 2}) {
        EXPECT_TRUE(std::isfinite(answer.values[lane]));
        EXPECT_NE(answer.by_parameter(0, lane), 0);
    }
}

TEST_P(EveryModel, IsImpossibleWhereAScaleIsZero) {
    const ResidualModel model(some_readings(60, true), unit, GetParam());
    Rows predictions = some_predictions(60, 3),
         parameters = some_parameters(GetParam(), 3);
    parameters(0, 1) = 0;
    predictions(25, 1) = 0;
    expect_only_lane_1_impossible(answer_of(model, predictions, parameters));
    predictions(25, 1) = 9;
    EXPECT_TRUE(std::isfinite(answer_of(model, predictions, parameters).values[1]));
}

TEST_P(EveryModel, IsImpossibleWhereAPredictionIsNotFinite) {
    const ResidualModel model(some_readings(60, true), unit, GetParam());
    for (const double wrong : {missing, std::numeric_limits<double>::infinity()}) {
        Rows predictions = some_predictions(60, 3);
        predictions(25, 1) = wrong;
        expect_only_lane_1_impossible(
            answer_of(model, predictions, some_parameters(GetParam(), 3)));
    }
}

TEST_P(EveryModel, IsImpossibleOutOfTheParametersRange) {
    const ResidualModel model(some_readings(60, true), unit, GetParam());
    const auto names = residual_parameters(GetParam());
    const auto try_value = [&](std::size_t parameter, double value) {
        Rows parameters = some_parameters(GetParam(), 3);
        parameters(parameter, 1) = value;
        SCOPED_TRACE(names[parameter]);
        expect_only_lane_1_impossible(
            answer_of(model, some_predictions(60, 3), parameters));
    };
    for (std::size_t k = 0; k < names.size(); ++k) try_value(k, missing);
    for (std::size_t k = 2; k < names.size(); ++k) try_value(k, -0.1);
    for (std::size_t k = 2; k < names.size(); ++k)
        if (names[k] == "phi")
            try_value(k, 1.0);
        else if (names[k] == "share")
            try_value(k, 1.1);
        else
            try_value(k, 0.0);
}

TEST_P(EveryModel, ForgetsOverALongGap) {
    std::vector<double> together(20'000, missing), early{11, 12}, late{9, 14};
    together[0] = 11, together[1] = 12, together[19'998] = 9, together[19'999] = 14;
    const std::vector<double> f(20'000, 10.0);
    const auto parameters = some_parameters(GetParam(), 1).values;
    const auto value = [&](const std::vector<double>& readings) {
        return value_of(ResidualModel(readings, unit, GetParam()), f, parameters);
    };
    EXPECT_DOUBLE_EQ(value(together), value(early) + value(late));
}

TEST_P(EveryModel, TakesScalesOfAnyMagnitude) {
    const auto readings = some_readings(400, true);
    const auto prediction = some_predictions(400, 1).values;
    const auto parameters = some_parameters(GetParam(), 1).values;
    const double value = value_of({readings, unit, GetParam()}, prediction, parameters);
    for (const double factor : {0x1p-200, 0x1p200}) {
        auto y = readings, f = prediction;
        for (double& x : y) x *= factor;
        for (double& x : f) x *= factor;
        const ResidualModel model(y, unit * factor, GetParam());
        const double change = -static_cast<double>(model.n_present()) * std::log(factor);
        const double moved = value_of(model, f, parameters);
        EXPECT_NEAR(moved, value + change, 1e-12 * std::abs(change));
    }
}

TEST(ResidualParameters, AreThoseOfTheOptions) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(residual_parameters({false, false}), (Names{"constant", "proportional"}));
    EXPECT_EQ(residual_parameters({true, false}),
              (Names{"constant", "proportional", "phi"}));
    EXPECT_EQ(residual_parameters({false, true}),
              (Names{"constant", "proportional", "share", "timescale"}));
    EXPECT_EQ(residual_parameters({true, true}),
              (Names{"constant", "proportional", "phi", "share", "timescale"}));
}

}  // namespace
}  // namespace bemcal::stats
