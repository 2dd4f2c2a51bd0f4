/// The parts of a building that paper 2's school room needs: layers, links, a radiator,
/// a register of presence.
#include "job/small_office.hpp"
#include "physics/derived.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr const char *wall = "u_value = 0.6\nsolar_absorptance = 0.5\n",
                     *layers =
                         "[[construction.layer]]\nthickness = 0.1\n"
                         "conductivity = 0.04\ndensity = 30\nspecific_heat = 1400\n"
                         "[[construction.layer]]\nname = \"brick\"\nthickness = 0.24\n"
                         "conductivity = 0.8\ndensity = 1840\nspecific_heat = 900\n",
                     *first_parameter = "[[parameter]]\nname = \"infiltration\"",
                     *first_surface = "[[zone.surface]]\nname = \"south\"";

/// The parameter of U-values is left with the roof's.
std::string layered_office() {
    return replaced(replaced(small_office_text(), wall, layers),
                    "\"construction.wall.u_value\", ", "");
}

std::string with_radiator(const std::string& keys) {
    std::string text = small_office_text();
    for (const char* line :
         {"heating_set_point = {value = 20, low = 15, schedule = \"plant\"}\n",
          "heating_capacity = 40\n"})
        text = replaced(text, line, "");
    return replaced(text, first_surface,
                    "[zone.radiator]\nnominal_power = 30000\nheat_capacity = 500000\n"
                    "maximum_flow = 0.3\n" +
                        keys + first_surface);
}

TEST(SchoolRoom, LayersMakeTheUValue) {
    const Folder folder;
    const Job job = read_job(write_small_office(folder, layered_office()));
    const physics::Construction& read = job.buildings[0].building.constructions[0];
    ASSERT_EQ(read.layers.size(), 2U);
    EXPECT_EQ(read.layers[0].name, "layer_1");
    EXPECT_EQ(read.layers[1].density, 1840);
    EXPECT_NEAR(read.u_value.value, 1 / (0.04 + 0.1 / 0.04 + 0.24 / 0.8 + 0.13), 1e-12);
}

TEST(SchoolRoom, LayersMakeTheCapacity) {
    const Folder folder;
    const Job job = read_job(write_small_office(
        folder, replaced(layered_office(), "class = \"heavy\"", "class = \"layers\"")));
    const physics::Zone& zone = job.buildings[0].building.zones[0];
    EXPECT_NEAR(zone.heat_capacity * 1500, 240 * 0.1 * 1840 * 900, 1e-3);
    EXPECT_NEAR(zone.mass_area_ratio * 1500, 240, 1e-9);
}

TEST(SchoolRoom, LinksAreFollowedInTheirOrder) {
    const Folder folder;
    const std::string links =
        "[[link]]\ntarget = \"construction.wall.layer.brick.conductivity\"\n"
        "of = \"construction.wall.layer.brick.density\"\n"
        "term = [{factor = -0.12}, {factor = 0.0005, exponents = [1]}]\n"
        "[[link]]\ntarget = \"zone.office.bridge_conductance\"\n"
        "of = \"construction.wall.layer.brick.conductivity\"\n"
        "term = [{factor = 10, exponents = [2]}]\n"
        "[[link]]\ntarget = [\"glazing.*.u_value\", "
        "\"glazing.*.solar_transmittance\"]\n"
        "of = \"glazing.double.type\"\n"
        "row = [{key = 1, values = [1.4, 0.6]}, {key = 2, values = [0.7, 0.5]}]\n";
    const Job job = read_job(write_small_office(
        folder, replaced(layered_office(), first_parameter, links + first_parameter)));
    const physics::Building& building = job.buildings[0].building;
    ASSERT_EQ(building.links.size(), 3U);
    EXPECT_NEAR(building.constructions[0].layers[1].conductivity, 0.8, 1e-12);
    EXPECT_NEAR(building.zones[0].bridge_conductance, 6.4, 1e-12);
    EXPECT_EQ(building.glazings[0].u_value.value, 1.4);
    EXPECT_EQ(building.glazings[0].solar_transmittance.value, 0.6);
}

