/// Sums and largest readings are those of the file.
#include "job/small_office.hpp"
#include "plan/meter_text.hpp"

#include <gtest/gtest.h>

namespace bemcal::plan {
namespace {

/// Of one zone of 100 m2, with readings of two days.
study::Case read_over_two_days() {
    study::Case building = job::small_office_with("");
    building.building.zones.resize(1);
    building.building.zones[0].floor_area = 100;
    const physics::Seconds from = physics::parse_time("2021-01-05");
    building.periods = {{"training", from, from + std::chrono::hours(48)}};
    study::Meter gas{"gas",
                     physics::Quantity::gas,
                     physics::Interval::hourly,
                     {from, 3600, 48},
                     std::vector<double>(48, 2.0)};
    gas.values[14] = 7;
    gas.values[20] = nan;
    gas.unit = "m3";
    study::Meter room{"room",
                      physics::Quantity::air_temperature,
                      physics::Interval::hourly,
                      {from, 3600, 48},
                      std::vector<double>(48, 21.0)};
    building.meters = {gas, room};
    return building;
}

TEST(MeterText, SaysWhatWasRead) {
    // 46 hours of 2 kWh and one of 7 are 99 kWh in 47 hours.
    EXPECT_EQ(meter_lines(read_over_two_days()),
              "  meter, gas: gas, hourly, in kWh from m3\n"
              "    training: 47 of 48 readings, 99 kWh, 184.5 kWh/(m2 a), largest 7 from "
              "2021-01-05 14:00:00\n"
              "  meter, room: air_temperature, hourly\n"
              "    training: 48 of 48 readings, mean 21 degC, largest 21 from 2021-01-05 "
              "00:00:00\n");
}

TEST(MeterText, APeriodWithoutReadingsHasNoLine) {
    study::Case building = read_over_two_days();
    building.meters.resize(1);
    building.meters[0].values.assign(48, nan);
    EXPECT_EQ(meter_lines(building), "  meter, gas: gas, hourly, in kWh from m3\n");
}

}  // namespace
}  // namespace bemcal::plan
