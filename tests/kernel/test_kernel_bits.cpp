/// The same bits for every instruction set, lane and neighbour; failures stay with their
/// point.
#include "kernel/plain_answer.hpp"
#include "kernel/random_hooks.hpp"

#include <cstdlib>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace bemcal::physics {

namespace {

using test::random_case;
using test::random_points;
using test::RandomCase;

kernel::Request totals() {
    return {{Quantity::heating, Quantity::cooling, Quantity::gas, Quantity::electricity},
            {Quantity::heating, Quantity::air_temperature},
            {}};
}

/// Totals, and errors against hourly and daily readings of two quantities.
kernel::Request totals_and_readings(const RandomCase& made) {
    kernel::Request request = totals();
    const TimeAxis period = made.drive.period();
    for (Interval interval : {Interval::hourly, Interval::daily})
        for (Quantity quantity : {Quantity::gas, Quantity::air_temperature}) {
            const std::size_t n = interval_bounds(period, interval).size() - 1;
            request.readings.push_back({quantity, interval, std::vector<double>(n, 3.5)});
        }
    return request;
}

/// All numbers of an answer, in order.
std::vector<double> numbers_of(const kernel::PointAnswer& answer) {
    std::vector<double> numbers = answer.annual;
    numbers.insert(numbers.end(), answer.monthly.begin(), answer.monthly.end());
    for (const auto* all : {&answer.errors, &answer.monthly_errors})
        for (const kernel::ErrorSums& sums : *all)
            for (double number :
                 {sums.n, sums.error, sums.square, sums.simulated, sums.simulated_square,
                  sums.product, sums.n_relative, sums.relative})
                numbers.push_back(number);
    return numbers;
}

void expect_same_bits(const kernel::PointAnswer& one, const kernel::PointAnswer& other) {
    const std::vector<double> a = numbers_of(one), b = numbers_of(other);
    EXPECT_EQ(one.failure, other.failure);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
        ASSERT_EQ(std::memcmp(&a[k], &b[k], sizeof(double)), 0)
            << k << ": " << a[k] << ", " << b[k];
}

std::vector<kernel::PointAnswer> evaluate(const RandomCase& made, const Matrix& points,
                                          const kernel::Request& request,
                                          kernel::InstructionSet set) {
    return kernel::Batch(made.building, made.parameters, made.drive, set)
        .evaluate(points, request);
}

/// Each point of `set` against the same in the scalar kernel.
void compare_with_scalar(kernel::InstructionSet set) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const RandomCase made =
            seed <= 28 ? random_case(seed) : test::random_hooked_case(seed);
        const Matrix points = random_points(seed, made.parameters, 19);
        const kernel::Request request = totals_and_readings(made);
        const auto scalar =
            evaluate(made, points, request, kernel::InstructionSet::scalar);
        const auto vector = evaluate(made, points, request, set);
        for (std::size_t k = 0; k < points.rows; ++k) {
            SCOPED_TRACE(seed);
            expect_same_bits(scalar[k], vector[k]);
        }
    }
}

/// A set of conductances that leaves the method: opaque elements beyond the film of the
/// mass.
void break_point(const RandomCase& made, Matrix& points, std::size_t point) {
    for (std::size_t p = 0; p < made.parameters.size(); ++p)
        if (made.parameters[p].name == "construction.*.u_value") points(point, p) = 1e4;
}

}  // namespace

TEST(KernelBits, Avx2GivesTheBitsOfTheScalarKernel) {
    if (!kernel::is_supported(kernel::InstructionSet::v3))
        GTEST_SKIP() << "this processor has no AVX2";
    compare_with_scalar(kernel::InstructionSet::v3);
}

TEST(KernelBits, Avx512GivesTheBitsOfTheScalarKernel) {
    if (!kernel::is_supported(kernel::InstructionSet::v4))
        GTEST_SKIP() << "this processor has no AVX-512";
    compare_with_scalar(kernel::InstructionSet::v4);
}

TEST(KernelBits, APointsBitsDoNotDependOnItsLaneAndNeighbours) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const RandomCase made = random_case(seed);
        const Matrix points = random_points(seed, made.parameters, 13);
        const kernel::Request request = totals_and_readings(made);
        const kernel::Batch batch(made.building, made.parameters, made.drive);
        const auto together = batch.evaluate(points, request);
        for (std::size_t k = 0; k < points.rows; k += 3) {
            Matrix alone(1, points.cols);
            std::copy_n(points.row(k).data(), points.cols, alone.values.data());
            expect_same_bits(together[k], batch.evaluate(alone, request).front());
        }
    }
}

TEST(KernelBits, TotalsDoNotDependOnWhatElseIsAskedFor) {
    const RandomCase made = random_case(7);
    const Matrix points = random_points(7, made.parameters, 5);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const auto plain = batch.evaluate(points, totals());
    auto more = batch.evaluate(points, totals_and_readings(made));
    for (std::size_t k = 0; k < points.rows; ++k) {
        more[k].errors.clear();
        more[k].monthly_errors.clear();
        expect_same_bits(plain[k], more[k]);
    }
}

TEST(KernelBits, AFailedPointKeepsItsReasonAndLeavesItsNeighboursAlone) {
    const RandomCase made = random_case(2);
    Matrix points = random_points(2, made.parameters, 9);
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const auto whole = batch.evaluate(points, totals());
    break_point(made, points, 4);
    const auto broken = batch.evaluate(points, totals());
    EXPECT_NE(broken[4].failure.find("H_tr_op"), std::string::npos) << broken[4].failure;
    EXPECT_TRUE(broken[4].annual.empty());
    for (std::size_t k = 0; k < points.rows; ++k) {
        if (k == 4) continue;
        expect_same_bits(whole[k], broken[k]);
    }
}

TEST(KernelBits, AResultThatIsNotFiniteFailsWithTheStepOfThePlainVersion) {
    RandomCase made = random_case(2);
    made.drive.theta_e[static_cast<std::size_t>(made.drive.n_steps() - 5)] =
        std::numeric_limits<double>::quiet_NaN();
    const Matrix points = random_points(2, made.parameters, 3);
    for (const kernel::PointAnswer& answer :
         evaluate(made, points, totals(), kernel::choose_instruction_set()))
        EXPECT_NE(answer.failure.find("not finite"), std::string::npos) << answer.failure;
}

TEST(KernelBits, TheEnvironmentChoosesTheInstructionSet) {
    setenv("BEMCAL_KERNEL", "scalar", 1);
    EXPECT_EQ(kernel::choose_instruction_set(), kernel::InstructionSet::scalar);
    setenv("BEMCAL_KERNEL", "sse9", 1);
    EXPECT_THROW(kernel::choose_instruction_set(), std::invalid_argument);
    unsetenv("BEMCAL_KERNEL");
    EXPECT_TRUE(kernel::is_supported(kernel::choose_instruction_set()));
}

}  // namespace bemcal::physics