/// A parameter at its end must not take what follows it out of its range.
TEST(SchoolRoom, RangeOfAParameterHoldsForWhatFollows) {
    const Folder folder;
    const std::string job = replaced(
        layered_office(), first_parameter,
        "[[link]]\ntarget = \"construction.wall.layer.brick.conductivity\"\n"
        "of = \"construction.wall.layer.brick.density\"\n"
        "term = [{factor = -0.12}, {factor = 0.0005, exponents = [1]}]\n"
        "[[parameter]]\nname = \"rho\"\n"
        "target = \"construction.wall.layer.brick.density\"\nmin = 200\nmax = 2000\n" +
            std::string(first_parameter));
    const std::string message = message_of(write_small_office(folder, job));
    EXPECT_NE(message.find("parameter.min: makes the linked conductivity = -0.02"),
              std::string::npos)
        << message;
}

TEST(SchoolRoom, RadiatorTakesEveryKey) {
    const Folder folder;
    const Job job = read_job(write_small_office(
        folder, with_radiator("exponent = 1.25\nradiative_fraction = 0.4\nelements = 2\n"
                              "curve_a = -2\ncurve_b = 60\ncurve_c = 40\ncurve_d = 20\n"
                              "curve_limit = 9\nset_back_below = 13\n"
                              "scheduled = {value = 1, schedule = \"plant\"}\n"
                              "supply_temperature = 55\nflow = 0.5\n")));
    const physics::ZoneRadiator& read = *job.buildings[0].building.zones[0].radiator;
    EXPECT_EQ(read.radiator.exponent, 1.25);
    EXPECT_EQ(read.radiator.power_60, 30000);
    EXPECT_EQ(read.radiator.capacity, 500000);
    EXPECT_EQ(read.radiator.radiative_fraction, 0.4);
    EXPECT_EQ(read.radiator.most_flow, 0.3);
    EXPECT_EQ(read.radiator.n_elements, 2);
    EXPECT_EQ(read.curve.a, -2);
    EXPECT_EQ(read.curve.b, 60);
    EXPECT_EQ(read.curve.c, 40);
    EXPECT_EQ(read.curve.d, 20);
    EXPECT_EQ(read.curve.limit, 9);
    EXPECT_EQ(read.curve.set_back, 13);
    EXPECT_GE(read.scheduled.profile, 0);
    EXPECT_EQ(read.measured.value, 1);
    EXPECT_EQ(read.supply_temperature.value, 55);
    EXPECT_EQ(read.flow.value, 0.5);
}

TEST(SchoolRoom, CurveHoldsWhereNoSupplyIsMeasured) {
    const Folder folder;
    const Job job = read_job(write_small_office(folder, with_radiator("")));
    EXPECT_EQ(job.buildings[0].building.zones[0].radiator->measured.value, 0);
}

TEST(SchoolRoom, RegisterIsReadByDay) {
    const Folder folder;
    folder.write("register.csv", "date,persons\n2021-01-04,20\n2021-01-05,18\n");
    const Job job = read_job(write_small_office(
        folder, replaced(small_office_text(), "weekend = 0\n",
                         "weekend = 0\nregister = \"register.csv\"\n")));
    const physics::Schedule& occupied = job.buildings[0].profiles[0].schedule;
    ASSERT_TRUE(occupied.days);
    EXPECT_EQ(physics::values_of(
                  occupied, {physics::parse_time("2021-01-05 09:00"), 3600, 1}, 8)[0],
              18);
    EXPECT_EQ(physics::values_of(
                  occupied, {physics::parse_time("2021-01-06 09:00"), 3600, 1}, 8)[0],
              0);
}

}  // namespace
}  // namespace bemcal::job
