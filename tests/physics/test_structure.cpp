/// The refinements of the hour: each vanishes where it should, keeps its balance, and
/// converges to the continuous network.
#include "physics/simulate.hpp"
#include "physics/step_parts.hpp"
#include "physics/structure.hpp"
#include "support/measured.hpp"
#include "support/simple_building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

struct Situation {
    Network network;
    HourDrive drive;
    Control control;
    ZoneState before;
};

/// A plain zone in random weather; refinements are for the tests to add.
Situation random_situation(std::mt19937_64& random) {
    const auto within = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Situation s;
    Network& n = s.network;
    n.A_f = within(20, 500);
    n.A_m = n.A_f * within(2.5, 3.5);
    n.A_tot = n.A_f * 4.5;
    n.C_m = n.A_f * within(8e4, 4e5);
    n.H_tr_em = n.A_f * within(0.2, 2);
    n.H_tr_w = n.A_f * within(0.1, 1);
    n.H_ve = n.A_f * within(0, 2);
    n.H_tr_ms = 9.1 * n.A_m;
    n.H_tr_is = 3.45 * n.A_tot;
    s.drive = {within(-15, 35), within(-15, 35), within(-15, 35), n.A_f * within(0, 20),
               n.A_f * within(0, 60)};
    s.control.phi_H_max = s.control.phi_C_max = n.A_f * within(5, 60);
    const double theta = within(14, 30);
    s.before = {theta, theta + within(-2, 2), theta + within(-2, 2), 0};
    return s;
}

void add_every_refinement(Network& n) {
    n.air_capacity = 8000 * n.A_f;
    n.band = 2;
    n.tau_emitter = 1800;
    n.radiant_share = 0.4;
    n.H_2 = 1.5 * n.A_f;
    n.C_2 = 1e5 * n.A_f;
}

StepResult step(const Situation& s, double dt = 3600) {
    return advance_step(s.network, s.drive, s.control, s.before, dt);
}

void expect_same(const StepResult& a, const StepResult& b, double tolerance) {
    EXPECT_NEAR(a.theta.theta_m_t, b.theta.theta_m_t, tolerance);
    EXPECT_NEAR(a.theta.theta_m, b.theta.theta_m, tolerance);
    EXPECT_NEAR(a.theta.theta_s, b.theta.theta_s, tolerance);
    EXPECT_NEAR(a.theta.theta_air, b.theta.theta_air, tolerance);
    EXPECT_NEAR(a.theta.theta_op, b.theta.theta_op, tolerance);
    const double power = std::max({1.0, a.phi_heating, a.phi_cooling});
    EXPECT_NEAR(a.phi_heating / power, b.phi_heating / power, tolerance);
    EXPECT_NEAR(a.phi_cooling / power, b.phi_cooling / power, tolerance);
}

StepResult standard(const Situation& s, double dt) {
    const NodeGains gains = split_gains(s.network, s.drive.phi_int, s.drive.phi_sol);
    const double phi =
        power_for_set_point(s.network, s.drive, gains, s.control, s.before.theta_m, dt);
    StepResult result;
    result.theta = advance_hour(s.network, s.drive, gains, s.before.theta_m, phi, dt);
    result.phi_heating = std::max(phi, 0.0);
    result.phi_cooling = std::max(-phi, 0.0);
    return result;
}

TEST(Structure, IsTheStandardsHourWithAllOff) {
    std::mt19937_64 random(1);
    for (int k = 0; k < 500; ++k) {
        const Situation s = random_situation(random);
        for (double dt : {600.0, 3600.0}) {
            const StepResult own = step(s, dt), reference = standard(s, dt);
            const double scale = std::abs(reference.theta.theta_s) + 1;
            expect_same(own, reference, 1e-12 * scale);
        }
    }
}

TEST(Structure, TendsToTheStandardAsTheAirLosesItsCapacity) {
    std::mt19937_64 random(2);
    for (int k = 0; k < 50; ++k) {
        Situation s = random_situation(random);
        const StepResult reference = standard(s, 3600);
        s.network.air_capacity = 1e-6 * s.network.A_f;
        expect_same(step(s), reference, 1e-8);
    }
}

TEST(Structure, TendsToTheIdealThermostatAsTheBandCloses) {
    std::mt19937_64 random(3);
    for (int k = 0; k < 200; ++k) {
        Situation s = random_situation(random);
        add_every_refinement(s.network);
        s.network.band = 0;
        const StepResult ideal = step(s);
        s.network.band = 1e-9;
        expect_same(step(s), ideal, 1e-7);
    }
}

