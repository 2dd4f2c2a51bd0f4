/// The random buildings that the quick tests leave out.
#include "kernel/random_responses.hpp"

namespace bemcal::physics {

INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfEveryNumber,
                         testing::Range(16U, 61U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfAirSystems, testing::Range(16U, 61U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfSeasons, testing::Range(16U, 61U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, ResponseOfCycling, testing::Range(16U, 61U));

}  // namespace bemcal::physics
