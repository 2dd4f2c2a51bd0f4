/// Readings against the plain version, their derivative, and what a lane depends on.
#include "kernel/plain_answer.hpp"
#include "kernel/response_derivative.hpp"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>

namespace {

std::atomic<long> n_allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
    ++n_allocations;
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    if (void* place = std::aligned_alloc(alignment, whole)) return place;
    throw std::bad_alloc();
}

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
    return counted(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* place) noexcept {
    std::free(place);
}
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept {
    std::free(place);
}
[[gnu::noinline]] void operator delete(void* place, std::align_val_t) noexcept {
    std::free(place);
}
[[gnu::noinline]] void operator delete(void* place, std::size_t,
                                       std::align_val_t) noexcept {
    std::free(place);
}

namespace bemcal::physics {

namespace {

using test::random_case;
using test::random_points;
using test::RandomCase;

std::vector<kernel::Channel> all_channels() {
    std::vector<kernel::Channel> channels;
    for (Quantity quantity :
         {Quantity::air_temperature, Quantity::heating, Quantity::cooling,
          Quantity::electricity, Quantity::gas, Quantity::district})
        for (Interval interval : {Interval::step, Interval::hourly, Interval::daily,
                                  Interval::monthly, Interval::annual})
            channels.push_back({quantity, interval});
    // Bills that begin within the 36 days of these cases, one of which ends beyond them.
    channels.push_back({Quantity::gas,
                        {Interval::monthly,
                         {parse_time("2021-02-03"), parse_time("2021-02-10 06:00"),
                          parse_time("2021-03-20")}}});
    return channels;
}

bool is_coupled(const RandomCase& made) {
    return !made.building.zones[0].couplings.empty();
}

/// A case whose zones are coupled, or not.
RandomCase first_case(bool coupled) {
    unsigned seed = 1;
    while (is_coupled(random_case(seed)) != coupled) ++seed;
    return random_case(seed);
}

std::vector<double> readings_of(const kernel::Response& response,
                                const kernel::Response::Run& run, std::size_t channel,
                                int lane) {
    std::vector<double> values;
    const double* at = response.readings(run, channel) + lane;
    for (std::size_t k = 0; k < response.n_readings(channel); ++k, at += response.lanes())
        values.push_back(*at);
    return values;
}

/// Within 1e-10 of the largest value.
void expect_near(const std::vector<double>& fast, const std::vector<double>& plain) {
    ASSERT_EQ(fast.size(), plain.size());
    double most = 1e-6;
    for (double value : plain) most = std::max(most, std::fabs(value));
    for (std::size_t k = 0; k < plain.size(); ++k)
        ASSERT_NEAR(fast[k], plain[k], 1e-10 * most);
}

/// Readings of all channels of a point, then its gradient.
using Numbers = std::vector<double>;

std::vector<Numbers> answers(const RandomCase& made, const Matrix& points,
                             const std::vector<kernel::Channel>& channels,
                             kernel::InstructionSet set) {
    const kernel::Batch batch(made.building, made.parameters, made.drive, set);
    const kernel::Response response(batch, channels);
    const auto run = response.make_run();
    test::write_sensitivities(response, *run);
    std::vector<Numbers> result;
    const auto lanes = static_cast<std::size_t>(response.lanes());
    Matrix gradient(lanes, made.parameters.size());
    for (std::size_t first = 0; first < points.rows; first += lanes) {
        const std::size_t count = std::min(lanes, points.rows - first);
        response.predict(points, first, count, *run);
        response.pull_back(*run, gradient);
        for (std::size_t k = 0; k < count; ++k) {
            Numbers& numbers = result.emplace_back();
            for (std::size_t c = 0; c < channels.size(); ++c)
                for (double value : readings_of(response, *run, c, static_cast<int>(k)))
                    numbers.push_back(value);
            numbers.insert(numbers.end(), gradient.row(k).begin(), gradient.row(k).end());
        }
    }
    return result;
}

void expect_same_bits(const Numbers& one, const Numbers& other) {
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t k = 0; k < one.size(); ++k)
        ASSERT_EQ(std::memcmp(&one[k], &other[k], sizeof(double)), 0)
            << k << ": " << one[k] << ", " << other[k];
}

/// All channels, and one alone, which is read in one pass with the powers.
void compare_with_scalar(kernel::InstructionSet set) {
    for (unsigned seed = 1; seed <= 16; ++seed) {
        const RandomCase made =
            seed <= 8 ? random_case(seed) : test::random_hooked_case(seed);
        if (is_coupled(made)) continue;
        const Matrix points = random_points(seed, made.parameters, 11);
        const std::vector<kernel::Channel> one{{Quantity::electricity, Interval::hourly}};
        for (const auto& channels : {test::some_channels(), one}) {
            const auto scalar =
                answers(made, points, channels, kernel::InstructionSet::scalar);
            const auto vector = answers(made, points, channels, set);
            for (std::size_t k = 0; k < points.rows; ++k)
                expect_same_bits(scalar[k], vector[k]);
        }
    }
}

Numbers row_of(const Matrix& matrix, std::size_t row) {
    return {matrix.row(row).begin(), matrix.row(row).end()};
}

class ResponseOfRandom : public testing::TestWithParam<unsigned> {};

}  // namespace