TEST(Structure, ObeysTheProportionalLawExactly) {
    std::mt19937_64 random(4);
    int inside = 0;
    for (int k = 0; k < 500; ++k) {
        Situation s = random_situation(random);
        add_every_refinement(s.network);
        const StepResult r = step(s);
        const auto share = [&](double missing) {
            return std::clamp(0.5 + missing / s.network.band, 0.0, 1.0);
        };
        const double air = r.theta.theta_air;
        EXPECT_NEAR(r.phi_heating / s.control.phi_H_max,
                    share(s.control.theta_H_set - air), 1e-11);
        EXPECT_NEAR(r.phi_cooling / s.control.phi_C_max,
                    share(air - s.control.theta_C_set), 1e-11);
        inside += r.phi_heating > 0 && r.phi_heating < s.control.phi_H_max;
    }
    EXPECT_GT(inside, 50);
}

// Rooms that are up to 3 K warmer or colder than the zone, each with a thermostat of its
// own: their mean power, and the zone's temperature with it.
TEST(Structure, RoomsThatDifferAreTheMeanOfTheirThermostats) {
    std::mt19937_64 random(12);
    for (int draw = 0; draw < 200; ++draw) {
        Situation s = random_situation(random);
        s.control.phi_H_max = s.control.phi_C_max = unlimited;
        s.control.theta_C_set = s.control.theta_H_set + 3;
        double heating = 0, cooling = 0;
        const int rooms = 4000;
        for (int room = 0; room < rooms; ++room) {
            Situation one = s;
            const double warmer = 6 * ((room + 0.5) / rooms - 0.5);
            one.control.theta_H_set -= warmer;
            one.control.theta_C_set -= warmer;
            const StepResult result = step(one);
            heating += result.phi_heating / rooms;
            cooling += result.phi_cooling / rooms;
        }
        s.control.room_spread = 6;
        const StepResult result = step(s);
        const double scale = s.network.A_f;
        EXPECT_NEAR(result.phi_heating / scale, heating / scale, 1e-4);
        EXPECT_NEAR(result.phi_cooling / scale, cooling / scale, 1e-4);
    }
}

// Rooms as above, of which each gets what it asks for, and a share of what the warmest
// asks for.
TEST(Structure, OneUnitThatAnyRoomTurnsOnCoolsAllRooms) {
    std::mt19937_64 random(13);
    for (int draw = 0; draw < 100; ++draw) {
        Situation s = random_situation(random);
        s.control.phi_H_max = 0;
        s.control.phi_C_max = unlimited;
        const int rooms = 4000;
        std::vector<double> asked;
        for (int room = 0; room < rooms; ++room) {
            Situation one = s;
            one.control.theta_C_set -= 6 * ((room + 0.5) / rooms - 0.5);
            asked.push_back(step(one).phi_cooling);
        }
        s.control.room_spread = 6;
        const double alone = step(s).phi_cooling, scale = s.network.A_f;
        for (const double together : {0.3, 1.0}) {
            double mean = 0;
            for (const double power : asked)
                mean += std::max(power, together * asked.back()) / rooms;
            s.control.together = together;
            EXPECT_NEAR(step(s).phi_cooling / scale, mean / scale, 2e-2);
            EXPECT_GE(step(s).phi_cooling, alone * (1 - 1e-12));
        }
    }
}

TEST(Structure, NeverHeatsAndCoolsAtOnce) {
    std::mt19937_64 random(5);
    for (int k = 0; k < 500; ++k) {
        Situation s = random_situation(random);
        add_every_refinement(s.network);
        s.network.band = s.control.theta_C_set - s.control.theta_H_set;
        const StepResult r = step(s);
        EXPECT_EQ(r.phi_heating * r.phi_cooling, 0);
    }
}

TEST(Structure, KeepsTheEmittersEnergy) {
    std::mt19937_64 random(6);
    for (double dt : {60.0, 600.0, 3600.0})
        for (int k = 0; k < 50; ++k) {
            Situation s = random_situation(random);
            add_every_refinement(s.network);
            s.before.phi_emitter = 0.3 * s.control.phi_H_max;
            const StepResult r = step(s, dt);
            TermValues terms;
            terms[Term::phi_emitter] = s.before.phi_emitter;
            terms[Term::phi_h] = r.phi_heating;
            const double delivered =
                make_step_parts(s.network, dt).emitter.mean.at(terms);
            const double stored =
                s.network.tau_emitter * (r.after.phi_emitter - s.before.phi_emitter);
            EXPECT_NEAR((r.phi_heating - delivered) * dt, stored,
                        1e-11 * s.control.phi_H_max * dt);
        }
}

