/// An hour of an air system: balances, hours worked by hand, limits, the way back.
#include "physics/air_system.hpp"
#include "physics/moist_air.hpp"
#include "physics/network.hpp"
#include "support/measured.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace bemcal::physics {

namespace {

/// A zone of 1,000 m2 in use: 3 W/m2 of fan, 1 l/(s m2) of outdoor air.
AirHour office() {
    AirHour hour;
    hour.theta_air = 24;
    hour.theta_e = 30;
    hour.w_e = 0.018;
    hour.q_e = 1;
    hour.q_inf = 0.1;
    hour.moisture = 0.002;
    hour.available = 1;
    hour.q_design = 6;
    hour.least_flow = 0.3;
    hour.fan_power = 9000;
    hour.fan_exponent = 2.5;
    hour.fan_heat = 1;
    hour.theta_supply = 13;
    hour.bypass_factor = 0.1;
    hour.frost_limit = -100;
    return hour;
}

constexpr double c_air = 1020;             ///< of moist air per dry air [J/(kg K)]
constexpr double rho = rho_c_air / c_air;  ///< dry air [kg/m3]

constexpr AirKind variable{true, true, 101325}, constant{false, true, 101325},
    dry_variable{true, false, 101325};

double sensible_of(const AirKind& kind, AirHour hour) {
    return supply({kind.variable, false, kind.pressure}, hour).cooling;
}

double least_of(const AirHour& hour) {
    return hour.least_flow * hour.q_design;
}

}  // namespace

// What coils give, less what they take, is what the zone asks for, less the fan's heat;
// of a constant flow with a small load, no more of that than the load.
TEST(AirSystem, SensibleHeatIsInBalance) {
    for (const bool follows : {true, false})
        for (const double load : {-60000.0, -8000.0, 4000.0, 30000.0, 90000.0}) {
            AirHour hour = office();
            hour.heating = std::max(load, 0.0);
            hour.cooling = std::max(-load, 0.0);
            const AirLoads loads = supply({follows, false, 101325}, hour);
            const double fan = follows ? loads.fan : std::min(loads.fan, std::fabs(load));
            EXPECT_NEAR(loads.heating - loads.cooling, load - fan, 1e-8)
                << follows << " " << load;
        }
}

// Over 11 K the least flow of 1.8 m3/s carries 23.76 kW; 27.2 kW ask for more.
TEST(AirSystem, FlowFollowsTheLoad) {
    AirHour hour = office();
    hour.theta_e = 24;
    hour.cooling = 27200;
    const double share = 27200 / (rho_c_air * 11) / 6;
    const AirLoads loads = supply(dry_variable, hour);
    EXPECT_NEAR(loads.fan, 9000 * std::pow(share, 2.5), 1e-9);
    EXPECT_NEAR(loads.cooling, 27200 + loads.fan, 1e-8);
    EXPECT_EQ(loads.heating, 0);
}

// Outdoors as warm as the room: the least flow carries 23.76 kW, of which 10 kW are
// wanted; terminals give the rest back.
TEST(AirSystem, TerminalsReheatTheLeastFlow) {
    AirHour hour = office();
    hour.theta_e = 24;
    hour.cooling = 10000;
    const AirLoads loads = supply(dry_variable, hour);
    EXPECT_NEAR(loads.heating, rho_c_air * least_of(hour) * 11 - 10000, 1e-8);
}