void expect_plain_readings(const RandomCase& made, unsigned seed) {
    const Matrix points = random_points(seed, made.parameters, 1);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const kernel::Response response(batch, all_channels());
    const auto run = response.make_run();
    ASSERT_EQ(response.predict(points, 0, 1, *run)[0], "");
    Building building = made.building;
    apply(made.building, made.parameters, points.row(0), building);
    const Trajectory trajectory = simulate(building, made.drive);
    for (std::size_t c = 0; c < response.channels().size(); ++c) {
        const auto [quantity, interval] = response.channels()[c];
        expect_near(readings_of(response, *run, c, 0),
                    aggregate(predict(building, made.drive, trajectory, quantity),
                              interval_bounds(made.drive.period(), interval), quantity));
    }
}

TEST_P(ResponseOfRandom, ReadingsAreThoseOfThePlainVersion) {
    expect_plain_readings(random_case(GetParam()), GetParam() + 3000);
}

TEST_P(ResponseOfRandom, ReadingsAreThoseOfThePlainVersionWithWhatEffectsBring) {
    expect_plain_readings(test::random_hooked_case(GetParam()), GetParam() + 6000);
}

INSTANTIATE_TEST_SUITE_P(Buildings, ResponseOfRandom, testing::Range(1U, 31U));

TEST(Response, DerivativeIsThatOfCentralDifferences) {
    for (unsigned seed = 1; seed <= 9; ++seed) {
        const RandomCase made = random_case(seed);
        if (!is_coupled(made)) test::expect_derivative(made);
    }
}

namespace {

/// Readings as of the plain version, and derivatives, of random buildings whose zones are
/// changed. \param change  of a zone; how many of its inputs \return of all zones
template <class ChangeZone>
int expect_there_and_back(unsigned n_seeds, ChangeZone change) {
    int n = 0;
    for (unsigned seed = 1; seed <= n_seeds; ++seed) {
        RandomCase made = test::random_hooked_case(seed);
        if (is_coupled(made)) continue;
        for (Zone& zone : made.building.zones) n += change(zone);
        made.parameters = test::every_number(made.building);
        test::expect_derivative(made);
        expect_plain_readings(made, seed);
    }
    return n;
}

constexpr Change far_down_by_night{-30, test::night, ChangeKind::shift};

}  // namespace

TEST(Response, SetPointsThatAnEffectBringsTogetherAreHeldApartThereAndBack) {
    const int n = expect_there_and_back(12, [](Zone& zone) {
        if (zone.thermostat.imposed) return 0;
        zone.thermostat.cooling_set_point.changes = {far_down_by_night};
        return 1;
    });
    EXPECT_GE(n, 4);
}

TEST(Response, AirThatEffectsUseUpIsNoneThereAndBack) {
    const int n = expect_there_and_back(3, [](Zone& zone) {
        for (AirFlow& flow : zone.flows) flow.air_change.changes = {far_down_by_night};
        zone.venting.air_change.changes = {far_down_by_night};
        return static_cast<int>(zone.flows.size());
    });
    EXPECT_GE(n, 2);
}

