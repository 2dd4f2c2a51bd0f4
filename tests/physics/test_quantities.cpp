/// The table of quantities and carriers: what others make of its rows.
#include "physics/quantities.hpp"

#include <string>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

TEST(Quantities, MeterEachCarrierUnderItsName) {
    for (std::size_t k = 1; k < carrier_names.size(); ++k) {
        int n = 0;
        for (const QuantityRow& row : quantity_rows) {
            if (row.carrier != static_cast<Carrier>(k)) continue;
            EXPECT_STREQ(row.name, carrier_names[k]);
            ++n;
        }
        EXPECT_EQ(n, 1) << carrier_names[k];
    }
    EXPECT_STREQ(carrier_names[0], "none");
}

TEST(Quantities, AreEnergiesUnlessTheyAreTemperatures) {
    std::size_t n = 0;
    for (const QuantityRow& row : quantity_rows) {
        const bool is_energy = std::ranges::count(energies, row.quantity) == 1;
        EXPECT_NE(is_energy, is_temperature(row.quantity)) << row.name;
        EXPECT_STREQ(row.unit, is_energy ? "kWh" : "degC") << row.name;
        n += is_energy ? 1 : 0;
    }
    EXPECT_EQ(energies.size(), n);
    EXPECT_EQ(energies.front(), Quantity::heating);
}

TEST(Quantities, OfElectricityAndFuelAreThoseOfACarrier) {
    for (const QuantityRow& row : quantity_rows) {
        const bool is_bought =
            row.measured == Measured::electricity || row.measured == Measured::fuel;
        EXPECT_EQ(is_bought, row.carrier != Carrier::none) << row.name;
    }
}

TEST(Quantities, ListTheirCarriersForAMessage) {
    const std::string text = nouns_of_carriers();
    EXPECT_EQ(text.find("electricity, gas"), 0U);
    EXPECT_NE(text.find(" or "), std::string::npos);
    EXPECT_EQ(text.find("air"), std::string::npos);
}

}  // namespace
}  // namespace bemcal::physics