// The zone's own balance has 1.8 m3/s of supply air. It asks for nothing more, so that
// nothing is reheated; coil and fan make the supply air of return and outdoor air.
TEST(AirSystem, LeastSupplyAirIsNotReheatedWhereTheRoomAsksForNothing) {
    const AirKind supplies{true, false, 101325, true};
    AirHour hour = office();
    hour.q_supplied = 1.8;
    AirLoads loads = supply(supplies, hour);
    EXPECT_EQ(loads.heating, 0);
    EXPECT_NEAR(loads.fan, 9000 * std::pow(0.3, 2.5), 1e-9);
    const double mixed = 24 + 6 * 1 / 1.8;  // outdoors is 6 K warmer
    EXPECT_NEAR(loads.cooling, rho_c_air * 1.8 * (mixed - 13) + loads.fan, 1e-8);
    hour.heating = 5000;
    const AirLoads heated = supply(supplies, hour);
    EXPECT_NEAR(heated.heating, 5000, 1e-8);
    EXPECT_NEAR(heated.cooling, loads.cooling, 1e-8);
    hour.heating = 0;
    hour.cooling = 11000;
    loads = supply(supplies, hour);
    EXPECT_EQ(loads.heating, 0);
    EXPECT_NEAR(loads.fan, 9000 * std::pow((1.8 + 1000 / rho_c_air) / 6, 2.5), 1e-9);
    hour.heating = 3000;  // of other rooms
    const AirLoads both = supply(supplies, hour);
    EXPECT_NEAR(both.heating, 3000, 1e-8);
    EXPECT_NEAR(both.cooling, loads.cooling, 1e-8);
}

TEST(AirSystem, FanThatIsOffDoesNothing) {
    AirHour hour = office();
    hour.available = 0;
    hour.heating = 5000;
    const AirLoads loads = supply(variable, hour);
    EXPECT_EQ(loads.heating, 5000);
    EXPECT_EQ(loads.cooling + loads.fan, 0);
}

// A unit that cools by night turns for as long as it needs.
TEST(AirSystem, UnitCyclesByNight) {
    AirHour hour = office();
    hour.available = 0;
    hour.q_e = 0;
    hour.cooling = 13200;
    EXPECT_NEAR(supply(variable, hour).fan, 9000 * 13200 / (rho_c_air * 11) / 6, 1e-9);
}

// The water that the coil takes is what outdoor air and people bring in excess of the
// room's: the room is then as dry as the balance says, and no drier than the coil.
TEST(AirSystem, CoilDriesWhatComesIn) {
    AirHour hour = office();
    hour.cooling = 40000;
    const double latent = supply(variable, hour).cooling - sensible_of(variable, hour);
    const double brought = rho * (1 + 0.1) * hour.w_e + hour.moisture;
    const double taken = latent / heat_of_vapour;
    const double w_room = (brought - taken) / (rho * (1 + 0.1));
    EXPECT_GT(w_room, saturated_air(8, 101325).w);
    EXPECT_LT(w_room, saturated_air(15, 101325).w + 0.001);
}

TEST(AirSystem, DryAirLeavesTheCoilDry) {
    AirHour hour = office();
    hour.cooling = 40000;
    hour.w_e = 0.002;
    hour.moisture = 0;
    for (const AirKind& kind : {variable, constant})
        EXPECT_EQ(supply(kind, hour).cooling, sensible_of(kind, hour));
}

namespace {

/// Outdoor air alone, a bit of a load for the coil.
AirHour all_outdoors(double theta_e, double w_e) {
    AirHour hour = office();
    hour.theta_e = theta_e;
    hour.w_e = w_e;
    hour.q_e = hour.q_design;
    hour.q_inf = 0;
    hour.theta_supply = theta_e - 3;
    hour.cooling = rho_c_air * hour.q_design * 3;
    return hour;
}

}  // namespace

// Air of 17 degC and 7.3 g/kg, cooled by some kelvin, stays above its dew point. A coil
// that is on for a part of the hour is colder than that.
TEST(AirSystem, CoilThatIsOnOrOffDriesMildAir) {
    AirHour hour = all_outdoors(17, 0.0073);
    EXPECT_EQ(supply(variable, hour).cooling, sensible_of(variable, hour));
    hour.coil_enthalpy = 16600;
    EXPECT_GT(supply(variable, hour).cooling, 1.2 * sensible_of(variable, hour));
}