/// Every node's balance over the step, from temperatures alone.
TEST(Structure, ClosesTheBalanceOfEveryNode) {
    std::mt19937_64 random(7);
    for (int k = 0; k < 200; ++k) {
        Situation s = random_situation(random);
        const Network& n = s.network;
        add_every_refinement(s.network);
        s.before.phi_emitter = 0.5 * s.control.phi_H_max;
        const double dt = 900;
        const StepResult r = step(s, dt);
        TermValues terms;
        terms[Term::phi_emitter] = s.before.phi_emitter;
        terms[Term::phi_h] = r.phi_heating;
        const double heat = make_step_parts(n, dt).emitter.mean.at(terms);
        const NodeGains gains = split_gains(n, s.drive.phi_int, s.drive.phi_sol);
        const RadiantSplit split = radiant_split(n);
        const NodeTemperatures& theta = r.theta;
        const double theta_m2 = 0.5 * (s.before.theta_m2 + r.after.theta_m2);
        const double air = gains.phi_ia + (1 - n.radiant_share) * heat - r.phi_cooling +
                           n.H_ve * (s.drive.theta_sup - theta.theta_air) +
                           n.H_tr_is * (theta.theta_s - theta.theta_air) -
                           n.air_capacity * (r.after.theta_air - s.before.theta_air) / dt;
        const double surface = gains.phi_st + split.to_st * n.radiant_share * heat +
                               n.H_tr_w * (s.drive.theta_e - theta.theta_s) +
                               n.H_tr_is * (theta.theta_air - theta.theta_s) +
                               n.H_tr_ms * (theta.theta_m - theta.theta_s);
        const double mass = gains.phi_m + split.to_m * n.radiant_share * heat +
                            n.H_tr_em * (s.drive.theta_em - theta.theta_m) +
                            n.H_tr_ms * (theta.theta_s - theta.theta_m) +
                            n.H_2 * (theta_m2 - theta.theta_m) -
                            n.C_m * (r.after.theta_m - s.before.theta_m) / dt;
        const double second = n.H_2 * (theta.theta_m - theta_m2) -
                              n.C_2 * (r.after.theta_m2 - s.before.theta_m2) / dt;
        for (double residual : {air, surface, mass, second})
            EXPECT_NEAR(residual / (20 * n.H_tr_ms), 0, 1e-12);
    }
}

TEST(Structure, MakesOneMassOfTwoThatAreTiedTogether) {
    std::mt19937_64 random(8);
    for (int k = 0; k < 50; ++k) {
        Situation s = random_situation(random);
        s.before.theta_m2 = s.before.theta_m;
        const StepResult one = step(s);
        s.network.C_2 = 0.4 * s.network.C_m;
        s.network.C_m -= s.network.C_2;
        s.network.H_2 = 1e10 * s.network.A_f;
        expect_same(step(s), one, 1e-6);
    }
}

TEST(Structure, SendsOnlyHeatingThroughTheEmitter) {
    std::mt19937_64 random(9);
    Situation s = random_situation(random);
    s.control.imposed = true;
    s.control.phi_imposed = -500;
    const StepResult plain = step(s);
    s.network.tau_emitter = 7200;
    s.network.radiant_share = 0.5;
    const StepResult cooled = step(s);
    expect_same(cooled, plain, 1e-12 * 100);
    EXPECT_EQ(cooled.phi_cooling, 500);
    s.control.phi_imposed = 500;
    const StepResult heated = step(s);
    EXPECT_EQ(heated.phi_heating, 500);
    EXPECT_NEAR(heated.after.phi_emitter, 500 * (1 - std::exp(-0.5)), 1e-10);
}

