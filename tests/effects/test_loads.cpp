/// What follows loads must not change them: invariants of the hooks' table.
#include "base/error.hpp"
#include "effects/hooks.hpp"
#include "effects/loads.hpp"
#include "office.hpp"

#include <gtest/gtest.h>

namespace bemcal::effects {
namespace {

using test::Office;

/// Of the office with a constant at a hook; nothing where none can enter.
std::optional<ModelSeries> loads_with(const Office& office, const HookRow& row) {
    Effect effect{.name = row.name, .hook = row.hook, .least = -1, .most = 1};
    if (row.kind == physics::ChangeKind::schedule) return std::nullopt;
    if (effect.hook == Hook::neighbour) effect.driver = Driver::ground;
    if (row.is_at_a_meter) effect.meter = physics::Quantity::gas;
    const Placed placed = place(std::span(&effect, 1), office.around);
    physics::Building building = placed.building;
    physics::apply(placed.building, placed.parameters, std::vector<double>{0.2},
                   building);
    return loads_of(building, placed.drive);
}

TEST(Loads, StayAsTheyAreAtHooksThatSayTheyDo) {
    const Office office;
    const ModelSeries as_described = loads_of(office.building, office.drive);
    int n_leave = 0;
    for (const HookRow& row : hook_rows()) {
        if (!row.leaves_loads) continue;
        const auto loads = loads_with(office, row);
        ASSERT_TRUE(loads) << row.name;
        EXPECT_EQ(loads->heating, as_described.heating) << row.name;
        EXPECT_EQ(loads->cooling, as_described.cooling) << row.name;
        ++n_leave;
    }
    EXPECT_EQ(n_leave, 4);
    for (const Hook hook : {Hook::gains, Hook::infiltration, Hook::heating_set_point}) {
        EXPECT_FALSE(leaves_loads(hook));
        EXPECT_NE(loads_with(office, row_of(hook))->heating, as_described.heating);
    }
}

TEST(Loads, OfTheWarmUpAreThoseOfTheFirstSteps) {
    const Office office;
    const ModelSeries loads = loads_of(office.building, office.drive);
    const auto n = static_cast<std::size_t>(office.drive.n_warm_up);
    ASSERT_EQ(loads.heating.size(), static_cast<std::size_t>(office.drive.n_steps()));
    for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(loads.heating[k], loads.heating[n + k]);
    EXPECT_EQ(loads.most_heating, *std::ranges::max_element(loads.heating));
    EXPECT_EQ(no_loads(office.drive).cooling, std::vector(loads.cooling.size(), 0.0));
}

}  // namespace
}  // namespace bemcal::effects
