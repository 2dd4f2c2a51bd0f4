#include "base/error.hpp"
#include "effects/loads.hpp"
#include "job/small_office.hpp"
#include "loop/model.hpp"
#include "loop/windy_case.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using namespace bemcal::study;

namespace {

std::size_t refinement(const std::string& name) {
    const auto& all = effects::refinements();
    const auto found = std::ranges::find(all, name, &effects::Refinement::name);
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

TEST(LoopModel, AParameterFollowsItsNumberIntoAStructure) {
    LoopData data = windy_data();
    physics::Zone& zone = data.building.building.zones[0];
    zone.thermostat.cooling_capacity = {60};
    zone.flows.push_back({"fans", {0.8, 0, 0}, {}});
    physics::Parameter fans;
    fans.name = "fans";
    fans.effect = physics::Effect::factor;
    fans.nominal = 1;
    fans.targets = physics::resolve(data.building.building,
                                    "zone." + zone.name + ".flow.fans.air_change");
    data.building.parameters.push_back(fans);
    data.building.priors.emplace_back();
    const BuiltModel built =
        build(make_place(data, {refinement("terminals with reheat")}, data.drive), {});
    const auto own =
        std::ranges::find(built.parameters, "fans", &physics::Parameter::name);
    ASSERT_NE(own, built.parameters.end());
    const double half = 0.5;
    physics::Building changed = built.placed->building;
    physics::apply(built.placed->building, {&*own, 1}, {&half, 1}, changed);
    EXPECT_EQ(changed.air_systems[0].outdoor_air_change.value, 0.4);
}

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
    for (std::size_t k = 0; k < effects::refinements().size(); ++k) {
        physics::Building building = data.building.building;
        const auto change = effects::refinements()[k].change;
        if (change == nullptr || !change(building)) continue;  // it cannot enter
        EXPECT_EQ(make_place(data, {k}, data.drive).building.planes.size(),
                  data.drive->irradiance.rows)
            << effects::refinements()[k].name;
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
    EXPECT_DOUBLE_EQ(share.least, 0.05);
    EXPECT_EQ(share.most, 0.45);
}

// Beyond, a second mass would be the ground.
TEST(LoopModel, ANumberOfTheStructureStaysNearItsPrior) {
    const LoopData data = windy_data();
    const Place place = make_place(data, {refinement("second mass")}, data.drive);
    const FitUnknown& capacity = place.unknowns.back();
    EXPECT_EQ(capacity.name, "second_mass_capacity");
    EXPECT_EQ(capacity.unit, "J/(m2 K)");
    EXPECT_DOUBLE_EQ(capacity.highest(), 2.5);
    EXPECT_EQ(capacity.least, 20000);
    EXPECT_EQ(place.parameters.back().most, capacity.most);
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

TEST(LoopModel, WhatTellsOfTheStateBeforeIsNotRead) {
    const auto n_missing = [](const Case& made) {
        const auto measured = LoopData(made, LoopOptions{}).targets.measured;
        return std::ranges::count_if(measured, [](double v) { return std::isnan(v); });
    };
    EXPECT_EQ(n_missing(measured_case()), 0);  // a week of weather before it is known
    Case made = measured_case();
    made.periods[0].from = made.weather.axis.start;
    made.meters[0].axis.start = made.weather.axis.start;
    EXPECT_EQ(n_missing(made), 48);
    made.periods[0].to = made.periods[0].from + std::chrono::days(20);
    EXPECT_EQ(n_missing(made), 48);
    made.periods[0].to -= std::chrono::hours(1);
    EXPECT_EQ(n_missing(made), 0);  // too little would be left
}

TEST(LoopModel, EffectsMayFollowTheJobsSeries) {
    Case rainy = measured_case();
    test::add_rain(rainy);
    const auto follow_rain = [&](const LoopOptions& options) {
        const LoopData data(rainy, options);
        const Place place = make_place(data, {}, data.drive);
        const auto all =
            effects::generic_candidates(*place.surroundings, data.quantities());
        return std::ranges::count(all, "rain", &effects::Effect::column);
    };
    LoopOptions options;
    EXPECT_EQ(follow_rain(options), 0);
    options.columns = {"rain"};
    EXPECT_GT(follow_rain(options), 0);
    const LoopData data(rainy, options);
    const Place place = make_place(data, {}, data.drive);
    const auto& values = place.surroundings->columns.at("rain");
    ASSERT_EQ(values.size(), static_cast<std::size_t>(data.drive->n_steps()));
    const auto first = static_cast<std::size_t>(data.drive->n_warm_up);
    for (std::size_t k = 0; k < 100; ++k)  // training begins on the seventh day
        EXPECT_EQ(values[first + k], rainy.profiles.back().values[7 * 24 + k]);
}

TEST(LoopModel, WhatIsCalibratedAlreadyKeepsItsPrior) {
    Case declared = measured_case();
    physics::Parameter share;
    share.name = "emitter_lag";  // the name of the refinement's other number
    share.least = 0.1;
    share.most = 0.6;
    share.nominal = 0.3;
    share.targets = physics::resolve(declared.building, "zone.*.emitter_radiant_share");
    declared.parameters.push_back(share);
    declared.priors.push_back(declared.priors.back());
    const LoopData data(declared, LoopOptions{});
    const Place place = make_place(data, {refinement("emitter")}, data.drive);
    std::vector<std::string> names;
    for (const FitUnknown& unknown : place.unknowns) names.push_back(unknown.name);
    EXPECT_EQ(std::ranges::count(names, "emitter_lag"), 1);
    EXPECT_EQ(names.back(), "emitter_lag of the structure");
    EXPECT_EQ(std::ranges::count(names, "radiant_share"), 0);
    EXPECT_EQ(place.parameters.size(), place.unknowns.size());
}

TEST(LoopModel, MetersThatShowNothingWeighLittle) {
    Case two = measured_case();
    Meter empty = two.meters[0];
    empty.name = "district";
    empty.quantity = physics::Quantity::district;
    empty.values.assign(empty.values.size(), 0);
    two.meters.push_back(empty);
    for (const bool both_empty : {false, true}) {
        if (both_empty) two.meters[0].values = empty.values;
        const LoopData data(two, LoopOptions{});
        const std::vector<double> none(data.targets.size(), 0);
        for (const ChannelNoise& noise : noise_of(data, none)) {
            EXPECT_GT(noise.share, 0);
            EXPECT_GT(noise.sigma, 1e-3);
        }
        EXPECT_EQ(noise_of(data, none)[1].share, 0.01);
    }
}

// Of the largest meter's 100 kWh in an hour.
TEST(LoopModel, AMeterCountsWholeFromATenthOn) {
    EXPECT_EQ(share_of_meter(10.1, 100), 1);
    EXPECT_LT(share_of_meter(9.9, 100), 1);
    EXPECT_GT(share_of_meter(0.11, 100), 0.01);
    EXPECT_EQ(share_of_meter(0.09, 100), 0.01);
}

// A day's reading is 24 hours', and a month's 730: no meter counts more for being read
// less often.
TEST(LoopModel, SharesAreOfEnergyByTheHour) {
    using physics::Interval;
    Case two = measured_case();
    two.meters[0].values.assign(two.meters[0].values.size(), 5);
    Meter other = two.meters[0];
    other.name = "electricity";
    other.quantity = physics::Quantity::electricity;
    for (const auto& [interval, of_reading] :
         {std::pair{Interval::daily, 24.0}, {Interval::monthly, 730.0}}) {
        other.interval = interval;
        other.values.assign(other.values.size(), 5 * of_reading);
        two.meters.resize(1);
        two.meters.push_back(other);
        const LoopData data(two, LoopOptions{});
        for (const ChannelNoise& noise :
             noise_of(data, std::vector<double>(data.targets.size(), 1)))
            EXPECT_EQ(noise.share, 1);
    }
}

namespace {

/// The office with an effect, and a line before all else.
Case office_with(const std::string& effect, const std::string& structure = "") {
    const job::Folder folder;
    const std::string text = job::replaced(job::small_office_text(), "[[parameter]]",
                                           "[[effect]]\n" + effect + "\n\n[[parameter]]");
    return job::read_job(job::write_small_office(folder, structure + text))
        .buildings.at(0);
}

}  // namespace

// It brings scheduled inputs, which an effect of the operation would enter, too.
TEST(Model, DeclaredEffectsStayWhereAStructureBringsInputsOfTheirs) {
    const LoopData data(office_with("name = \"as on a Monday\"\nhook = \"operation\"\n"
                                    "driver = \"another day's schedule\"\nat = 0\n"
                                    "weekday = \"saturday\"\ncoefficient = 0.5"),
                        LoopOptions{});
    const std::vector<std::size_t> structure{refinement("terminals with reheat")};
    EXPECT_EQ(make_place(data, structure, data.drive).drive, data.drive);
    EXPECT_EQ(
        drive_with_loads(data, structure, effects::no_loads(*data.drive), data.drive),
        data.drive);
    EXPECT_NE(drive_with_loads(data, {}, effects::no_loads(*data.drive), data.drive),
              data.drive);
}

// As in a job that has the effect and the structure.
TEST(Model, DeclaredEffectsFollowTheSunThroughTheGlassOfTheStructure) {
    const std::string less_sun =
        "name = \"less sun\"\nhook = \"gains\"\n"
        "driver = \"sun on the sunniest window\"\ncoefficient = -0.01";
    const auto row_in = [](const Case& made, const physics::Drive& drive) {
        const auto row = drive.profiles.row(made.declared_effects->first_row);
        return std::vector<double>(row.begin(), row.end());
    };
    const Case plain = office_with(less_sun),
               with_glass = office_with(less_sun, "structure = [\"glass by angle\"]\n");
    const LoopData data(plain, LoopOptions{});
    const Place place = make_place(data, {refinement("glass by angle")}, data.drive);
    EXPECT_EQ(row_in(plain, *place.drive),
              row_in(with_glass, study::drive_of(with_glass, with_glass.periods[0])));
    EXPECT_NE(row_in(plain, *place.drive), row_in(plain, *data.drive));
}

TEST(LoopModel, ARefinementWithNothingToRefineIsRefusedByName) {
    Case dark = measured_case();
    for (physics::Surface& surface : dark.building.zones[0].surfaces)
        surface.in_sun = false;
    const LoopData data(dark, LoopOptions{});
    try {
        make_place(data, {refinement("sun through walls")}, data.drive);
        FAIL() << "not refused";
    } catch (const CannotSimulate& error) {
        EXPECT_STREQ(error.what(), "nothing for 'sun through walls' to change");
    }
}
