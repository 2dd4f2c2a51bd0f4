#include "loop/closed_days.hpp"
#include "loop/windy_model.hpp"

#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;

namespace {

int number_of(unsigned month, unsigned day) {
    using namespace std::chrono;
    return static_cast<int>(
        sys_days(year(2021) / static_cast<int>(month) / static_cast<int>(day))
            .time_since_epoch()
            .count());
}

/// A day that looks so much like a Sunday, where ordinary ones spread so far about 0.
bool is_closed(double share, double spread) {
    const int monday = number_of(3, 1);
    return !days_alone({{{monday, share}}, 0, spread}, std::nullopt).empty();
}

}  // namespace

TEST(ClosedDays, AreBetweenHalfAndTwiceASunday) {
    EXPECT_FALSE(is_closed(0.49, 0.01));
    EXPECT_TRUE(is_closed(0.51, 0.01));
    EXPECT_TRUE(is_closed(1.69, 0.01));
    EXPECT_FALSE(is_closed(1.71, 0.01));
}

TEST(ClosedDays, AreFarFromOrdinaryOnes) {
    EXPECT_FALSE(is_closed(0.99, 0.2));  // five deviations are 1
    EXPECT_TRUE(is_closed(1.01, 0.2));
}

TEST(ClosedDays, ALongRunTakesItsWeekendsIn) {
    const int monday = number_of(3, 1);
    const auto two = runs_of({monday, monday + 1});
    ASSERT_EQ(two.size(), 1U);
    EXPECT_EQ(two[0].first, monday);
    EXPECT_EQ(two[0].last, monday + 1);
    const auto three = runs_of({monday, monday + 1, monday + 2});
    ASSERT_EQ(three.size(), 1U);
    EXPECT_EQ(three[0].first, monday - 2);
    EXPECT_EQ(three[0].last, monday + 2);
}

// People stay away for a fortnight, and the plant runs on: its days are no Sundays.
TEST(ClosedDays, AreFoundWherePeopleStayAwayAlone) {
    study::Case made = test::windy_case();
    const int first = static_cast<int>(std::chrono::floor<std::chrono::days>(
                                           made.periods[0].from.time_since_epoch())
                                           .count()) +
                      30;
    const effects::Effect away =
        effects::with_days("holidays with the plant running", {{first, first + 13}});
    test::measure(made, away, 1, 3);
    const LoopData data(made, test::WindyModel::options());
    const Place place = make_place(data, {}, data.drive);
    const Standing standing =
        calibrate(data, place, {}, std::vector<double>(place.unknowns.size()));
    const auto found = closed_days(data, place, standing);
    const auto of_use = std::ranges::find(found, away.name, &effects::Effect::name);
    ASSERT_NE(of_use, found.end());
    for (const effects::Days& days : of_use->days) {
        EXPECT_GE(days.first, first - 2);
        EXPECT_LE(days.last, first + 15);
    }
}
