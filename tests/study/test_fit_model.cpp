#include "study/fit_model.hpp"
#include "support/simple_building.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::study;

namespace {

/// A room of which the wall and the leaks are to be found from its heating.
struct Room {
    physics::Building building = test::simple_building();
    physics::Drive drive = test::swinging_drive(building, 21 * 24, 3, 300);
    std::vector<physics::Parameter> parameters;
    std::vector<FitUnknown> unknowns;

    Room() {
        add("u_wall", "construction.wall.u_value");
        add("leaks", "zone.room.flow.infiltration.air_change");
    }

    void add(const char* name, const char* path) {
        parameters.push_back({name, "-", 0.2, 3, physics::Effect::factor,
                              physics::resolve(building, path), 1});
        unknowns.push_back({name, "-", 1, 0.5, 0.2, 3, false});
    }

    FitModel model() const {
        return {building,
                parameters,
                drive,
                {{physics::Quantity::heating, physics::Interval::hourly}}};
    }

    std::vector<double> readings(const FitModel& model, double u_wall,
                                 double leaks) const {
        Matrix point(1, 2);
        point.values = {u_wall, leaks};
        return model.predict(point).values;
    }
};

}  // namespace

TEST(FitModel, FindsWhatTheReadingsWereMadeWith) {
    const Room room;
    const FitModel model = room.model();
    auto measured = room.readings(model, 1.7, 0.6);
    measured[5] = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> weights(measured.size(), 1e4);
    weights[5] = 0;
    const Fit found = fit(model, room.unknowns, measured, weights, {0, 0}, {30, 1e-12});
    ASSERT_FALSE(found.failed);
    EXPECT_NEAR(room.unknowns[0].value(found.at.x[0]), 1.7, 1e-4);
    EXPECT_NEAR(room.unknowns[1].value(found.at.x[1]), 0.6, 1e-4);
}

TEST(FitModel, StaysWithinTheRanges) {
    Room room;
    const FitModel model = room.model();
    const auto measured = room.readings(model, 2.5, 1);
    room.unknowns[0].most = 1.2;
    const std::vector<double> weights(measured.size(), 1e4);
    const Fit found = fit(model, room.unknowns, measured, weights, {0, 0}, {20, 1e-9});
    EXPECT_DOUBLE_EQ(room.unknowns[0].value(found.at.x[0]), 1.2);
    EXPECT_EQ(found.bound[0], 1);
}

TEST(FitModel, GoesOnFromWhereItStandsAsFromItsPlaceAlone) {
    const Room room;
    const FitModel model = room.model();
    const auto measured = room.readings(model, 1.7, 0.6);
    const std::vector<double> weights(measured.size(), 1e4);
    const auto fitted = [&](const auto& start, int most_steps, bool derivatives) {
        return fit(model, room.unknowns, measured, weights, start,
                   {most_steps, 1e-12, derivatives});
    };
    const std::vector<double> begin{0, 0};
    const Fit first = fitted(begin, 1, true);
    const Fit bare = fitted(begin, 1, without_derivatives);
    EXPECT_EQ(bare.at.x, first.at.x);
    EXPECT_FALSE(bare.at.has_derivatives());
    const Fit by_place = fitted(first.at.x, 3, true);
    EXPECT_NE(by_place.at.x, first.at.x);
    for (const Fit* from : {&first, &bare}) {
        const Fit on = fitted(from->at, 3, true);
        EXPECT_EQ(on.at.x, by_place.at.x);
        EXPECT_EQ(on.at.predicted, by_place.at.predicted);
        EXPECT_EQ(on.at.derivatives.values, by_place.at.derivatives.values);
        EXPECT_EQ(on.objective, by_place.objective);
    }
}

