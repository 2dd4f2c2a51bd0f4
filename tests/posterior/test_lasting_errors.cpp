#include "posterior/lasting_errors.hpp"
#include "posterior/posterior_cases.hpp"
#include "sampling/normal.hpp"
#include "study/points.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::study {
namespace {

constexpr double two_days = 2.0 / 7;  ///< [weeks], of which a fortnight has seven
constexpr std::size_t block = 48;

posterior::MeterChoice all_meters(const Case& made) {
    posterior::MeterChoice choice;
    for (const Meter& meter : made.meters) choice.names.push_back(meter.name);
    return choice;
}

/// The described building once, with scales of 1 for residuals.
posterior::BuildingModel::Points described(const posterior::BuildingModel& model) {
    posterior::BuildingModel::Points points{
        nominal_points(model.building().parameters, 1),
        Matrix(1, model.n_residual_parameters())};
    for (std::size_t m = 0; m < model.meters().size(); ++m)
        points.residuals(0, model.first_residual_parameter(m)) =
            1 / model.meters()[m].scale;
    return points;
}

/// A fortnight whose air temperature is off by noise, and by 1 K up and down in turn, of
/// so much of the variance.
Case off_by(double slow) {
    Case made = test::fortnight();
    const posterior::BuildingModel model(made, made.periods[0], all_meters(made));
    const auto predicted = model.predict(described(model).parameters);
    Stream random(3, 1, 4);
    auto& values = made.meters[1].values;
    for (std::size_t t = 0; t < predicted[1].cols; ++t) {
        const double step = t / block % 2 == 0 ? 1 : -1;
        values[t] = predicted[1](0, t) + std::sqrt(slow) * step +
                    std::sqrt(1 - slow) * sampling::standard_normal(random);
    }
    return made;
}

double share_of(double slow) {
    const Case made = off_by(slow);
    posterior::MeterChoice choice = all_meters(made);
    choice.residuals.autocorrelated = false;
    const posterior::BuildingModel model(made, made.periods[0], choice);
    return posterior::lasting_shares(model, described(model), two_days)[1];
}

// 336 white residuals: 7 means of 48 have a variance of 1/48 within 53 %, so that the
// share strays from 0 by 0.013; 5 of that.
TEST(LastingErrors, AreTheShareOfTheVarianceThatMeansOverBlocksKeep) {
    EXPECT_LT(share_of(0), 0.065);
    EXPECT_NEAR(share_of(0.4), 0.4 / 0.867, 0.13);
    EXPECT_EQ(share_of(1), 0.9);
}

TEST(LastingErrors, AreNoneWhereThereAreFewBlocks) {
    const Case made = off_by(0.4);
    const posterior::BuildingModel model(made, made.periods[0], all_meters(made));
    EXPECT_EQ(posterior::lasting_shares(model, described(model), 0.5)[1], 0);
}

TEST(LastingErrors, AreParametersOfAModelWithASlowPart) {
    const Case made = off_by(0.4);
    posterior::MeterChoice choice = all_meters(made);
    const posterior::BuildingModel trained(made, made.periods[0], choice);
    choice.residuals.discrepancy = true;
    const posterior::BuildingModel model(made, made.periods[0], choice);
    const auto points = described(trained);
    const auto made_points =
        posterior::with_lasting_errors(trained, points, model, {0.25, 0.5}, two_days);
    ASSERT_EQ(made_points.residuals.cols, 10U);  // twice 3 and share, timescale
    for (std::size_t m = 0; m < 2; ++m) {
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(made_points.residuals(0, 5 * m + k),
                      points.residuals(0, 3 * m + k));
        EXPECT_EQ(made_points.residuals(0, 5 * m + 3), m == 0 ? 0.25 : 0.5);
        EXPECT_EQ(made_points.residuals(0, 5 * m + 4), 48);
    }
}

}  // namespace
}  // namespace bemcal::study
