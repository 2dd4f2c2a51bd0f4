/// One hour of Annex C against published steps, and the properties that it must have.
#include "physics/hour.hpp"
#include "support/csv_table.hpp"
#include "support/measured.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// RC_BuildingSimulator's test office (commit 97c1cdd), H_tr_em fed as given.
Network office() {
    Network n;
    n.A_f = 34.3;
    n.A_m = 85.75;
    n.A_tot = 142.38;
    n.C_m = 5659500;
    n.H_tr_em = 0.338;
    n.H_tr_w = 14.85;
    n.H_ve = 212.66 / 3;
    n.H_tr_ms = 780.325;
    n.H_tr_is = 491.211;
    return n;
}

HourDrive same_everywhere(double theta, double phi_int = 0, double phi_sol = 0) {
    return {theta, theta, theta, phi_int, phi_sol};
}

Control office_control() {
    Control control;
    control.phi_H_max = control.phi_C_max = 12 * 34.3;
    return control;
}

/// A random zone in which nothing rings: every conductance over four decades.
Network random_network(std::mt19937_64& random) {
    const auto any = [&random](double low, double high) {
        std::uniform_real_distribution<double> exponent(std::log(low), std::log(high));
        return std::exp(exponent(random));
    };
    Network n;
    n.A_f = any(10, 1e4);
    n.A_m = n.A_f * any(2.5, 3.5);
    n.A_tot = n.A_f * 4.5;
    n.C_m = n.A_f * any(8e4, 4e5);
    n.H_tr_em = n.A_f * any(1e-3, 5);
    n.H_tr_w = n.A_f * any(1e-3, 5);
    n.H_ve = n.A_f * any(1e-3, 5);
    n.H_tr_ms = 9.1 * n.A_m;
    n.H_tr_is = 3.45 * n.A_tot;
    return n;
}

constexpr double relative = 1e-9;

// RC_BuildingSimulator, test_HeatingRequired; the free step recomputed with a script of
// its own.
TEST(Hour, GivesThePublishedFreeFloatingStep) {
    const Network n = office();
    const HourDrive drive = same_everywhere(10, 10, 2000);
    const NodeTemperatures free =
        advance_hour(n, drive, split_gains(n, drive.phi_int, drive.phi_sol), 20, 0);
    EXPECT_NEAR(free.theta_m_t, 20.755385468, 5e-10);
    EXPECT_NEAR(free.theta_m, 20.377692734, 5e-10);
    EXPECT_NEAR(free.theta_s, 20.356550454, 5e-10);
    EXPECT_NEAR(free.theta_air, 19.059371364, 5e-10);
}

TEST(Hour, GivesThePublishedHeatedStep) {
    const Network n = office();
    const HourDrive drive = same_everywhere(10, 10, 2000);
    const NodeGains gains = split_gains(n, drive.phi_int, drive.phi_sol);
    EXPECT_NEAR(advance_hour(n, drive, gains, 20, 343).theta_air, 20.042734463, 5e-10);
    const double phi = power_for_set_point(n, drive, gains, office_control(), 20);
    EXPECT_NEAR(phi, 328.094091162, 5e-9);
    const NodeTemperatures theta = advance_hour(n, drive, gains, 20, phi);
    EXPECT_NEAR(theta.theta_m_t, 20.917796232, 5e-10);
    EXPECT_NEAR(theta.theta_s, 20.764992184, 5e-10);
    EXPECT_NEAR(theta.theta_air, 20, 1e-12);
}

struct PeerCase {
    Network network;
    HourDrive drive;
    Control control;
    double theta_m_before;
    bool floor_heating;  ///< heating enters the surface node
};