// From sensible and latent heat follow the surface's temperature and the water there,
// which is that of saturated air. Rated air, and other air, of which it takes less.
TEST(AirSystem, CoilTakesItsEnthalpyDownToASaturatedSurface) {
    for (const double theta_e : {26.7, 19.0})
        for (const AirKind& kind : {variable, constant}) {
            AirHour hour = all_outdoors(theta_e, theta_e > 20 ? 0.0111 : 0.0085);
            hour.coil_enthalpy = 16600;
            const double sensible = sensible_of(kind, hour);
            const double ratio = supply(kind, hour).cooling / sensible - 1;
            const double strength = 1 + 6.8e-6 * (enthalpy(theta_e, hour.w_e) - 55.2e3);
            const double fall =
                16600 * strength / (1 - hour.bypass_factor) / (c_air * (1 + ratio));
            const double water = ratio * c_air * fall / heat_of_vapour;
            EXPECT_GT(ratio, 0.1);
            EXPECT_NEAR(hour.w_e - water, saturated_air(theta_e - fall, 101325).w, 1e-9);
        }
}

// Where the load needs all that the coil has, it is on all the time: it modulates.
TEST(AirSystem, CoilWithoutReserveModulates) {
    AirHour hour = office();
    hour.cooling = 60000;
    const double modulating = supply(variable, hour).cooling;
    hour.coil_enthalpy = 14000;
    EXPECT_EQ(supply(variable, hour).cooling, modulating);
    hour.coil_enthalpy = 40000;
    EXPECT_GT(supply(variable, hour).cooling, modulating);
}

// 10 degC outdoors: opened wide, outdoor air takes all that the coil would.
TEST(AirSystem, EconomiserTakesTheCoilsWork) {
    AirHour hour = office();
    hour.theta_e = 10;
    hour.cooling = 20000;
    const double without = supply(dry_variable, hour).cooling;
    hour.economiser = 1;
    EXPECT_GT(without, 10000);
    EXPECT_EQ(supply(dry_variable, hour).cooling, 0);
    hour.theta_e = 30;
    const double hot = supply(dry_variable, hour).cooling;
    hour.economiser = 0;
    EXPECT_EQ(hot, supply(dry_variable, hour).cooling);
}

TEST(AirSystem, EconomiserLeavesTheRecoveryAside) {
    AirHour hour = office();
    hour.theta_e = 10;
    hour.heat_recovery = 0.8;
    hour.cooling = 12000;
    hour.economiser = 0.2;  // a little more than the least
    const double coil = supply({false, false, 101325}, hour).cooling;
    // 0.8 of 16.8 kW are not recovered; a share of 1/6 becomes 1/5.
    const double fan = 9000, recovered = 0.8 * 16800,
                 more = rho_c_air * 6 * (0.2 - 1.0 / 6) * 14;
    EXPECT_NEAR(coil, std::max(0.0, 12000 + fan - recovered - more), 1e-8);
}

// Exhaust air of 22 degC would leave at 22 - 0.8 * 32 = -3.6 degC; held at 2 degC the
// recovery is 20 / 32, and heating makes good for the rest.
TEST(AirSystem, FrostCutsTheRecovery) {
    AirHour hour = office();
    hour.theta_air = 22;
    hour.theta_e = -10;
    hour.heat_recovery = 0.8;
    hour.heating = 30000;
    const AirKind kind{false, false, 101325};
    const double before = supply(kind, hour).heating;
    hour.frost_limit = 2;
    EXPECT_NEAR(supply(kind, hour).heating - before,
                rho_c_air * 1 * (0.8 - 20.0 / 32) * 32, 1e-8);
}

TEST(AirSystem, HumidificationKeepsTheLeast) {
    AirHour hour = office();
    hour.theta_e = 0;
    hour.w_e = 0.002;
    hour.heating = 30000;
    const double before = supply(constant, hour).heating;
    hour.least_w = 0.006;
    EXPECT_NEAR(supply(constant, hour).heating - before,
                heat_of_vapour * (rho * 1.1 * 0.004 - 0.002), 1e-6);
    hour.least_w = 0.002;  // people bring more
    EXPECT_EQ(supply(constant, hour).heating, before);
}