TEST(Response, ReadingsAreThoseThatErrorsAreMadeOf) {
    const RandomCase made = first_case(false);
    const Matrix points = random_points(4, made.parameters, 1);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    for (Quantity quantity : {Quantity::gas, Quantity::air_temperature})
        for (Interval interval : {Interval::step, Interval::daily}) {
            const kernel::Response response(batch, {{quantity, interval}});
            const auto run = response.make_run();
            response.predict(points, 0, 1, *run);
            const Numbers readings = readings_of(response, *run, 0, 0);
            const kernel::Request request{{}, {}, {{quantity, interval, readings}}};
            const kernel::ErrorSums errors = batch.evaluate(points, request)[0].errors[0];
            double square = 0;
            for (double value : readings) square += value * value;
            EXPECT_LE(errors.square, 1e-24 * square);
        }
}

TEST(Response, Avx2GivesTheBitsOfTheScalarKernel) {
    if (!kernel::is_supported(kernel::InstructionSet::v3))
        GTEST_SKIP() << "this processor has no AVX2";
    compare_with_scalar(kernel::InstructionSet::v3);
}

TEST(Response, Avx512GivesTheBitsOfTheScalarKernel) {
    if (!kernel::is_supported(kernel::InstructionSet::v4))
        GTEST_SKIP() << "this processor has no AVX-512";
    compare_with_scalar(kernel::InstructionSet::v4);
}

TEST(Response, APointsBitsDoNotDependOnItsLaneAndNeighbours) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const RandomCase made = random_case(seed);
        if (is_coupled(made)) continue;
        const Matrix points = random_points(seed, made.parameters, 7);
        const kernel::InstructionSet set = kernel::choose_instruction_set();
        const auto together = answers(made, points, test::some_channels(), set);
        for (std::size_t k = 0; k < points.rows; k += 3) {
            Matrix alone(1, points.cols);
            std::copy_n(points.row(k).data(), points.cols, alone.values.data());
            expect_same_bits(together[k],
                             answers(made, alone, test::some_channels(), set)[0]);
        }
    }
}

TEST(Response, AFailedPointHasNoGradientAndLeavesItsNeighboursAlone) {
    const RandomCase made = first_case(false);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const kernel::Response response(batch, test::some_channels());
    const auto run = response.make_run();
    test::write_sensitivities(response, *run);
    const auto count = static_cast<std::size_t>(response.lanes());
    Matrix points = random_points(2, made.parameters, count);
    Matrix whole(count, points.cols), broken(count, points.cols);
    response.predict(points, 0, count, *run);
    response.pull_back(*run, whole);
    for (std::size_t p = 0; p < made.parameters.size(); ++p)
        if (made.parameters[p].name == "construction.*.u_value") points(0, p) = 1e4;
    const auto failures = response.predict(points, 0, count, *run);
    response.pull_back(*run, broken);
    EXPECT_NE(failures[0].find("H_tr_op"), std::string::npos) << failures[0];
    for (double value : broken.row(0)) EXPECT_TRUE(std::isnan(value));
    for (std::size_t k = 1; k < count; ++k) {
        EXPECT_EQ(failures[k], "");
        expect_same_bits(row_of(whole, k), row_of(broken, k));
    }
}

TEST(Response, AnEfficiencyThatNothingCanBeDividedByIsTheFailureOfItsPoint) {
    RandomCase made = first_case(false);
    made.building.plant.cooling_carrier = Carrier::electricity;
    made.building.plant.cooling_cop = {3, 0, -1};
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const kernel::Response response(batch, {{Quantity::electricity, Interval::hourly}});
    const auto run = response.make_run();
    Matrix points = random_points(2, made.parameters, 1);
    for (std::size_t p = 0; p < made.parameters.size(); ++p)
        if (made.parameters[p].name == "plant.cooling_cop") points(0, p) = 0;
    const auto failures = response.predict(points, 0, 1, *run);
    EXPECT_NE(failures[0].find("cooling_cop"), std::string::npos) << failures[0];
}

TEST(Response, AResultThatIsNotFiniteIsAFailure) {
    RandomCase made = first_case(false);
    made.drive.theta_e[static_cast<std::size_t>(made.drive.n_steps() - 5)] =
        std::numeric_limits<double>::quiet_NaN();
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const kernel::Response response(batch, {{Quantity::heating, Interval::hourly}});
    const auto run = response.make_run();
    const auto failures =
        response.predict(random_points(2, made.parameters, 1), 0, 1, *run);
    EXPECT_NE(failures[0].find("not finite"), std::string::npos) << failures[0];
}

