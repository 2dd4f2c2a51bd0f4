/// Linear steps against differences of whole simulations.
#include "functions/linear_steps.hpp"
#include "physics/simulate.hpp"
#include "support/simple_building.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::functions {
namespace {

using physics::Quantity;

constexpr int n_steps = 400, n_warm_up = 40;

/// A heated room; a load that no meter sees follows profile 0.
physics::Building building_with_gains(double size) {
    physics::Building building = test::simple_building();
    physics::Load gains;
    gains.name = "gains";
    gains.density = {size, 0, 0};
    gains.heat_fraction = 1;
    building.zones[0].loads.push_back(gains);
    return building;
}

physics::Drive drive_with_profile() {
    const physics::Building building = test::simple_building();
    physics::Drive drive = test::swinging_drive(building, n_steps, 8, 400);
    drive.n_warm_up = n_warm_up;
    drive.profiles = Matrix(1, n_steps, 1.0);
    return drive;
}

struct Linearised {
    Linearised()
        : base(building_with_gains(0)),
          more(building_with_gains(0.5)),
          less(building_with_gains(-0.5)),
          drive(drive_with_profile()) {
        const Moved moved{&more, &less, &drive, 0.5};
        steps = linear_steps(base, drive, quantities, std::span(&moved, 1));
    }
    std::vector<Quantity> quantities{Quantity::heating, Quantity::air_temperature};
    physics::Building base, more, less;
    physics::Drive drive;
    LinearSteps steps;
};

/// What the meters show with the profile [W/m2] in the gains.
std::vector<double> shown_with(const std::vector<double>& profile, Quantity quantity) {
    const physics::Building building = building_with_gains(1);
    physics::Drive drive = drive_with_profile();
    for (std::size_t k = 0; k < profile.size(); ++k) drive.profiles(0, k) = profile[k];
    return physics::predict(building, drive, physics::simulate(building, drive),
                            quantity);
}

double rms(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

TEST(LinearSteps, ScanOfSmallGainsIsTheDifferenceOfTwoSimulations) {
    const Linearised linear;
    std::vector<double> profile(n_steps, 0.0);
    Matrix input(n_steps - n_warm_up, 1);
    for (int k = n_warm_up; k < n_steps; ++k) {
        const auto at = static_cast<std::size_t>(k);
        profile[at] = 0.1 * std::sin(0.7 * k);
        input(at - n_warm_up, 0) = profile[at];
    }
    const Matrix scanned = scan(linear.steps, 0, input);
    for (std::size_t m = 0; m < linear.quantities.size(); ++m) {
        const auto with = shown_with(profile, linear.quantities[m]);
        const auto without =
            shown_with(std::vector<double>(n_steps, 0.0), linear.quantities[m]);
        std::vector<double> difference, off;
        for (std::size_t k = 0; k < with.size(); ++k) {
            difference.push_back(with[k] - without[k]);
            off.push_back(difference[k] - scanned(m, k));
        }
        EXPECT_GT(rms(difference), 0) << m;
        // Only where the thermostat starts or stops do the two differ.
        EXPECT_LT(rms(off), 0.05 * rms(difference)) << m;
    }
}

TEST(LinearSteps, AllColumnsOfAScanAreThoseOfEachAlone) {
    const Linearised linear;
    Matrix both(n_steps - n_warm_up, 2), second(n_steps - n_warm_up, 1);
    for (std::size_t k = 0; k < both.rows; ++k) {
        both(k, 0) = static_cast<double>(k % 7);
        both(k, 1) = second(k, 0) = static_cast<double>(k % 24 < 8);
    }
    const Matrix of_both = scan(linear.steps, 0, both);
    const Matrix alone = scan(linear.steps, 0, second);
    for (std::size_t m = 0; m < linear.quantities.size(); ++m)
        for (std::size_t k = 0; k < both.rows; ++k)
            ASSERT_EQ(of_both(2 * m + 1, k), alone(m, k));
}

}  // namespace bemcal::functions
