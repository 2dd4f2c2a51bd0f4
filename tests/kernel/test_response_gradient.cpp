/// Fifteen random buildings of each kind; forty-five more are among the slow tests.
#include "kernel/random_responses.hpp"

namespace bemcal::physics {

INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfEveryNumber, testing::Range(1U, 16U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfAirSystems, testing::Range(1U, 16U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfSeasons, testing::Range(1U, 16U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfCycling, testing::Range(1U, 16U));

}  // namespace bemcal::physics
