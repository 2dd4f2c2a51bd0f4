/// What effects bring to a building, one by one: openings that follow the room, outdoors
/// that differs from the weather, factors of meters, changes of inputs.
#include "kernel/response_derivative.hpp"
#include "support/simple_building.hpp"

#include <stdexcept>

namespace bemcal::physics {
namespace {

Building vented(double air_change) {
    Building building = bemcal::test::simple_building();
    building.zones[0].venting = {{air_change}, 24, 4};
    return building;
}

TEST(Venting, OpensWithTheRoomAndOnlyToColderAir) {
    const Zone zone = vented(2).zones[0];
    const Drive drive = bemcal::test::constant_drive(vented(2), 1, 16);
    const double H = 1200 * zone.volume * 2 / 3600;  // [W/K]
    EXPECT_DOUBLE_EQ(venting_conductance(zone, drive, 0), H);
    EXPECT_EQ(venting_power(zone, drive, 0, 23.9), 0);
    EXPECT_DOUBLE_EQ(venting_power(zone, drive, 0, 26), H * 0.5 * 10);
    EXPECT_DOUBLE_EQ(venting_power(zone, drive, 0, 30), H * 14);
    EXPECT_EQ(venting_power(zone, bemcal::test::constant_drive(vented(2), 1, 31), 0, 30),
              0);
}

/// The same heat taken away by an imposed power.
TEST(Venting, TakesItsHeatFromTheAirNode) {
    Building building = vented(3);
    Zone& zone = building.zones[0];
    zone.thermostat.imposed = true;
    zone.thermostat.imposed_power = {40, 0, 0};
    Drive drive = bemcal::test::swinging_drive(building, 300, 14, 400);
    drive.profiles = Matrix(1, 300, 1.0);
    const ZoneTrajectory open = simulate(building, drive).zones[0];
    for (std::size_t k = 0; k < 300; ++k)
        drive.profiles(0, k) = 1 - venting_power(zone, drive, static_cast<int>(k),
                                                 k == 0 ? 20 : open.theta_air[k - 1]) /
                                       (40 * zone.floor_area);
    zone.venting = {};
    const ZoneTrajectory shut = simulate(building, drive).zones[0];
    double least = 1;
    for (std::size_t k = 0; k < 300; ++k) {
        EXPECT_NEAR(open.theta_air[k], shut.theta_air[k], 1e-9);
        least = std::min(least, drive.profiles(0, k));
    }
    EXPECT_LT(least, 0.7);
}

TEST(Venting, ThatIsNoNumberIsRejectedAlike) {
    const Building building = vented(1);
    const Drive drive = bemcal::test::swinging_drive(building, 48, 20, 300);
    const std::vector<Parameter> parameters = {
        {"air", "1/h", -1, 3, Effect::replace,
         resolve(building, "zone.room.venting_air_change"), 1}};
    const kernel::Batch batch(building, parameters, drive);
    const kernel::Request request{{Quantity::heating}, {}, {}};
    const auto answers = batch.evaluate(Matrix(1, 1, -1.0), request);
    try {
        simulate(vented(-1), drive);
        ADD_FAILURE() << "a negative air change was simulated";
    } catch (const std::domain_error& error) {
        EXPECT_EQ(answers[0].failure, error.what());
        EXPECT_EQ(answers[0].failure,
                  "zone room, step 0: venting_air_change = -1 is not a number >= 0");
    }
}

TEST(OutdoorShift, OfAllIsOtherWeather) {
    Building building = bemcal::test::simple_building();
    Drive drive = bemcal::test::swinging_drive(building, 200, 8, 300);
    const Building plain = building;
    OutdoorShift& shift = building.zones[0].outdoor_shift;
    shift = {{1.5}, {1.5}, {1.5}};
    const ZoneTrajectory shifted = simulate(building, drive).zones[0];
    for (double& theta : drive.theta_e) theta += 1.5;
    const ZoneTrajectory warmer = simulate(plain, drive).zones[0];
    for (std::size_t k = 0; k < 200; ++k) {
        EXPECT_NEAR(shifted.heating[k], warmer.heating[k], 1e-8);
        EXPECT_NEAR(shifted.theta_air[k], warmer.theta_air[k], 1e-10);
    }
}

/// Steady heat loss falls by H times the shift, path by path.
TEST(OutdoorShift, OfAPathMovesThatPathOnly) {
    const Building plain = bemcal::test::simple_building();
    const Drive drive = bemcal::test::constant_drive(plain, 800, 0);
    Network network;
    make_network(plain, plain.zones[0], drive, 0, network);
    const double loss = simulate(plain, drive).zones[0].heating.back();
    const auto saved = [&](Input OutdoorShift::* path) {
        Building building = plain;
        (building.zones[0].outdoor_shift.*path).value = 2;
        return (loss - simulate(building, drive).zones[0].heating.back()) / 2;
    };
    EXPECT_NEAR(saved(&OutdoorShift::supply), network.H_ve, 1e-6 * network.H_ve);
    const double inside = saved(&OutdoorShift::opaque) + saved(&OutdoorShift::windows);
    const double H_tr_op = 1 / (1 / network.H_tr_em + 1 / network.H_tr_ms);
    EXPECT_GT(saved(&OutdoorShift::opaque), 0.7 * H_tr_op);
    EXPECT_GT(saved(&OutdoorShift::windows), 0.7 * network.H_tr_w);
    EXPECT_LT(inside, H_tr_op + network.H_tr_w);
}

TEST(MeterFactor, MultipliesWhatTheMeterShows) {
    Building building = bemcal::test::simple_building();
    const Drive drive = bemcal::test::swinging_drive(building, 100, 8, 300);
    const Trajectory trajectory = simulate(building, drive);
    for (Quantity quantity : {Quantity::electricity, Quantity::gas, Quantity::heating}) {
        const auto before = predict(building, drive, trajectory, quantity);
        building.meter_factor[static_cast<std::size_t>(quantity)].value = 1.25;
        const auto after = predict(building, drive, trajectory, quantity);
        for (std::size_t k = 0; k < before.size(); ++k)
            EXPECT_DOUBLE_EQ(after[k], 1.25 * before[k]);
    }
    building.meter_factor[4].value = -1;
    EXPECT_THROW(predict(building, drive, trajectory, Quantity::gas), std::domain_error);
}

/// A parameter that writes a change's amount, times its weight.
TEST(Changes, AreWrittenByParameters) {
    Building building = bemcal::test::simple_building();
    Input& u_value = building.constructions[0].u_value;
    u_value.changes = {{0, 0, ChangeKind::factor}};
    Parameter parameter{
        "c", "-", -1, 1, Effect::replace, resolve(building, "construction.wall.u_value"),
        0};
    parameter.targets[0].slot = Slot::change;
    parameter.targets[0].weight = -0.5;
    Drive drive = bemcal::test::constant_drive(building, 2, 0, 0, 3600, 1);
    drive.profiles(0, 1) = 1;
    Building point = building;
    apply(building, std::vector{parameter}, std::vector{0.4}, point);
    EXPECT_DOUBLE_EQ(drive.at(point.constructions[0].u_value, 0), 0.4);
    EXPECT_DOUBLE_EQ(drive.at(point.constructions[0].u_value, 1), 0.4 * (1 - 0.2));
}

TEST(Changes, DerivativeOfAResponseIsThatOfCentralDifferences) {
    for (unsigned seed : {4U, 8U, 9U, 10U, 12U})
        test::expect_derivative(test::random_hooked_case(seed));
}

}  // namespace
}  // namespace bemcal::physics