TEST(Response, OfTwoParametersOfOneNumberTheLastOneHasTheDerivative) {
    RandomCase made = first_case(false);
    const Building& building = made.building;
    made.parameters = {
        test::parameter(building, "zone.*.volume", 0.9, 1.1, Effect::factor),
        test::parameter(building, "zone.*.volume", 0.9, 1.1, Effect::factor)};
    const auto numbers =
        answers(made, test::nominal_points(made.parameters, 1), test::some_channels(),
                kernel::choose_instruction_set())[0];
    EXPECT_EQ(numbers[numbers.size() - 2], 0);
    EXPECT_NE(numbers[numbers.size() - 1], 0);
}

TEST(Response, ALinkedParameterHasTheSumOfTheDerivativesOfItsNumbers) {
    RandomCase made = first_case(false);
    made.parameters = test::every_number(made.building);
    Parameter linked{"areas", "", 0.9, 1.1, Effect::factor, {}, 1};
    for (const Target& target : resolve(made.building, "zone.*.surface.*.area"))
        linked.targets.push_back(target);
    const auto points_of = [&] { return test::nominal_points(made.parameters, 1); };
    const auto set = kernel::choose_instruction_set();
    const Numbers apart = answers(made, points_of(), test::some_channels(), set)[0];
    double sum = 0;
    const std::size_t first = apart.size() - made.parameters.size();
    for (std::size_t p = 0; p < made.parameters.size(); ++p) {
        const Target& target = made.parameters[p].targets[0];
        const bool is_area =
            fields()[static_cast<std::size_t>(target.field)].key == std::string("area");
        if (target.part == Part::surface && is_area) sum += apart[first + p];
    }
    made.parameters = {linked};
    const Numbers together = answers(made, points_of(), test::some_channels(), set)[0];
    EXPECT_NEAR(together.back(), sum, 1e-12 * std::fabs(sum));
}

TEST(Response, TheWayBackAllocatesNothing) {
    const RandomCase made = first_case(false);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const kernel::Response response(batch, test::some_channels());
    const auto run = response.make_run();
    test::write_sensitivities(response, *run);
    const auto count = static_cast<std::size_t>(response.lanes());
    const Matrix points = random_points(2, made.parameters, count);
    Matrix gradient(count, points.cols);
    response.predict(points, 0, count, *run);
    response.pull_back(*run, gradient);
    const long before = n_allocations;
    response.pull_back(*run, gradient);
    EXPECT_EQ(n_allocations - before, 0);
    response.predict(points, 0, count, *run);
    EXPECT_LE(n_allocations - before, 2);  // the failures, kept and returned
}

TEST(Response, ARunThatGoesThereAloneReadsTheSameAndHasNoWayBack) {
    const RandomCase made = first_case(false);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const kernel::Response response(batch, test::some_channels());
    ASSERT_TRUE(response.is_differentiable());
    const Matrix points = random_points(1, made.parameters, 1);
    const auto both = response.make_run(), there = response.make_run(kernel::Way::there);
    response.predict(points, 0, 1, *both);
    response.predict(points, 0, 1, *there);
    const std::size_t n = response.n_readings(0) * response.lanes();
    EXPECT_TRUE(std::equal(response.readings(*both, 0), response.readings(*both, 0) + n,
                           response.readings(*there, 0)));
    Matrix gradient(1, made.parameters.size());
    EXPECT_THROW(response.pull_back(*there, gradient), std::logic_error);
}

TEST(Response, CoupledZonesArePredictedWithoutAWayBack) {
    const RandomCase made = first_case(true);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const kernel::Response response(batch, test::some_channels());
    EXPECT_FALSE(response.is_differentiable());
    const auto run = response.make_run();
    Matrix gradient(1, made.parameters.size());
    response.predict(random_points(1, made.parameters, 1), 0, 1, *run);
    EXPECT_THROW(response.pull_back(*run, gradient), std::logic_error);
}

}  // namespace bemcal::physics