TEST(FitModel, DerivativesAtTheEndAreThoseOfDifferencesThere) {
    const Room room;
    const FitModel model = room.model();
    const auto measured = room.readings(model, 1.7, 0.6);
    const std::vector<double> weights(measured.size(), 1e4);
    const Fit found = fit(model, room.unknowns, measured, weights, {-1, 2}, {30, 1e-6});
    Linearised there{found.at.x};
    linearise(model, room.unknowns, there);
    EXPECT_FALSE(found.at.by_secants);
    double wrong = 0, all = 0;
    for (std::size_t k = 0; k < there.derivatives.values.size(); ++k) {
        const double now = there.derivatives.values[k];
        wrong += std::pow(found.at.derivatives.values[k] - now, 2);
        all += now * now;
    }
    EXPECT_LT(std::sqrt(wrong / all), 0.01);
}

TEST(FitModel, SecantsOfAnotherModelLeadToTheSameEnd) {
    const Room room;
    const FitModel model = room.model();
    const auto measured = room.readings(model, 1.7, 0.6);
    const std::vector<double> weights(measured.size(), 1e4);
    Linearised start{{-0.5, 1}};
    linearise(model, room.unknowns, start);
    const auto fitted = [&](const Linearised& from) {
        return fit(model, room.unknowns, measured, weights, from, {30, 1e-9});
    };
    const Fit by_differences = fitted(start);
    Linearised other = start;
    other.by_secants = true;
    for (double& derivative : other.derivatives.row(0)) derivative *= 1.5;
    for (double& derivative : other.derivatives.row(1)) derivative *= -1;  // misleads
    const Fit by_secants = fitted(other);
    EXPECT_NEAR(by_secants.objective, by_differences.objective, 1e-3);
    for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(by_secants.at.x[k], by_differences.at.x[k], 1e-3);
}

// Where the power is ample the readings say nothing of it, and its prior alone would have
// it where the room gets cold.
TEST(FitModel, APriorDoesNotLeadAStepToWhereTheReadingsDenyIt) {
    Room room;
    room.parameters.push_back(
        {"capacity", "W/m2", 1, 500, physics::Effect::replace,
         physics::resolve(room.building, "zone.room.heating_capacity"), 100});
    room.unknowns.push_back({"capacity", "W/m2", 5, 20, 1, 500, true});
    const FitModel model = room.model();
    Matrix truth(1, 3);
    truth.values = {1.7, 0.6, 200};
    const auto measured = model.predict(truth).values;
    const std::vector<double> weights(measured.size(), 1e4);
    const Fit found =
        fit(model, room.unknowns, measured, weights, {1.2, -0.6, 195.0 / 20}, {20, 1e-9});
    ASSERT_FALSE(found.failed);
    EXPECT_NEAR(room.unknowns[0].value(found.at.x[0]), 1.7, 0.02);
    EXPECT_NEAR(room.unknowns[1].value(found.at.x[1]), 0.6, 0.02);
}

// The wall and the leaks stand for each other; with the wall at its end one step gets the
// leaks nearly to where many do.
TEST(FitModel, WhatStaysAtAnEndIsKnownToTheOthers) {
    Room room;
    const FitModel model = room.model();
    const auto measured = room.readings(model, 1.5, 1);
    room.unknowns[0].most = 1.2;
    const std::vector<double> weights(measured.size(), 1e4);
    const auto leaks_after = [&](int steps) {
        return room.unknowns[1].value(
            fit(model, room.unknowns, measured, weights, {0, 0}, {steps, 1e-12}).at.x[1]);
    };
    EXPECT_NEAR(leaks_after(1), leaks_after(30), 0.05 * leaks_after(30));
}

TEST(FitModel, WithoutReadingsThePriorHolds) {
    Room room;
    for (FitUnknown& unknown : room.unknowns) unknown.has_prior = true;
    const FitModel model = room.model();
    const auto measured = room.readings(model, 2, 2);
    const std::vector<double> weights(measured.size(), 0.0);
    const Fit found = fit(model, room.unknowns, measured, weights, {1, -0.5}, {20, 1e-9});
    EXPECT_NEAR(found.at.x[0], 0, 1e-6);
    EXPECT_NEAR(found.at.x[1], 0, 1e-6);
}
