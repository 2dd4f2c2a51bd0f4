/// Classes of steps: numbered by first appearance, whatever finds them.
#include "kernel/partition.hpp"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace bemcal::physics {
namespace {

/// The same by an ordered map.
template <class Key>
kernel::Partition classes_of(const std::vector<Key>& keys) {
    std::map<Key, int> known;
    kernel::Partition classes;
    for (std::size_t step = 0; step < keys.size(); ++step) {
        const auto [entry, is_new] = known.try_emplace(keys[step], classes.size());
        if (is_new) classes.first.push_back(static_cast<int>(step));
        classes.class_of.push_back(entry->second);
    }
    return classes;
}

void expect_same(const kernel::Partition& a, const kernel::Partition& b) {
    EXPECT_EQ(a.class_of, b.class_of);
    EXPECT_EQ(a.first, b.first);
}

/// Many values, few, and runs of few.
Drive three_profiles(std::size_t n_steps) {
    Drive drive;
    drive.axis.n_steps = static_cast<int>(n_steps);
    drive.profiles = Matrix(3, n_steps);
    for (std::size_t k = 0; k < n_steps; ++k) {
        const double x = static_cast<double>(k);
        drive.profiles(0, k) = std::sin(x * x);
        drive.profiles(1, k) = std::floor(5 * std::sin(x));
        drive.profiles(2, k) = static_cast<double>(k / 50 % 7);
    }
    return drive;
}

std::vector<double> row_of(const Drive& drive, std::size_t row) {
    return {drive.profiles.row(row).begin(), drive.profiles.row(row).end()};
}

TEST(Partition, OfAProfileAreItsValues) {
    const Drive drive = three_profiles(20000);
    kernel::ProfileClasses classes(drive);
    for (int profile : {0, 1, 2, 0})
        expect_same(classes.of(profile),
                    classes_of(row_of(drive, static_cast<std::size_t>(profile))));
}

TEST(Partition, OfSeveralProfilesAreTheirTuples) {
    const Drive drive = three_profiles(5000);
    kernel::ProfileClasses classes(drive);
    const auto all = classes.refine(kernel::one_class(5000), {1, 2, 0});
    std::vector<std::array<double, 3>> tuples;
    std::vector<std::pair<double, double>> pairs;
    for (std::size_t k = 0; k < 5000; ++k) {
        tuples.push_back(
            {drive.profiles(0, k), drive.profiles(1, k), drive.profiles(2, k)});
        pairs.emplace_back(drive.profiles(2, k), drive.profiles(1, k));
    }
    expect_same(all, classes_of(tuples));
    expect_same(classes.refine(kernel::one_class(5000), {2, 1}), classes_of(pairs));
    expect_same(classes.refine(all, {1}), all);
}

TEST(Partition, ZeroHasNoSign) {
    Drive drive = three_profiles(3);
    std::ranges::copy(std::vector<double>{0, -0.0, 1}, drive.profiles.row(0).begin());
    EXPECT_EQ(kernel::ProfileClasses(drive).of(0).class_of, (std::vector<int>{0, 0, 1}));
}

}  // namespace
}  // namespace bemcal::physics
