/// The fast version of a simulation against the plain one, over all options of the
/// description.
#include "kernel/batch.hpp"
#include "kernel/plain_answer.hpp"
#include "kernel/random_cycling.hpp"
#include "kernel/random_hooks.hpp"
#include "kernel/random_season.hpp"
#include "support/measured.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace bemcal::physics {

namespace {

using test::random_case;
using test::random_hooked_case;
using test::random_points;
using test::RandomCase;

constexpr Quantity all_quantities[] = {
    Quantity::air_temperature, Quantity::heating, Quantity::cooling,
    Quantity::electricity,     Quantity::gas,     Quantity::district};
constexpr double tolerance = 1e-10;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<kernel::InstructionSet> supported_sets() {
    std::vector<kernel::InstructionSet> sets;
    for (kernel::InstructionSet set :
         {kernel::InstructionSet::scalar, kernel::InstructionSet::v3,
          kernel::InstructionSet::v4})
        if (kernel::is_supported(set)) sets.push_back(set);
    return sets;
}

/// Readings that are the building's own with some error, every ninth missing, one zero.
kernel::Readings readings_for(const RandomCase& made, Quantity quantity,
                              const Intervals& interval) {
    const Trajectory trajectory = simulate(made.building, made.drive);
    kernel::Readings readings{
        quantity, interval,
        aggregate(predict(made.building, made.drive, trajectory, quantity),
                  interval_bounds(made.drive.period(), interval), quantity)};
    for (std::size_t k = 0; k < readings.values.size(); ++k) {
        readings.values[k] *= 1 + 0.2 * std::sin(static_cast<double>(k));
        if (k % 9 == 4) readings.values[k] = nan;
        if (k % 9 == 7) readings.values[k] = 0;
    }
    return readings;
}

/// Of 9 and 20 days from the second of the 36 days on.
Intervals bills_of(const RandomCase& made) {
    Intervals bills(Interval::monthly);
    for (const int day : {1, 10, 30})
        bills.bounds.push_back(made.drive.period().start + std::chrono::days(day));
    return bills;
}

kernel::Request everything_of(const RandomCase& made) {
    kernel::Request request;
    request.annual.assign(std::begin(all_quantities), std::end(all_quantities));
    request.monthly = request.annual;
    for (const Intervals& interval :
         {Intervals(Interval::step), Intervals(Interval::hourly),
          Intervals(Interval::daily), Intervals(Interval::monthly), bills_of(made)})
        for (Quantity quantity :
             {Quantity::gas, Quantity::electricity, Quantity::air_temperature})
            request.readings.push_back(readings_for(made, quantity, interval));
    return request;
}

Building building_at(const RandomCase& made, const Matrix& points, std::size_t point) {
    Building building = made.building;
    apply(made.building, made.parameters, points.row(point), building);
    return building;
}

double largest(const std::vector<double>& values) {
    double most = 0;
    for (double value : values) most = std::max(most, std::fabs(value));
    return most;
}

/// Of the largest value.
double difference(const std::vector<double>& fast, const std::vector<double>& plain) {
    double most = 0;
    for (std::size_t k = 0; k < std::min(fast.size(), plain.size()); ++k)
        most = std::max(most, std::fabs(fast[k] - plain[k]));
    return most / std::max(largest(plain), 1e-6);
}

void expect_near(const std::vector<double>& fast, const std::vector<double>& plain,
                 const std::string& what) {
    ASSERT_EQ(fast.size(), plain.size()) << what;
    const double allowed = tolerance * std::max(largest(plain), 1e-6);
    for (std::size_t k = 0; k < plain.size(); ++k)
        ASSERT_NEAR(fast[k], plain[k], allowed) << what << " " << k;
}

/// Each sum against what it is made of: an error as small as it may be is a difference of
/// the simulated and the measured.
void expect_near(const kernel::ErrorSums& fast, const kernel::ErrorSums& plain,
                 const std::string& what) {
    const double square = plain.simulated_square + plain.square + 1e-6;
    const double size = std::sqrt(plain.n * square);
    EXPECT_EQ(fast.n, plain.n) << what;
    EXPECT_EQ(fast.n_relative, plain.n_relative) << what;
    EXPECT_NEAR(fast.error, plain.error, tolerance * size) << what;
    EXPECT_NEAR(fast.simulated, plain.simulated, tolerance * size) << what;
    EXPECT_NEAR(fast.square, plain.square, tolerance * square) << what;
    EXPECT_NEAR(fast.simulated_square, plain.simulated_square, tolerance * square)
        << what;
    EXPECT_NEAR(fast.product, plain.product, tolerance * square) << what;
    EXPECT_NEAR(fast.relative, plain.relative, tolerance * (plain.relative + plain.n))
        << what;
}

void expect_near(const kernel::PointAnswer& fast, const kernel::PointAnswer& plain,
                 const std::string& what) {
    ASSERT_EQ(fast.failure, plain.failure) << what;
    expect_near(fast.annual, plain.annual, what + " annual");
    expect_near(fast.monthly, plain.monthly, what + " monthly");
    ASSERT_EQ(fast.errors.size(), plain.errors.size());
    for (std::size_t k = 0; k < plain.errors.size(); ++k) {
        const std::string which = what + " reading " + std::to_string(k);
        expect_near(fast.errors[k], plain.errors[k], which);
        expect_near(fast.monthly_errors[k], plain.monthly_errors[k], which + " by month");
    }
}

/// Of the totals, months and errors of some points.
void expect_answers(const RandomCase& made, unsigned seed, std::size_t n_points) {
    const Matrix points = random_points(seed, made.parameters, n_points);
    const kernel::Request request = everything_of(made);
    for (kernel::InstructionSet set : supported_sets()) {
        const kernel::Batch batch(made.building, made.parameters, made.drive, set);
        const std::vector<kernel::PointAnswer> answers = batch.evaluate(points, request);
        ASSERT_EQ(answers.size(), points.rows);
        for (std::size_t point = 0; point < points.rows; ++point)
            expect_near(
                answers[point],
                kernel::plain_answer(building_at(made, points, point), made.drive,
                                     request),
                std::string(kernel::name_of(set)) + " point " + std::to_string(point));
    }
}

class FastAgainstPlain : public testing::TestWithParam<unsigned> {};
class FastWithEffectsAgainstPlain : public testing::TestWithParam<unsigned> {};
class FastWithAirSystemsAgainstPlain : public testing::TestWithParam<unsigned> {};
class FastWithSeasonsAgainstPlain : public testing::TestWithParam<unsigned> {};
class FastWithCyclingAgainstPlain : public testing::TestWithParam<unsigned> {};

}  // namespace

