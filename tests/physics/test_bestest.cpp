/// BESTEST: the hourly method against published results of a continuous 5R1C in the same
/// set-up, and against the acceptance limits of ASHRAE 140.
#include "physics/bestest_cases.hpp"
#include "physics/simulate.hpp"
#include "support/csv_table.hpp"
#include "support/epw_files.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

using input::TemperatureConvention;

struct Result {
    double heating = 0, cooling = 0;  ///< of the year [MWh]
    double coldest = 0, warmest = 0;  ///< [degC]
};

using Results = std::map<std::string, Result>;

Result run(const test::BestestCase& bestest, const Weather& weather) {
    const Building building = test::bestest_building(bestest);
    const Drive drive = make_drive(weather, building, test::bestest_profiles(),
                                   weather.axis.start, weather.axis.end(), 3600, 0);
    const Trajectory trajectory = simulate(building, drive);
    const ZoneTrajectory& zone = trajectory.zones[0];
    const auto sum = [](const std::vector<double>& power) {
        return std::accumulate(power.begin(), power.end(), 0.0) / 1e6;
    };
    const auto [low, high] = std::ranges::minmax(zone.theta_air);
    return {sum(zone.heating), sum(zone.cooling), low, high};
}

class Bestest : public testing::Test {
  protected:
    void SetUp() override {
        weather_ = test::shared_file("weather/725650TYCST.epw");
        published_ = test::shared_file("thermal/bestest_5r1c_modelica.csv");
        limits_ = test::shared_file("thermal/bestest_acceptance_limits.csv");
        for (const auto& file : {weather_, published_, limits_})
            if (test::is_absent(file)) GTEST_SKIP() << file;
    }

    Results run_all(TemperatureConvention convention) const {
        const Weather weather = test::read_epw(weather_, {convention, 2021}).weather;
        Results results;
        for (const test::BestestCase& bestest : test::bestest_cases())
            results[bestest.name] = run(bestest, weather);
        return results;
    }

    /// A quantity of the published 5R1C, by case.
    std::map<std::string, double> published(const std::string& quantity) const {
        const test::CsvTable table(published_);
        std::map<std::string, double> values;
        for (std::size_t row = 0; row < table.n_rows(); ++row)
            if (table.text(row, "program") == "ISO13790" &&
                table.text(row, "quantity") == quantity)
                values[table.text(row, "case")] = table.number(row, "value");
        return values;
    }

    int n_within_limits(const Results& results, std::string& outside) const;
    std::filesystem::path weather_, published_, limits_;
};

double deviation(double own, double published) {  // [%]
    return published == 0 ? 100 * own : 100 * (own / published - 1);
}

/// Largest and smallest deviation of all cases; expects each within `most` percent.
struct Spread {
    double least = 0, most = 0;
};

Spread compare(const std::map<std::string, double>& published, const Results& results,
               double Result::* quantity, double most) {
    Spread spread;
    for (const auto& [name, value] : published) {
        const double percent = deviation(results.at(name).*quantity, value);
        EXPECT_LE(std::abs(percent), most) << "case " << name;
        spread = {std::min(spread.least, percent), std::max(spread.most, percent)};
    }
    return spread;
}

void print(const std::string& what, const Spread& spread) {
    test::print_measured(what + ", 20 cases, lowest", spread.least, "%", "5");
    test::print_measured(what + ", 20 cases, highest", spread.most, "%", "5");
}

int Bestest::n_within_limits(const Results& results, std::string& outside) const {
    const test::CsvTable table(limits_);
    int within = 0, n = 0;
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
        const auto found = results.find(table.text(row, "case"));
        if (found == results.end()) continue;
        const bool heating =
            table.text(row, "quantity").find("Heating") != std::string::npos;
        const double value = heating ? found->second.heating : found->second.cooling;
        const bool inside =
            value >= table.number(row, "lower") && value <= table.number(row, "upper");
        if (!inside)
            outside += fmt::format(" {} {} {:.3f}", found->first,
                                   heating ? "heating" : "cooling", value);
        within += inside;
        ++n;
    }
    EXPECT_EQ(n, 40);
    return within;
}

TEST_F(Bestest, AgreesWithThePublishedFiveResistorRoom) {
    for (auto convention :
         {TemperatureConvention::hour_mean, TemperatureConvention::as_read}) {
        const bool mean = convention == TemperatureConvention::hour_mean;
        SCOPED_TRACE(mean ? "hour-mean temperature" : "temperature as read");
        const Results results = run_all(convention);
        const auto heating = published("Annual heating load (MWh)");
        const auto cooling = published("Annual cooling load (MWh)");
        ASSERT_EQ(heating.size(), 20u);
        const Spread of_heating = compare(heating, results, &Result::heating, 5);
        const Spread of_cooling = compare(cooling, results, &Result::cooling, 5);
        std::string outside;
        const int within = n_within_limits(results, outside);
        EXPECT_GE(within, 33);
        const std::string with =
            mean ? ", hour-mean temperature" : ", temperature as read";
        print("BESTEST heating" + with, of_heating);
        print("BESTEST cooling" + with, of_cooling);
        test::print_measured("BESTEST cases inside the ASHRAE 140 limits, of 40" + with,
                             within, "cases", "at least 33");
        std::cout << "outside:" << outside << '\n';
    }
}

TEST_F(Bestest, AgreesInTheExtremesOfFreeFloatingRooms) {
    const Results results = run_all(TemperatureConvention::hour_mean);
    const auto coldest = published("Minimum temperature (degC)");
    const auto warmest = published("Maximum temperature (degC)");
    ASSERT_EQ(coldest.size(), 6u);
    double low = 0, high = 0;
    for (const auto& [name, value] : coldest) {
        const Result& own = results.at(name);
        EXPECT_NEAR(own.coldest, value, 1.5) << name;
        EXPECT_NEAR(own.warmest, warmest.at(name), 1.5) << name;
        low = std::max(low, std::abs(own.coldest - value));
        high = std::max(high, std::abs(own.warmest - warmest.at(name)));
    }
    test::print_measured("BESTEST free-floating, largest error of the coldest hour", low,
                         "K", "1.5");
    test::print_measured("BESTEST free-floating, largest error of the warmest hour", high,
                         "K", "1.5");
}

}  // namespace
}  // namespace bemcal::physics
