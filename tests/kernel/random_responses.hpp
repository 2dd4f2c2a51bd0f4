/// The derivative of a response for every number of random buildings: plain ones, with
/// air systems, with seasons, and with plants that cycle. A test says of how many.
#pragma once

#include "kernel/random_cycling.hpp"
#include "kernel/random_season.hpp"
#include "kernel/response_derivative.hpp"

namespace bemcal::physics {

class ResponseOfEveryNumber : public testing::TestWithParam<unsigned> {};
class ResponseOfAirSystems : public testing::TestWithParam<unsigned> {};
class ResponseOfSeasons : public testing::TestWithParam<unsigned> {};
class ResponseOfCycling : public testing::TestWithParam<unsigned> {};

TEST_P(ResponseOfEveryNumber, DerivativeIsThatOfCentralDifferences) {
    const test::RandomCase made = test::random_case(GetParam());
    if (made.building.zones[0].couplings.empty()) test::expect_derivative(made);
}

TEST_P(ResponseOfAirSystems, DerivativeIsThatOfCentralDifferences) {
    const test::RandomCase made = test::random_supplied_case(GetParam());
    if (made.building.zones[0].couplings.empty()) test::expect_derivative(made);
}

TEST_P(ResponseOfSeasons, DerivativeIsThatOfCentralDifferences) {
    const test::RandomCase made = test::random_seasonal_case(GetParam());
    if (made.building.zones[0].couplings.empty()) test::expect_derivative(made);
}

TEST_P(ResponseOfCycling, DerivativeIsThatOfCentralDifferences) {
    const test::RandomCase made = test::random_cycling_case(GetParam());
    if (made.building.zones[0].couplings.empty()) test::expect_derivative(made);
}

}  // namespace bemcal::physics