TEST_P(FastAgainstPlain, TotalsMonthsAndErrorsAgree) {
    expect_answers(random_case(GetParam()), GetParam() + 1000, 11);
}

TEST_P(FastWithEffectsAgainstPlain, TotalsMonthsAndErrorsAgree) {
    expect_answers(random_hooked_case(GetParam()), GetParam() + 4000, 3);
}

TEST_P(FastWithAirSystemsAgainstPlain, TotalsMonthsAndErrorsAgree) {
    expect_answers(test::random_supplied_case(GetParam()), GetParam() + 6000, 3);
}

TEST_P(FastWithSeasonsAgainstPlain, TotalsMonthsAndErrorsAgree) {
    expect_answers(test::random_seasonal_case(GetParam()), GetParam() + 8000, 5);
}

TEST_P(FastWithCyclingAgainstPlain, TotalsMonthsAndErrorsAgree) {
    expect_answers(test::random_cycling_case(GetParam()), GetParam() + 10000, 3);
}

/// What advance() writes for one lane, in predict()'s unit; the period in two parts.
std::vector<double> advanced(const kernel::Batch& batch, const RandomCase& made,
                             const Matrix& points, Quantity quantity) {
    const auto group = batch.make_group();
    const int n = made.drive.n_steps() - made.drive.n_warm_up, middle = n / 3;
    Matrix rows(static_cast<std::size_t>(n), static_cast<std::size_t>(batch.lanes()));
    batch.prepare(points, 0, 1, *group);
    batch.warm_up(*group);
    batch.advance(*group, 0, middle, quantity, rows.values.data());
    batch.advance(*group, middle, n, quantity,
                  rows.row(static_cast<std::size_t>(middle)).data());
    std::vector<double> values;
    const double unit =
        quantity == Quantity::air_temperature ? 1 : made.drive.axis.step_s / 3.6e6;
    for (std::size_t step = 0; step < rows.rows; ++step)
        values.push_back(rows(step, rows.cols - 1) * unit);
    return values;
}

