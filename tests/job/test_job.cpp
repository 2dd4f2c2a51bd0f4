/// Whole jobs: what the sample becomes, and how sections, files and defaults meet.
#include "job/job.hpp"

#include <gtest/gtest.h>

#include "job/small_office.hpp"

namespace bemcal::job {
namespace {

TEST(Job, SampleBecomesABuildingWithItsNumbers) {
    const Folder folder;
    const Job job = read_job(write_small_office(folder));
    EXPECT_EQ(job.name, "small_office");
    EXPECT_EQ(job.seed, 7U);
    ASSERT_EQ(job.buildings.size(), 1U);
    const study::Case& office = job.buildings[0];
    ASSERT_EQ(office.building.zones.size(), 1U);
    const physics::Zone& zone = office.building.zones[0];
    EXPECT_EQ(zone.heat_capacity, 260000);   // class heavy
    EXPECT_EQ(zone.mass_area_ratio, 3.0);
    EXPECT_EQ(zone.surfaces.size(), 4U);
    EXPECT_EQ(zone.surfaces[2].name, "surface_3");
    EXPECT_EQ(zone.surfaces[3].boundary, 0);
    EXPECT_FALSE(zone.surfaces[3].in_sun);
    EXPECT_EQ(office.building.planes.size(), 3U);   // south, north, roof
    EXPECT_EQ(zone.thermostat.heating_set_point.value, 20);
    EXPECT_EQ(zone.thermostat.heating_set_point.low, 15);
    EXPECT_EQ(zone.thermostat.heating_set_point.profile, 1);
    EXPECT_EQ(zone.loads[1].carrier, physics::Carrier::electricity);
    EXPECT_EQ(zone.windows[0].shading.value, 0.9);
}

}  // namespace
}  // namespace bemcal::job
