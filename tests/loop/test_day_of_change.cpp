/// The day is that on which residuals of all meters take on other hours.
#include "base/random.hpp"
#include "effects/driver_functions.hpp"
#include "loop/day_of_change.hpp"
#include "loop/decisions.hpp"
#include "loop/windy_model.hpp"

#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using test::measure, test::windy_case;

namespace {

/// Nothing but noise of 1 and, from a day on, so much more in the mornings.
struct Residuals {
    LoopData data;
    Place place;
    Standing standing;
    effects::FunctionDrivers drivers;

    explicit Residuals(const study::Case& made) : data(made, {}) {
        place = make_place(data, {}, data.drive);
        drivers = effects::function_drivers(surroundings_of(place));
    }
    std::optional<double> day(int first, double more) {
        standing.noise.assign(data.targets.n_channels(), {});
        standing.residuals.assign(data.targets.size(), 0.0);
        Stream random(7, 0, 0);
        for (std::size_t k = 0; k < standing.residuals.size(); ++k) {
            const auto since = data.begins[k] - data.training().from;
            const int hour = static_cast<int>(since / std::chrono::hours(1)) % 24;
            const bool is_behind = since >= std::chrono::days(first);
            standing.residuals[k] =
                random.uniform() - 0.5 + (is_behind && hour >= 6 && hour < 12 ? more : 0);
        }
        return day_of_change(data, standing, drivers, place);
    }
};

/// Training of so many days.
study::Case measured(int n_days) {
    study::Case made = windy_case();
    made.weather = test::made_up_weather(n_days + 40);
    for (int k = 0; k < made.weather.axis.n_steps; ++k)
        made.weather.wind_speed.push_back(4 + 3 * std::sin(k / 17.0));
    made.periods = {{"training", test::day(7), test::day(7 + n_days)},
                    {"held_out", test::day(7 + n_days), test::day(n_days + 37)}};
    measure(made, test::gains_of_the_morning(), 0, 3);
    return made;
}

}  // namespace

TEST(DayOfChange, IsTheFirstWithOtherHours) {
    Residuals residuals(measured(200));
    const double days_of_year = 365.25;
    for (const int first : {92, 101}) {
        const auto day = residuals.day(first, 2);
        ASSERT_TRUE(day);
        EXPECT_DOUBLE_EQ(*day, first / days_of_year);
    }
}

TEST(DayOfChange, LeavesASeasonOnEitherSide) {
    constexpr int least = decisions::least_days_of_change;
    Residuals residuals(measured(2 * least + 10));
    const auto day = residuals.day(least - 3, 2);
    ASSERT_TRUE(day);
    EXPECT_NEAR(*day, least / 365.25, 1e-9);
    EXPECT_FALSE(Residuals(measured(2 * least)).day(least, 2));
    EXPECT_TRUE(Residuals(measured(2 * least + 1)).day(least, 2));
}
