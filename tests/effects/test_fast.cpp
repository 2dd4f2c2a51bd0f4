#include "effects/catalogue.hpp"
#include "kernel/batch.hpp"
#include "office.hpp"

#include <set>

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;
using test::Quantity;

constexpr physics::Quantity meters[] = {
    physics::Quantity::air_temperature, physics::Quantity::cooling,
    physics::Quantity::electricity, physics::Quantity::gas};
const std::vector<Quantity> quantities = {Quantity::air_temperature, Quantity::cooling,
                                          Quantity::electricity, Quantity::gas};

/// Fast and plain simulation agree on every effect of the catalogue, to rounding.
TEST(FastSimulation, SeesEveryEffectAsThePlainOneDoes) {
    const Office office("2021-03-15", "2021-07-15");
    std::set<std::string> seen;
    for (const Effect& effect : named_candidates(office.around, meters)) {
        if (!seen.insert(effect.name).second) continue;
        const Placed placed = place(std::span(&effect, 1), office.around);
        const kernel::Batch batch(placed.building, placed.parameters, placed.drive);
        Matrix point(1, 1, effect.typical);
        const auto answer = batch.evaluate(point, {quantities, {}, {}})[0];
        ASSERT_EQ(answer.failure, "") << effect.name;
        const auto plain = test::all_shown(placed, {effect.typical});
        for (std::size_t k = 0; k < quantities.size(); ++k) {
            const auto& steps = plain[static_cast<std::size_t>(quantities[k])];
            double expected = test::total(steps);
            if (quantities[k] == Quantity::air_temperature)
                expected /= static_cast<double>(steps.size());
            EXPECT_NEAR(answer.annual[k], expected, 1e-8 * std::abs(expected))
                << effect.name << " " << physics::name_of(quantities[k]);
        }
    }
    EXPECT_GT(seen.size(), 50u);
}

}  // namespace
}  // namespace bemcal::effects
