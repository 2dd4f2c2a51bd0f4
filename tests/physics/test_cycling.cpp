/// A plant below its least load: AHRI 210/240's part-load factor, its edges, its
/// derivatives, and what meters show of it.
#include "physics/cycling.hpp"
#include "physics/meters.hpp"
#include "support/simple_building.hpp"

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// ANSI/AHRI 210/240-2008, 4.1.3.3 and Appendix C: the default C_D is 0.25, so that half
/// a load takes PLF(0.5) = 1 - 0.25 x 0.5 = 0.875 of the efficiency.
TEST(Cycling, HalfALoadHasThePartLoadFactorOfAhri) {
    const double load = 5000;
    EXPECT_NEAR(load + lost({load, 2 * load, 0.25}), load / 0.875, 1e-9);
}

TEST(Cycling, NothingIsLostFromTheLeastLoadOnNorWithoutALoad) {
    for (const double load : {0.0, 1000.0, 1500.0})
        EXPECT_EQ(lost({load, 1000, 0.25}), 0) << load;
    EXPECT_GT(lost({999, 1000, 0.25}), 0);
    EXPECT_EQ(lost({500, 0, 0.25}), 0);
}

/// The share that is lost grows as the load falls.
TEST(Cycling, ASmallerLoadLosesALargerShare) {
    double before = 0;
    for (const double load : {900.0, 600.0, 300.0, 1.0}) {
        const double share = lost({load, 1000, 0.2}) / load;
        EXPECT_GT(share, before);
        before = share;
    }
    EXPECT_NEAR(before, 1 / 0.8 - 1, 1e-3);
}

TEST(Cycling, DerivativesAreThoseOfDifferences) {
    const Cycling at{400, 1000, 0.25};
    const Cycling of = pull_lost(at, 2);
    const auto slope = [&](double Cycling::* number, double by) {
        Cycling more = at, less = at;
        more.*number += by;
        less.*number -= by;
        return 2 * (lost(more) - lost(less)) / (2 * by);
    };
    EXPECT_NEAR(of.load, slope(&Cycling::load, 1e-3), 1e-7);
    EXPECT_NEAR(of.least, slope(&Cycling::least, 1e-3), 1e-7);
    EXPECT_NEAR(of.loss, slope(&Cycling::loss, 1e-6), 1e-4);
}

/// 400 W of 20 m2 x 40 W/m2: half the least load.
TEST(Cycling, MetersOfFuelShowItAndThoseOfHeatDoNot) {
    Building building = test::simple_building();
    building.plant.heating_least_load = building.plant.cooling_least_load = 40;
    building.plant.heating_cycling_loss = 0.25;
    building.plant.cooling_cycling_loss = 0.5;
    building.plant.heating_auxiliary = 0.02;
    building.meter_factor[static_cast<std::size_t>(Quantity::gas)] = {1.1};
    const Drive drive = test::constant_drive(building, 1, 5);
    const std::vector<double> none{0}, watts{400};
    const Trajectory t{{{{20}, none, none, watts, watts}}};
    const auto shown = [&](Quantity quantity) {
        return predict(building, drive, t, quantity)[0];
    };
    const double loads = 0.1;  // kWh, of equipment
    EXPECT_NEAR(shown(Quantity::heating), 0.4, 1e-12);
    EXPECT_NEAR(shown(Quantity::cooling), 0.4, 1e-12);
    EXPECT_NEAR(shown(Quantity::gas), 1.1 * 0.4 / 0.875 / 0.9, 1e-12);
    EXPECT_NEAR(shown(Quantity::electricity), 0.4 / 0.75 / 3 + 0.02 * 0.4 + loads, 1e-12);
}

}  // namespace
}  // namespace bemcal::physics