void expect_steps(const RandomCase& made, unsigned seed) {
    const Matrix points = random_points(seed, made.parameters, 1);
    const Building building = building_at(made, points, 0);
    const Trajectory trajectory = simulate(building, made.drive);
    double most = 0;
    for (kernel::InstructionSet set : supported_sets()) {
        const kernel::Batch batch(made.building, made.parameters, made.drive, set);
        for (Quantity quantity : all_quantities) {
            const auto fast = advanced(batch, made, points, quantity),
                       plain = predict(building, made.drive, trajectory, quantity);
            expect_near(fast, plain,
                        std::string(kernel::name_of(set)) + " " + name_of(quantity));
            most = std::max(most, difference(fast, plain));
        }
    }
    bemcal::test::print_measured(
        "kernel against the plain version, largest relative difference", most, "-",
        "1e-10");
}

TEST_P(FastAgainstPlain, EveryStepAgrees) {
    expect_steps(random_case(GetParam()), GetParam() + 2000);
}

TEST_P(FastWithEffectsAgainstPlain, EveryStepAgrees) {
    expect_steps(random_hooked_case(GetParam()), GetParam() + 5000);
}

TEST_P(FastWithAirSystemsAgainstPlain, EveryStepAgrees) {
    expect_steps(test::random_supplied_case(GetParam()), GetParam() + 7000);
}

TEST_P(FastWithSeasonsAgainstPlain, EveryStepAgrees) {
    expect_steps(test::random_seasonal_case(GetParam()), GetParam() + 9000);
}

TEST_P(FastWithCyclingAgainstPlain, EveryStepAgrees) {
    expect_steps(test::random_cycling_case(GetParam()), GetParam() + 11000);
}

/// All rooms get what the warmest asks for: no room asks for more than it gets.
TEST(FastAgainstPlainOfRooms, OneUnitCoolsAllRooms) {
    int n_seen = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        RandomCase made = random_case(seed);
        for (physics::Zone& zone : made.building.zones) {
            if (!zone.thermostat.rooms_differ() || zone.thermostat.imposed) continue;
            zone.thermostat.cooled_together = {1, 1, -1};
            ++n_seen;
        }
        expect_steps(made, seed + 2000);
    }
    EXPECT_GT(n_seen, 3);
}

/// A season's days are sorted for the ends of parameters' ranges.
TEST(FastWithSeasons, RefusesLimitsBeyondTheRanges) {
    RandomCase made = random_case(3);
    made.building.zones.resize(1);
    made.building.zones[0].couplings.clear();
    made.building.zones[0].thermostat.imposed = false;
    test::add_running_means(made.drive);
    made.building.zones[0].structure.heating_limit = 15;
    made.parameters = {
        test::parameter(made.building, "zone.*.heating_limit", -2, 2, Effect::offset)};
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    Matrix points(2, 1);
    points(0, 0) = 2;
    points(1, 0) = 6;
    kernel::Request request;
    request.annual = {Quantity::heating};
    const auto answers = batch.evaluate(points, request);
    EXPECT_EQ(answers[0].failure, "");
    EXPECT_NE(answers[1].failure.find("heating_limit = 21 degC"), std::string::npos);
}

// Of one zone, whose meter is read at once, and of two, whose powers add up.
TEST(FastAgainstPlain, AnEfficiencyThatIsNotAboveZeroIsTheFailureOfItsPoint) {
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
        RandomCase made = random_case(seed);
        made.building.plant.heating_carrier = Carrier::gas;
        made.building.plant.heating_efficiency = {0.9, 0, -1};
        made.parameters = {test::parameter(made.building, "plant.heating_efficiency", -1,
                                           1, Effect::replace)};
        const kernel::Batch batch(made.building, made.parameters, made.drive);
        Matrix points(3, 1);
        points.values = {0.8, -0.1, 0.8};
        kernel::Request request;
        request.annual = {Quantity::gas, Quantity::heating};
        request.monthly = {Quantity::gas};
        const auto answers = batch.evaluate(points, request);
        EXPECT_EQ(answers[0].failure, "");
        EXPECT_NE(answers[1].failure.find("heating_efficiency = -0.1 is not above 0"),
                  std::string::npos)
            << answers[1].failure;
        EXPECT_EQ(answers[2].failure, "");
        EXPECT_EQ(answers[2].annual, answers[0].annual);
    }
}

INSTANTIATE_TEST_SUITE_P(RandomBuildings, FastWithSeasonsAgainstPlain,
                         testing::Range(1U, 41U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, FastWithAirSystemsAgainstPlain,
                         testing::Range(1U, 41U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, FastWithCyclingAgainstPlain,
                         testing::Range(1U, 41U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, FastAgainstPlain, testing::Range(1U, 61U));
INSTANTIATE_TEST_SUITE_P(RandomBuildings, FastWithEffectsAgainstPlain,
                         testing::Range(1U, 41U));

}  // namespace bemcal::physics
