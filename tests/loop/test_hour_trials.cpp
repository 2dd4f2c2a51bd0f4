#include "loop/hour_trials.hpp"
#include "loop/windy_model.hpp"

#include <map>

#include <gtest/gtest.h>

using namespace bemcal;
using namespace bemcal::loop;
using physics::DailyRun;
using physics::DayKind;

namespace {

/// The windy building with these hours, and what its meters would read.
struct Simulated {
    explicit Simulated(const physics::WeekHours& hours) {
        study::Case made = test::WindyModel::measured();
        physics::set_hours(hours, made.profiles[0].schedule);
        const LoopData data(made, test::WindyModel::options());
        const Place place = make_place(data, {}, data.drive);
        const BuiltModel built = build(place, {});
        Matrix point(1, built.unknowns.size());
        for (std::size_t k = 0; k < point.cols; ++k)
            point(0, k) = built.unknowns[k].within(0);
        predicted = built.fit_model->predict(point).values;
    }
    std::vector<double> predicted;
};

constexpr physics::WeekHours office = {{{8, 18}, {}, {}}};

}  // namespace

// Every run is simulated once, and is what a building with these hours does, bit for bit.
TEST(HourTrials, ALaneIsTheBuildingWithTheseHours) {
    const test::WindyModel model({});
    const ScheduleHours hours(model.data, 0);
    const BuiltModel built = build(model.place, {});
    const std::vector<double> x(built.unknowns.size(), 0.0);
    std::map<std::pair<int, int>, std::vector<double>> tried;
    try_runs({built, hours, office}, model.place.channels, DayKind::working_day, {}, x,
             [&](const DailyRun& run, std::span<const double> predicted) {
                 EXPECT_TRUE(tried
                                 .emplace(std::pair(run.from, run.until),
                                          std::vector(predicted.begin(), predicted.end()))
                                 .second);
             });
    EXPECT_EQ(tried.size(), physics::all_runs().size());
    for (const DailyRun& run : {DailyRun{8, 18}, DailyRun{}, DailyRun{0, 24},
                                DailyRun{7, 8}, DailyRun{12, 23}}) {
        const Simulated own(physics::WeekHours{run});
        const auto& lane = tried.at({run.from, run.until});
        ASSERT_EQ(own.predicted.size(), lane.size());
        for (std::size_t k = 0; k < lane.size(); ++k)
            ASSERT_NEAR(own.predicted[k], lane[k], 1e-9) << run.from << " " << run.until;
    }
}

// Of a grid, too: each of its runs once, and as it is among all.
TEST(HourTrials, AGridHasItsRunsAlone) {
    const test::WindyModel model({});
    const ScheduleHours hours(model.data, 0);
    const BuiltModel built = build(model.place, {});
    const std::vector<double> x(built.unknowns.size(), 0.0);
    using Tried = std::map<std::pair<int, int>, std::vector<double>>;
    const auto tried_of = [&](const RunGrid& grid) {
        Tried tried;
        try_runs({built, hours, office}, model.place.channels, DayKind::working_day, grid,
                 x, [&](const DailyRun& run, std::span<const double> predicted) {
                     tried[{run.from, run.until}] = {predicted.begin(), predicted.end()};
                 });
        return tried;
    };
    const Tried all = tried_of({});
    for (const RunGrid& grid : {RunGrid{0, 24, 0, 24, 2}, RunGrid{0, 24, 0, 24, 3},
                                RunGrid{7, 9, 17, 19, 1}, RunGrid{22, 24, 23, 24, 1}}) {
        std::size_t n = 0;
        for (const auto& [run, predicted] : all) {
            const auto [from, until] = run;
            const bool is_off = from == until;
            if (is_off || from < grid.from || from > grid.last_from ||
                until < grid.until || until > grid.last_until ||
                (from - grid.from) % grid.apart != 0 ||
                (until - grid.until) % grid.apart != 0)
                continue;
            n += 1;
        }
        const Tried some = tried_of(grid);
        for (const auto& [run, predicted] : some) {
            ASSERT_TRUE(all.contains(run));
            for (std::size_t k = 0; k < predicted.size(); ++k)
                ASSERT_NEAR(all.at(run)[k], predicted[k], 1e-9)
                    << run.first << " " << run.second;
        }
        EXPECT_EQ(some.size() - some.count({0, 0}), n);
    }
}

TEST(HourTrials, RowsAreThoseOfTheSchedule) {
    const study::Case made = test::WindyModel::measured();
    const LoopData data(made, test::WindyModel::options());
    const ScheduleHours hours(data, 0);
    const auto row = data.drive->profiles.row(0);
    EXPECT_EQ(hours.row_of(office), std::vector<double>(row.begin(), row.end()));
}