/// The continuous network, in state (theta_m, theta_m2, theta_air, phi_emitter), by the
/// classical Runge-Kutta method with steps far below its shortest time constant.
ZoneState continuous(const Situation& s, double command, double duration) {
    using State = std::array<double, 4>;
    const Network& n = s.network;
    const NodeGains gains = split_gains(n, s.drive.phi_int, s.drive.phi_sol);
    const RadiantSplit split = radiant_split(n);
    const auto rate = [&](const State& x) -> State {
        const double radiant = n.radiant_share * x[3];
        const double theta_s = (n.H_tr_ms * x[0] + n.H_tr_w * s.drive.theta_e +
                                n.H_tr_is * x[2] + gains.phi_st + split.to_st * radiant) /
                               (n.H_tr_ms + n.H_tr_w + n.H_tr_is);
        return {(n.H_tr_em * (s.drive.theta_em - x[0]) + n.H_tr_ms * (theta_s - x[0]) +
                 n.H_2 * (x[1] - x[0]) + gains.phi_m + split.to_m * radiant) /
                    n.C_m,
                n.H_2 * (x[0] - x[1]) / n.C_2,
                (n.H_ve * (s.drive.theta_sup - x[2]) + n.H_tr_is * (theta_s - x[2]) +
                 gains.phi_ia + x[3] - radiant) /
                    n.air_capacity,
                (command - x[3]) / n.tau_emitter};
    };
    const auto moved = [](State x, double h, const State& k) {
        for (std::size_t i = 0; i < 4; ++i) x[i] += h * k[i];
        return x;
    };
    State x = {s.before.theta_m, s.before.theta_m2, s.before.theta_air,
               s.before.phi_emitter};
    const double h = 2;
    for (double t = 0; t < duration - h / 2; t += h) {
        const State k1 = rate(x), k2 = rate(moved(x, h / 2, k1));
        const State k3 = rate(moved(x, h / 2, k2)), k4 = rate(moved(x, h, k3));
        for (std::size_t i = 0; i < 4; ++i)
            x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    return {x[0], x[1], x[2], x[3]};
}

ZoneState stepped(Situation s, double dt, double duration) {
    for (double t = 0; t < duration - dt / 2; t += dt) s.before = step(s, dt).after;
    return s.before;
}

TEST(Structure, ConvergesToTheContinuousNetwork) {
    std::mt19937_64 random(10);
    double coarse_worst = 0, fine_worst = 0;
    for (int k = 0; k < 20; ++k) {
        Situation s = random_situation(random);
        add_every_refinement(s.network);
        s.control.imposed = true;
        s.control.phi_imposed = 30 * s.network.A_f;
        const double duration = 4 * 3600;
        const ZoneState exact = continuous(s, s.control.phi_imposed, duration);
        const auto error = [&](double dt) {
            const ZoneState own = stepped(s, dt, duration);
            EXPECT_NEAR(own.phi_emitter, exact.phi_emitter, 1e-6 * s.control.phi_imposed);
            return std::max({std::abs(own.theta_m - exact.theta_m),
                             std::abs(own.theta_m2 - exact.theta_m2),
                             std::abs(own.theta_air - exact.theta_air)});
        };
        const double coarse = error(600), fine = error(60), finest = error(6);
        EXPECT_LT(fine, 0.2 * coarse + 1e-9);
        EXPECT_LT(finest, 0.2 * fine + 1e-9);
        EXPECT_LT(finest, 2e-3);
        coarse_worst = std::max(coarse_worst, coarse);
        fine_worst = std::max(fine_worst, fine);
    }
    test::print_measured("refined step of 600 s, largest error after 4 h", coarse_worst,
                         "K", "");
    test::print_measured("refined step of 60 s, largest error after 4 h", fine_worst, "K",
                         "");
}

TEST(Structure, SimulatesTenMinutesWithEveryRefinement) {
    Building building = test::simple_building();
    Zone& zone = building.zones[0];
    zone.thermostat.heating_capacity.value = 60;
    zone.thermostat.cooling_capacity.value = 60;
    const Drive hourly = test::swinging_drive(building, 24 * 60, 2, 300);
    const Drive fine = test::swinging_drive(building, 6 * 24 * 60, 2, 300, 600);
    const auto energy = [&](const Drive& drive) {
        double sum = 0;
        const Trajectory trajectory = simulate(building, drive);
        for (double power : trajectory.zones[0].heating)
            sum += power * drive.axis.step_s / 3.6e6;
        return sum;
    };
    const double plain = energy(hourly);
    EXPECT_NEAR(energy(fine), plain, 0.01 * plain);
    zone.structure = {10000, 0.5, 900, 0.3, 2, 1e5};
    EXPECT_NEAR(energy(fine), plain, 0.05 * plain);
}

}  // namespace
}  // namespace bemcal::physics
