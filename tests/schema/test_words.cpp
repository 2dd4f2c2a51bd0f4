/// Words of choices that come from a table below the schema.
#include "schema/schema.hpp"
#include "schema/words.hpp"

#include <gtest/gtest.h>

namespace bemcal::schema {
namespace {

template <std::size_t N>
std::vector<std::string> texts_of(const std::array<const char*, N>& words) {
    return {words.begin(), words.end()};
}

TEST(Words, OfQuantitiesStandInTheOrderOfTheirTable) {
    EXPECT_EQ(choices_of(*find_key("meter", "quantity")),
              texts_of(physics::quantity_names));
}

TEST(Words, OfCarriersBeginWithNone) {
    const auto names = texts_of(physics::carrier_names);
    EXPECT_EQ(names[0], "none");
    EXPECT_EQ(choices_of(*find_key("zone.load", "carrier")), names);
    EXPECT_EQ(choices_of(*find_key("plant", "heating_carrier")), names);
    EXPECT_EQ(choices_of(*find_key("plant", "cooling_carrier")), names);
    EXPECT_EQ(choices_of(*find_key("scenario", "heating_carrier")), names);
}

}  // namespace
}  // namespace bemcal::schema
