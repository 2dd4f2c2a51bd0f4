#include "posterior/posterior_cases.hpp"
#include "posterior/predictive.hpp"
#include "study/points.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

/// The described building n times, with residuals of the constant part alone.
posterior::BuildingModel::Points described(const posterior::BuildingModel& model,
                                           std::size_t n, double constant) {
    posterior::BuildingModel::Points points{
        nominal_points(model.building().parameters, n),
        Matrix(n, model.n_residual_parameters())};
    for (std::size_t m = 0; m < model.meters().size(); ++m)
        for (std::size_t r = 0; r < n; ++r)
            points.residuals(r, model.first_residual_parameter(m)) = constant;
    return points;
}

posterior::MeterChoice all_meters(const Case& made) {
    posterior::MeterChoice choice;
    for (const Meter& meter : made.meters) choice.names.push_back(meter.name);
    return choice;
}

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) /
           static_cast<double>(values.size());
}

/// Standard deviation over the draws of the logarithm of a draw's mean.
double spread_of_levels(const posterior::MeterPrediction& meter) {
    double sum = 0, squares = 0;
    const auto n = static_cast<double>(meter.draws.rows);
    for (std::size_t d = 0; d < meter.draws.rows; ++d) {
        const double level = std::log(mean_of(meter.draws.row(d)) / mean_of(meter.mean));
        sum += level;
        squares += level * level;
    }
    return std::sqrt(squares / n - sum * sum / (n * n));
}

class LevelChange : public testing::Test {
  protected:
    Case made_ = test::fortnight();
    posterior::BuildingModel model_{made_, made_.periods[0], all_meters(made_)};

    std::vector<posterior::MeterPrediction> predict(double level_change) const {
        Stream random(3, 1, 4);
        return posterior::predict_meters(model_, described(model_, 400, 1e-6),
                                         level_change, random);
    }
};

// 400 draws tell a standard deviation within 3.5 %: 5 of that.
TEST_F(LevelChange, MovesAWholePeriodOfEnergiesAtOnce) {
    const auto meters = predict(0.2);
    ASSERT_EQ(meters[0].quantity, physics::Quantity::heating);
    EXPECT_NEAR(spread_of_levels(meters[0]), 0.2, 0.035);
    const auto draw = meters[0].draws.row(7);
    const double level = mean_of(meters[0].mean), factor = mean_of(draw) / level;
    EXPECT_GT(std::abs(factor - 1), 1e-3);
    for (std::size_t t = 0; t < draw.size(); ++t)
        EXPECT_NEAR(draw[t], factor * meters[0].mean[t], 1e-4 * level);
}

TEST_F(LevelChange, LeavesTemperaturesAndMeansAlone) {
    const auto with = predict(0.2), without = predict(0);
    EXPECT_EQ(with[0].mean, without[0].mean);
    EXPECT_LT(spread_of_levels(with[1]), 1e-6);
    EXPECT_LT(spread_of_levels(without[0]), 1e-6);
}

TEST(ResidualUnknowns, AScaleInProportionCanBeLeftOut) {
    Meter meter;
    meter.quantity = physics::Quantity::heating;
    stats::ResidualOptions options;
    EXPECT_EQ(posterior::residual_unknowns(meter, options)[1].prior.kind,
              stats::PriorKind::lognormal);
    options.proportional = false;
    const stats::Prior left_out = posterior::residual_unknowns(meter, options)[1].prior;
    EXPECT_EQ(left_out.kind, stats::PriorKind::fixed);
    EXPECT_EQ(left_out.a, 0);
}

}  // namespace
}  // namespace bemcal::study
