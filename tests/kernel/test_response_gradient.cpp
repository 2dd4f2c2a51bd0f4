/// The derivative of a response for every number of sixty random buildings, of sixty with
/// air systems, and of sixty with seasons.
#include "kernel/random_season.hpp"
#include "kernel/random_supply.hpp"
#include "kernel/response_derivative.hpp"

namespace bemcal::physics {

namespace {

class ResponseOfEveryNumber : public testing::TestWithParam<unsigned> {};
class ResponseOfAirSystems : public testing::TestWithParam<unsigned> {};
class ResponseOfSeasons : public testing::TestWithParam<unsigned> {};

}  // namespace

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

INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfEveryNumber, testing::Range(1U, 61U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfAirSystems, testing::Range(1U, 61U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfSeasons, testing::Range(1U, 61U));

}  // namespace bemcal::physics