PeerCase read_case(const test::CsvTable& table, std::size_t row) {
    const auto value = [&](const char* column) { return table.number(row, column); };
    PeerCase peer;
    Network& n = peer.network;
    n.A_f = value("floor_area");
    n.A_m = value("peer_a_m");
    n.A_tot = value("peer_a_t");
    n.C_m = value("peer_c_m");
    n.H_tr_em = value("peer_h_tr_em");
    n.H_tr_w = value("peer_h_tr_w");
    n.H_ve = value("peer_h_ve");
    n.H_tr_ms = value("peer_h_tr_ms");
    n.H_tr_is = value("peer_h_tr_is");
    peer.drive =
        same_everywhere(value("t_out"), value("internal_gains"), value("solar_gains"));
    peer.control = {value("t_set_heating"), value("t_set_cooling"),
                    value("max_heating_energy_per_floor_area") * n.A_f,
                    -value("max_cooling_energy_per_floor_area") * n.A_f};
    peer.theta_m_before = value("t_m_prev");
    peer.floor_heating = table.text(row, "heating_emission_system") == "FloorHeating";
    return peer;
}

struct PeerAnswer {
    NodeGains gains;  ///< with the power of heating or cooling
    NodeTemperatures theta;
    double phi;
};

/// C.13 with the probe of +10 W/m2 at the surface node. The peer probes so for cooling
/// too, where heating is by the floor, and then cools the air: its cooled air misses the
/// set-point.
double floor_heating_power(const PeerCase& peer, const NodeGains& gains) {
    const Network& n = peer.network;
    const double phi_10 = 10 * n.A_f;
    NodeGains probe = gains;
    probe.phi_st += phi_10;
    const auto air = [&](const NodeGains& with) {
        return advance_hour(n, peer.drive, with, peer.theta_m_before, 0).theta_air;
    };
    const double theta_0 = air(gains), theta_10 = air(probe);
    const double theta_set = theta_0 < peer.control.theta_H_set
                                 ? peer.control.theta_H_set
                                 : peer.control.theta_C_set;
    return phi_10 * (theta_set - theta_0) / (theta_10 - theta_0);
}

PeerAnswer answer(const PeerCase& peer) {
    const Network& n = peer.network;
    NodeGains gains = split_gains(n, peer.drive.phi_int, peer.drive.phi_sol);
    const double phi = peer.floor_heating
                           ? floor_heating_power(peer, gains)
                           : power_for_set_point(n, peer.drive, gains, peer.control,
                                                 peer.theta_m_before);
    (peer.floor_heating && phi > 0 ? gains.phi_st : gains.phi_ia) += phi;
    return {gains, advance_hour(n, peer.drive, gains, peer.theta_m_before, 0), phi};
}

class PeerCases : public testing::Test {
  protected:
    void SetUp() override {
        file_ = test::shared_file("thermal/rcsim_peer_cases.csv");
        if (test::is_absent(file_)) GTEST_SKIP() << file_;
    }
    std::filesystem::path file_;
};

TEST_F(PeerCases, AgreeInGainsTemperaturesAndDemand) {
    const test::CsvTable table(file_);
    ASSERT_EQ(table.n_rows(), 19u);
    double worst = 0;
    for (std::size_t row = 0; row < table.n_rows(); ++row) {
        SCOPED_TRACE(table.text(row, "test"));
        const PeerAnswer own = answer(read_case(table, row));
        const auto compare = [&](const char* column, double value) {
            const double peer = table.number(row, column);
            const double error = std::abs(value - peer) / std::max(std::abs(peer), 1.0);
            EXPECT_LE(error, relative) << column << ": " << value << " against " << peer;
            worst = std::max(worst, error);
        };
        compare("peer_phi_ia", own.gains.phi_ia);
        compare("peer_phi_st", own.gains.phi_st);
        compare("peer_phi_m", own.gains.phi_m);
        compare("peer_t_m_next", own.theta.theta_m_t);
        compare("peer_t_m", own.theta.theta_m);
        compare("peer_t_s", own.theta.theta_s);
        compare("peer_t_air", own.theta.theta_air);
        compare("peer_t_op", own.theta.theta_op);
        compare("peer_energy_demand", own.phi);
        compare("peer_heating_demand", std::max(own.phi, 0.0));
        compare("peer_cooling_demand", std::min(own.phi, 0.0));
    }
    test::print_measured("one hour, 19 peer cases, largest relative error", worst, "-",
                         "1e-9");
}

