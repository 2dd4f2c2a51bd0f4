/// The derivative of a response for every number and change of sixty random buildings
/// with all that effects bring.
#include "kernel/response_derivative.hpp"

namespace bemcal::physics {

namespace {

class ResponseWithEffects : public testing::TestWithParam<unsigned> {};

}  // namespace

TEST_P(ResponseWithEffects, DerivativeIsThatOfCentralDifferences) {
    const test::RandomCase made = test::random_hooked_case(GetParam());
    if (made.building.zones[0].couplings.empty()) test::expect_derivative(made);
}

INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseWithEffects, testing::Range(1U, 61U));

}  // namespace bemcal::physics
