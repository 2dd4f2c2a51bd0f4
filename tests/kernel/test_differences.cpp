/// Sums over the mixed rows of a Sobol design against the same sums of rows that were
/// written, to the bit.
#include "kernel/random_building.hpp"

#include <gtest/gtest.h>

namespace bemcal::physics {

namespace {

using test::random_case;
using test::random_points;
using test::RandomCase;
using Rows = std::vector<double>;  ///< [steps x lanes], or [steps x 3 x lanes] of sums

/// Groups of mixed rows, and the rows that they are compared with.
struct Design {
    const kernel::Batch& batch;
    std::vector<kernel::Batch::GroupPointer> groups;
    std::vector<Rows> a, b;

    Design(const kernel::Batch& of, const RandomCase& made, std::size_t n_groups)
        : batch(of) {
        const auto n_lanes = static_cast<std::size_t>(batch.lanes());
        const Matrix points = random_points(7, made.parameters, n_groups * n_lanes);
        test::Dice dice(11);
        const auto any_rows = [&] {
            Rows rows(static_cast<std::size_t>(made.drive.n_steps()) * n_lanes);
            for (double& value : rows) value = dice.between(-1000, 1000);
            return rows;
        };
        for (std::size_t k = 0; k < n_groups; ++k) {
            groups.push_back(batch.make_group());
            batch.prepare(points, k * n_lanes, n_lanes, *groups[k]);
            batch.warm_up(*groups[k]);
            a.push_back(any_rows());
            b.push_back(any_rows());
        }
    }

    Rows sums(int begin, int end, Quantity quantity) const {
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(begin) * batch.lanes();
        std::vector<kernel::Batch::Mixed> mixed;
        for (std::size_t k = 0; k < groups.size(); ++k)
            mixed.push_back({groups[k].get(), a[k].data() + at, b[k].data() + at});
        // What was there before does not count.
        Rows sums(static_cast<std::size_t>((end - begin) * 3 * batch.lanes()), 1e9);
        batch.sum_differences(mixed, begin, end, quantity, sums.data());
        return sums;
    }

    Rows plain_sums(int n_steps, Quantity quantity) const {
        const auto n_lanes = static_cast<std::size_t>(batch.lanes()),
                   n = static_cast<std::size_t>(n_steps) * n_lanes;
        Rows sums(3 * n, 0.0);
        for (std::size_t k = 0; k < groups.size(); ++k) {
            Rows y(n);
            batch.advance(*groups[k], 0, n_steps, quantity, y.data());
            for (std::size_t j = 0; j < n; ++j) {
                double* sum = sums.data() + j / n_lanes * 3 * n_lanes + j % n_lanes;
                const double d = y[j] - a[k][j];
                sum[0] = std::fma(b[k][j], d, sum[0]);
                sum[n_lanes] += d;
                sum[2 * n_lanes] = std::fma(d, d, sum[2 * n_lanes]);
            }
        }
        return sums;
    }
};

/// The period in three parts.
Rows sums_in_parts(const Design& design, int n_steps, Quantity quantity) {
    Rows all;
    const int bounds[] = {0, n_steps / 3, n_steps / 3 + 1, n_steps};
    for (int part = 0; part < 3; ++part) {
        const Rows sums = design.sums(bounds[part], bounds[part + 1], quantity);
        all.insert(all.end(), sums.begin(), sums.end());
    }
    return all;
}

class DifferencesOfRandom : public testing::TestWithParam<unsigned> {};

TEST_P(DifferencesOfRandom, AreThoseOfWrittenRows) {
    const RandomCase made = random_case(GetParam());
    const int n_steps = made.drive.n_steps() - made.drive.n_warm_up;
    const std::size_t n_groups = 1 + GetParam() % 5;
    for (kernel::InstructionSet set :
         {kernel::InstructionSet::scalar, kernel::InstructionSet::v3,
          kernel::InstructionSet::v4}) {
        if (!kernel::is_supported(set)) continue;
        const kernel::Batch batch(made.building, made.parameters, made.drive, set);
        for (Quantity quantity :
             {Quantity::heating, Quantity::electricity, Quantity::air_temperature})
            EXPECT_EQ(sums_in_parts(Design(batch, made, n_groups), n_steps, quantity),
                      Design(batch, made, n_groups).plain_sums(n_steps, quantity))
                << kernel::name_of(set) << " " << name_of(quantity);
    }
}

// Of the groups that met an electricity meter first, another meter is asked.
TEST(Differences, FollowTheMeter) {
    const RandomCase made = random_case(1);
    const int n_steps = made.drive.n_steps() - made.drive.n_warm_up;
    const kernel::Batch batch(made.building, made.parameters, made.drive);
    const Design design(batch, made, 2);
    design.sums(0, 24, Quantity::electricity);
    const Rows after = design.sums(24, n_steps, Quantity::heating);
    const Rows plain = Design(batch, made, 2).plain_sums(n_steps, Quantity::heating);
    EXPECT_TRUE(std::ranges::equal(
        after,
        std::span(plain).subspan(3 * 24 * static_cast<std::size_t>(batch.lanes()))));
}

Rows rows_of(const kernel::Batch& batch, int n_steps, Quantity quantity,
             kernel::Batch::Group& group) {
    Rows rows(static_cast<std::size_t>(n_steps * batch.lanes()));
    batch.warm_up(group);
    batch.advance(group, 0, n_steps, quantity, rows.data());
    return rows;
}

// Rows that differ in one parameter after another, as those of a Sobol design do.
TEST(Differences, GroupsOfOneDesignAreAsGroupsOfTheirOwn) {
    for (unsigned seed = 4; seed < 10; ++seed) {
        const RandomCase made = random_case(seed);
        const int n_steps = made.drive.n_steps() - made.drive.n_warm_up;
        const kernel::Batch batch(made.building, made.parameters, made.drive);
        const auto groups =
            batch.make_groups(made.parameters.size() + 1, Quantity::electricity);
        std::vector<Matrix> points(groups.size(), random_points(1, made.parameters, 1));
        const Matrix other = random_points(2, made.parameters, 1);
        for (std::size_t i = 0; i < made.parameters.size(); ++i)
            points[i](0, i) = other(0, i);
        for (std::size_t r = 0; r < groups.size(); ++r)
            batch.prepare(points[r], 0, 1, *groups[r]);
        for (std::size_t r = 0; r < groups.size(); ++r) {
            const auto alone = batch.make_group();
            batch.prepare(points[r], 0, 1, *alone);
            EXPECT_EQ(rows_of(batch, n_steps, Quantity::electricity, *groups[r]),
                      rows_of(batch, n_steps, Quantity::electricity, *alone))
                << seed << " " << r;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(RandomBuildings, DifferencesOfRandom, testing::Range(4U, 16U));

}  // namespace

}  // namespace bemcal::physics