TEST(Hour, SettlesAtTheResistorNetworksSolution) {
    std::mt19937_64 random(1);
    for (int k = 0; k < 100; ++k) {
        const Network n = random_network(random);
        const HourDrive drive = {4, -3, 11, 20 * n.A_f, 15 * n.A_f};
        const NodeGains gains = split_gains(n, drive.phi_int, drive.phi_sol);
        // what the mass loses per K and what it gains, by eliminating air and surface
        const double k_1 = n.H_tr_is / (n.H_tr_is + n.H_ve), H_1 = k_1 * n.H_ve;
        const double share = n.H_tr_ms / (n.H_tr_ms + H_1 + n.H_tr_w);
        const double at_s =
            gains.phi_st + n.H_tr_w * 4 + k_1 * (n.H_ve * 11 + gains.phi_ia);
        const double steady = (gains.phi_m + n.H_tr_em * -3 + share * at_s) /
                              (n.H_tr_em + share * (H_1 + n.H_tr_w));
        const double after = advance_hour(n, drive, gains, steady, 0).theta_m_t;
        EXPECT_NEAR(after, steady, 1e-12 * std::max(1.0, std::abs(steady)));
    }
}

// 0.956288139 = the worked step's decay ratio.
TEST(Hour, DecaysByTheCrankNicolsonRatio) {
    const Network n = office();
    const double after = advance_hour(n, same_everywhere(0), {0, 0, 0}, 1, 0).theta_m_t;
    EXPECT_NEAR(after, 0.956288139, 5e-10);
}

TEST(Hour, ClosesTheBalanceOfEveryNode) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int k = 0; k < 200; ++k) {
        const Network n = random_network(random);
        const HourDrive drive = {20 * unit(random), 20 * unit(random), 20 * unit(random),
                                 30 * n.A_f * unit(random), 30 * n.A_f * unit(random)};
        const NodeGains gains = split_gains(n, drive.phi_int, drive.phi_sol);
        const double phi = 50 * n.A_f * unit(random), before = 20 + 5 * unit(random);
        const NodeTemperatures theta = advance_hour(n, drive, gains, before, phi);
        const double mass = n.C_m / 3600 * (theta.theta_m_t - before) - gains.phi_m -
                            n.H_tr_em * (drive.theta_em - theta.theta_m) -
                            n.H_tr_ms * (theta.theta_s - theta.theta_m);
        const double surface = gains.phi_st +
                               n.H_tr_ms * (theta.theta_m - theta.theta_s) +
                               n.H_tr_w * (drive.theta_e - theta.theta_s) +
                               n.H_tr_is * (theta.theta_air - theta.theta_s);
        const double air = gains.phi_ia + phi +
                           n.H_ve * (drive.theta_sup - theta.theta_air) +
                           n.H_tr_is * (theta.theta_s - theta.theta_air);
        const double scale = n.H_tr_ms * 20;
        EXPECT_NEAR(mass / scale, 0, 1e-11);
        EXPECT_NEAR(surface / scale, 0, 1e-11);
        EXPECT_NEAR(air / scale, 0, 1e-11);
    }
}

TEST(Hour, IsLinearInThePower) {
    std::mt19937_64 random(3);
    for (int k = 0; k < 100; ++k) {
        const Network n = random_network(random);
        const HourDrive drive = same_everywhere(3, 0, 5 * n.A_f);
        const NodeGains gains = split_gains(n, drive.phi_int, drive.phi_sol);
        const auto air = [&](double phi) {
            return advance_hour(n, drive, gains, 18, phi).theta_air;
        };
        const double step = 10 * n.A_f;
        EXPECT_NEAR(air(3 * step) - air(0), 3 * (air(step) - air(0)),
                    1e-11 * std::abs(air(3 * step)));
    }
}

