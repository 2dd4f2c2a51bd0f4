#include "study/loop_model.hpp"
#include "study/windy_case.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::study;

namespace {

std::size_t refinement(const std::string& name) {
    const auto& all = refinements();
    const auto found = std::ranges::find(all, name, &Refinement::name);
    return static_cast<std::size_t>(found - all.begin());
}

const physics::Plane& plane_of(const Place& place, int plane) {
    return place.building.planes.at(static_cast<std::size_t>(plane));
}

Case measured_case() {
    Case made = test::windy_case();
    test::measure(made, test::named("wind infiltration"), 0.08, 3);
    return made;
}

LoopData windy_data() {
    return {measured_case(), LoopOptions{}};
}

}  // namespace

TEST(LoopModel, RefinementsOfGlassAndWallsKeepToTheirOwn) {
    const LoopData data = windy_data();
    const Place both =
        make_place(data, {refinement("glass by angle"), refinement("sun through walls")},
                   data.drive);
    const Place described = make_place(data, {}, data.drive);
    const physics::Zone &zone = both.building.zones[0],
                        &plain = described.building.zones[0];
    for (const physics::Window& window : zone.windows) {
        EXPECT_FALSE(plane_of(both, window.plane).modifier.empty());
        EXPECT_EQ(plane_of(both, window.plane).lag_hours, 0);
    }
    for (std::size_t s = 0; s < zone.surfaces.size(); ++s) {
        if (!zone.surfaces[s].in_sun || zone.surfaces[s].boundary != physics::outdoors)
            continue;
        EXPECT_GT(plane_of(both, zone.surfaces[s].plane).lag_hours, 0);
        EXPECT_TRUE(plane_of(both, zone.surfaces[s].plane).modifier.empty());
        EXPECT_EQ(plane_of(described, plain.surfaces[s].plane).lag_hours, 0);
    }
}

TEST(LoopModel, EveryStructureSharesOneDrive) {
    const LoopData data = windy_data();
    for (std::size_t k = 0; k < refinements().size(); ++k) {
        if (refinements()[k].change == nullptr) continue;
        EXPECT_EQ(make_place(data, {k}, data.drive).building.planes.size(),
                  data.drive->irradiance.rows)
            << refinements()[k].name;
    }
}

TEST(LoopModel, RefinementsOfTheSunGoTogether) {
    const LoopData data = windy_data();
    const Place place =
        make_place(data,
                   {refinement("sky of Hay and Davies"), refinement("sun through walls"),
                    refinement("glass by angle")},
                   data.drive);
    EXPECT_EQ(place.building.planes.size(), data.drive->irradiance.rows);
    for (const physics::Window& window : place.building.zones[0].windows) {
        const physics::Plane& plane = plane_of(place, window.plane);
        EXPECT_EQ(plane.sky, physics::SkyModel::hay_davies);
        EXPECT_LT(plane.diffuse_modifier, 1);
    }
    for (const physics::Surface& surface : place.building.zones[0].surfaces) {
        if (!surface.in_sun || surface.boundary != physics::outdoors) continue;
        const physics::Plane& plane = plane_of(place, surface.plane);
        EXPECT_EQ(plane.sky, physics::SkyModel::hay_davies);
        EXPECT_EQ(plane.diffuse_modifier, 1);
        EXPECT_GT(plane.lag_hours, 0);
    }
}

TEST(LoopModel, InfiltrationByWindStaysAShareOfIt) {
    const LoopData data = windy_data();
    const Place place = make_place(data, {refinement("wind in leaks")}, data.drive);
    const BuiltModel built = build(place, {});
    const FitUnknown& share = built.unknowns.back();
    EXPECT_EQ(share.name, "share of infiltration by wind");
    EXPECT_TRUE(share.has_prior);
    EXPECT_EQ(share.centre, 0.3);
    EXPECT_EQ(share.least, 0);
    EXPECT_EQ(share.most, 0.45);
}

TEST(LoopModel, MonthsAreLeftOutWhole) {
    Case monthly = measured_case();
    auto& gas = monthly.meters[0];
    gas.interval = physics::Interval::monthly;
    const LoopData data(monthly, LoopOptions{});
    EXPECT_TRUE(data.reads_months());
    EXPECT_TRUE(data.reads_months_only());
    for (std::size_t k = 0; k < data.blocks.size(); ++k)
        EXPECT_EQ(data.blocks[k], data.blocks[0] + static_cast<int>(k));
    EXPECT_FALSE(windy_data().reads_months());
}

TEST(LoopModel, MonthsAreMetNoBetterThanAModelDeserves) {
    Case monthly = measured_case();
    auto& gas = monthly.meters[0];
    gas.interval = physics::Interval::monthly;
    gas.values.assign(gas.values.size(), 1000);
    const LoopData data(monthly, LoopOptions{});
    const std::vector<double> none(data.targets.size(), 0), some(data.targets.size(), 2);
    const auto noise = noise_of(data, none);
    EXPECT_DOUBLE_EQ(noise[0].sigma, 30);
    const double gained =
        deviance(data.targets, noise, some) - deviance(data.targets, noise, none);
    EXPECT_GT(gained, 0);
    EXPECT_LT(gained, 0.02 * static_cast<double>(data.targets.size()));
}

TEST(LoopModel, ARefinementWithNothingToRefineIsRefusedByName) {
    Case dark = measured_case();
    for (physics::Surface& surface : dark.building.zones[0].surfaces)
        surface.in_sun = false;
    const LoopData data(dark, LoopOptions{});
    try {
        make_place(data, {refinement("sun through walls")}, data.drive);
        FAIL() << "not refused";
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "nothing for 'sun through walls' to change");
    }
}