namespace {

constexpr double AirHour::* numbers[] = {
    &AirHour::heating,      &AirHour::cooling,       &AirHour::theta_air,
    &AirHour::theta_e,      &AirHour::w_e,           &AirHour::q_e,
    &AirHour::q_inf,        &AirHour::moisture,      &AirHour::heat_recovery,
    &AirHour::available,    &AirHour::q_design,      &AirHour::least_flow,
    &AirHour::fan_power,    &AirHour::fan_exponent,  &AirHour::fan_heat,
    &AirHour::theta_supply, &AirHour::bypass_factor, &AirHour::coil_enthalpy,
    &AirHour::economiser,   &AirHour::frost_limit,   &AirHour::least_w,
    &AirHour::q_supplied};

/// Hours of all kinds, drawn.
AirHour drawn(std::mt19937_64& engine) {
    const auto between = [&](double least, double most) {
        return least + (most - least) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    };
    const auto chance = [&](double p) { return between(0, 1) < p; };
    AirHour hour = office();
    hour.theta_air = between(19, 27);
    hour.theta_e = between(-12, 36);
    hour.w_e = between(0.001, 0.02);
    hour.q_e = chance(0.9) ? between(0.2, 3) : 0;
    hour.q_inf = between(0, 0.5);
    hour.moisture = between(0, 0.004);
    hour.available = chance(0.8) ? between(0.5, 1) : 0;
    hour.heat_recovery = chance(0.5) ? between(0.3, 0.9) : 0;
    hour.economiser = chance(0.5) ? between(0.3, 1) : 0;
    hour.coil_enthalpy = chance(0.3) ? between(8000, 20000) : 0;
    hour.frost_limit = chance(0.5) ? between(0, 8) : -100;
    hour.least_w = chance(0.5) ? between(0.004, 0.009) : 0;
    if (chance(0.5))
        hour.cooling = between(0, 90000);
    else if (chance(0.8))
        hour.heating = between(0, 60000);
    return hour;
}

double seen(const AirKind& kind, const AirHour& hour) {
    const AirLoads loads = supply(kind, hour);
    return 1.3 * loads.heating - 0.7 * loads.cooling + 2.1 * loads.fan;
}

}  // namespace

// Central differences over two steps; where they differ, a limit lies between.
TEST(AirSystem, WayBackIsTheDerivative) {
    std::mt19937_64 engine(5);
    double worst = 0;
    int n_compared = 0;
    for (int draw = 0; draw < 3000; ++draw) {
        const bool varies = draw % 2 == 0;
        const AirKind kind{varies, draw % 5 != 0, 101325, varies && draw % 3 == 0};
        AirHour hour = drawn(engine);
        if (kind.supplies && hour.available > 0)
            hour.q_supplied = 0.1 + 0.5 * hour.available;
        if (kind.supplies && draw % 4 == 0) hour.heating = 0.1 * hour.cooling;
        const AirHour back = pull_supply(kind, hour, {1.3, -0.7, 2.1});
        for (double AirHour::* number : numbers) {
            if (hour.*number == 0) continue;  // most begin to act there
            const double size = std::max(std::fabs(hour.*number), 1e-3);
            double slope[2];
            for (int k = 0; k < 2; ++k) {
                const double h = (k + 1) * 1e-5 * size;
                AirHour more = hour, less = hour;
                more.*number += h;
                less.*number -= h;
                slope[k] = (seen(kind, more) - seen(kind, less)) / (2 * h);
            }
            const double scale = 1e3 / size;
            if (std::fabs(slope[0] - slope[1]) > 1e-6 * scale) continue;
            ++n_compared;
            worst = std::max(worst, std::fabs(back.*number - slope[0]) / scale);
        }
    }
    test::print_measured(
        "air system's derivative off differences, of 1 kW per relative "
        "change",
        worst, "-", "1e-6");
    EXPECT_GT(n_compared, 40000);
    EXPECT_LT(worst, 1e-6);
}

}  // namespace bemcal::physics