TEST(Hour, MeetsTheSetPointOrItsLimit) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    int met = 0, limited = 0, floating = 0;
    for (int k = 0; k < 2000; ++k) {
        const Network n = random_network(random);
        const double theta = 20 + 40 * unit(random),
                     gain = 40 * n.A_f * (1 + unit(random));
        const HourDrive drive = same_everywhere(theta, 0, gain);
        const NodeGains gains = split_gains(n, 0, gain);
        Control control;
        control.phi_H_max = control.phi_C_max = 20 * n.A_f;
        const double phi = power_for_set_point(n, drive, gains, control, 22);
        const double air = advance_hour(n, drive, gains, 22, phi).theta_air;
        if (phi == control.phi_H_max) {
            EXPECT_LE(air, control.theta_H_set + 1e-10);
            ++limited;
        } else if (phi == -control.phi_C_max) {
            EXPECT_GE(air, control.theta_C_set - 1e-10);
            ++limited;
        } else if (phi == 0) {
            EXPECT_GE(air, control.theta_H_set);
            EXPECT_LE(air, control.theta_C_set);
            ++floating;
        } else {
            EXPECT_NEAR(air, phi > 0 ? control.theta_H_set : control.theta_C_set, 1e-10);
            ++met;
        }
    }
    EXPECT_GT(met, 100);
    EXPECT_GT(limited, 100);
    EXPECT_GT(floating, 100);
}

TEST(Hour, AsksForMorePowerAtAHigherSetPoint) {
    const Network n = office();
    const HourDrive drive = same_everywhere(0, 100, 0);
    const NodeGains gains = split_gains(n, 100, 0);
    Control control;
    double last = -1;
    for (double set = 10; set < 26; set += 0.5) {
        control.theta_H_set = set;
        const double phi = power_for_set_point(n, drive, gains, control, 15);
        EXPECT_GE(phi, last);
        last = phi;
    }
    EXPECT_GT(last, 100);
}

// C.1 to C.3 halve the internal gains; any other split keeps their sum and what is lost
// through windows of the radiant part.
TEST(Hour, SplitsInternalGainsBetweenAirAndSurfaces) {
    Network n = office();
    const NodeGains half = split_gains(n, 100, 0);
    EXPECT_EQ(half.phi_ia, 50);
    n.gains_air_share = 0.8;
    const NodeGains airy = split_gains(n, 100, 0);
    EXPECT_DOUBLE_EQ(airy.phi_ia, 80);
    EXPECT_NEAR(airy.phi_st, 0.4 * half.phi_st, 1e-12);
    EXPECT_NEAR(airy.phi_m, 0.4 * half.phi_m, 1e-12);
    n.gains_air_share = 0;
    const NodeGains sun = split_gains(n, 0, 100), radiant = split_gains(n, 100, 0);
    EXPECT_EQ(radiant.phi_ia, 0);
    EXPECT_EQ(radiant.phi_st, sun.phi_st);
    EXPECT_EQ(radiant.phi_m, sun.phi_m);
}

TEST(Hour, SunHeatsTheAirByItsShareAndTheRestAsInTheStandard) {
    Network n = office();
    const NodeGains standard = split_gains(n, 0, 100);
    EXPECT_EQ(standard.phi_ia, 0);
    n.sun_air_share = 0.25;
    const NodeGains airy = split_gains(n, 0, 100);
    EXPECT_DOUBLE_EQ(airy.phi_ia, 25);
    EXPECT_NEAR(airy.phi_st, 0.75 * standard.phi_st, 1e-12);
    EXPECT_NEAR(airy.phi_m, 0.75 * standard.phi_m, 1e-12);
    EXPECT_EQ(split_gains(n, 100, 0).phi_ia, 50);
}

TEST(Hour, NeedsNoVentilation) {
    Network n = office();
    n.H_ve = 0;
    const HourDrive drive = same_everywhere(5, 50, 0);
    const NodeGains gains = split_gains(n, 50, 0);
    const double phi = power_for_set_point(n, drive, gains, {}, 18);
    const double none = advance_hour(n, drive, gains, 18, phi).theta_air;
    n.H_ve = 1e-9;
    const double hardly = advance_hour(n, drive, gains, 18, phi).theta_air;
    EXPECT_NEAR(none, 20, 1e-12);
    EXPECT_NEAR(none, hardly, 1e-9);
}

TEST(Hour, TakesAnImposedPowerAsItIs) {
    Control control;
    control.imposed = true;
    control.phi_imposed = -123;
    const Network n = office();
    EXPECT_EQ(power_for_set_point(n, same_everywhere(10), {0, 0, 0}, control, 20), -123);
}

}  // namespace
}  // namespace bemcal::physics
