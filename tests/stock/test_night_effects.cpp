/// What a night tells of an effect that was adopted, on readings made by the model itself
/// with an effect that holds, ends or changes, or with one that begins: the search is
/// called for the last alone.
#include "base/random.hpp"
#include "job/small_office.hpp"
#include "job/stock.hpp"
#include "stats/distributions.hpp"
#include "stock/look.hpp"
#include "stock/night.hpp"

#include <functional>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using stock::StockRecord;

constexpr int n_known = 224, n_new = 84;  // days
constexpr const char* of_night = "warmth of the hall";
constexpr const char* night_section =
    "[[effect]]\nname = \"warmth of the hall\"\nhook = \"meter addition\"\n"
    "meter = \"electricity\"\ngate = \"night\"\ncoefficient = 3\n";

physics::Seconds day_at(int day) {
    return physics::parse_time("2021-01-01") + std::chrono::days(day);
}

/// One small office of a stock whose loop has found that effect, in the known days.
class Hall {
  public:
    Hall() {
        folder_.write("weather.csv", small_weather(24 * (n_known + n_new)));
        folder_.write("hall.csv", small_readings(24 * (n_known + n_new)));
        std::string text = small_stock_building();
        text = replaced(text, "[\"2021-01-01\", \"2021-01-31\"]",
                        fmt::format("[\"2021-01-01\", \"{}\"]",
                                    physics::format_date(day_at(n_known - 1))));
        text = replaced(text, "held_out = [\"2021-02-01\", \"2021-02-28\"]",
                        "since = [\"2021-08-13\", \"@to@\"]");
        text = replaced(text, "mask = [\"2021-01-20/2021-01-21\"]\n", "");
        folder_.write("building.toml", text);
        write_table(n_known + n_new);
        folder_.write(
            "job.toml",
            "seed = 3\n[stock]\nfalse_alarms = 0.001\ntable = \"stock.csv\"\ntemplate = "
            "\"building.toml\"\n[[study]]\nkind = \"loop\"\nmost_effects = "
            "1\ntry_structures = false\nfunctions = false\ngeneric = false\n");
    }

    static StockRecord first_night() {
        StockRecord record;
        record.name = "hall";
        record.status = "calibrated";
        record.adopted_hash = "same";
        record.known_from = static_cast<double>(day_at(0).time_since_epoch().count());
        record.known_to = static_cast<double>(day_at(n_known).time_since_epoch().count());
        record.effects = {{of_night, "kW", "new", night_section, 3, 2.9, 3.1}};
        record.fits = {{"electricity", "kWh", "training", 1000, 100, 0.5, 0.2, 0}};
        return record;
    }

    /// Readings with so much of the effect before and from a day on, and with something
    /// from it on, by the hour [kWh] on a day counted from it.
    void make_readings(
        double before, double after, int from,
        const std::function<double(int)>& added = [](int) { return 0; }) const {
        std::vector<input::InputFile> log;
        const Job job = this->job();
        const StockRecord record = first_night();
        const auto& line = job.stock->lines.at(0);
        const auto known = stock::known_of(record);
        const auto with =
            stock::day_sums(stock::adopted_building(job, line, record, known, log));
        const auto without = stock::day_sums(
            stock::adopted_building(job, line, record, known, log, &record.effects[0]));
        Stream random(11, 0, 0);
        const auto& begins = with.series[0].begins;
        std::string text = "time,elec_kWh,T_air_C\n";
        for (std::size_t k = 0; k < begins.size(); ++k) {
            const auto day = static_cast<int>(
                std::chrono::floor<std::chrono::days>(begins[k] - day_at(from)).count());
            const bool is_later = day >= 0;
            const auto of = [&](std::size_t meter) {
                const double base = without.series[meter].predicted[k];
                const double share = is_later ? after : before;
                return base + share * (with.series[meter].predicted[k] - base);
            };
            const double noise = stats::normal_quantile(random.uniform());
            text += fmt::format("{},{:.3f},{:.3f}\n",
                                physics::format_time(begins[k] + std::chrono::hours(1)),
                                of(0) + 0.7 * noise + (day < 0 ? 0 : added(day)),
                                of(1) + 0.2 * stats::normal_quantile(random.uniform()));
        }
        folder_.write("hall.csv", text);
    }

    void write_table(int n_days) const {
        folder_.write("stock.csv", fmt::format("name,meter,to\nhall,hall.csv,{}\n",
                                               physics::format_date(day_at(n_days - 1))));
    }
    Job job() const { return read_job(folder_ / "job.toml"); }

    StockRecord night(const StockRecord& before, int n_days) const {
        write_table(n_days);
        const Job job = this->job();
        std::vector<input::InputFile> log;
        return stock::work_through(job, job.stock->lines.at(0), &before, "same", log)
            .record;
    }

  private:
    Folder folder_;
};

double day_number(int day) {
    return stock::day_of(day_at(day));
}

TEST(NightEffects, ThatHoldAreTestedAndNotSoughtAgain) {
    const Hall hall;
    hall.make_readings(1, 1, 0);
    StockRecord record = Hall::first_night();
    for (int week = 1; week <= 4; ++week) {
        record = hall.night(record, n_known + 7 * week);
        EXPECT_EQ(record.told, "") << week;
        EXPECT_EQ(record.status, "tested");
        EXPECT_EQ(record.searches, 0);
        EXPECT_EQ(record.effects.at(0).state, "holds");
        EXPECT_EQ(record.tested_to, day_number(n_known + 7 * week));
    }
    EXPECT_EQ(record.simulations, 2);
    ASSERT_EQ(record.fits.size(), 2U);
    EXPECT_EQ(record.fits[1].period, "recent");
    EXPECT_EQ(record.fits[1].n, 28 * 24);
}

TEST(NightEffects, ThatEndAreToldWithTheirDayAndOnce) {
    const Hall hall;
    const int end = n_known + 5;
    hall.make_readings(1, 0, end);
    const StockRecord told = hall.night(Hall::first_night(), n_known + 14);
    EXPECT_EQ(told.effects.at(0).state, "ended");
    EXPECT_NEAR(told.effects[0].since, day_number(end), 3);
    EXPECT_EQ(told.told.find("ended: warmth of the hall, on 2021-08-"), 0U) << told.told;
    EXPECT_EQ(told.searches, 0);
    const StockRecord next = hall.night(told, n_known + 21);
    EXPECT_EQ(next.told, "");
    EXPECT_EQ(next.effects.at(0).state, "ended");
    EXPECT_EQ(next.changes.size(), 1U);
}

// What is left of one that has ended is followed, and not told to end again.
TEST(NightEffects, ThatLeaveALittleDoNotEndAgain) {
    const Hall hall;
    hall.make_readings(1, 0.24, n_known + 5);
    StockRecord record = Hall::first_night();
    record.effects[0].state = "ended";
    record.changes = {{of_night, day_number(n_known + 5), -1}};
    record = hall.night(record, n_known + 21);
    EXPECT_EQ(record.told.find("changed: warmth of the hall, from "), 0U) << record.told;
    EXPECT_EQ(record.told.find("; "), std::string::npos) << record.told;
    EXPECT_EQ(hall.night(record, n_known + 28).told, "");
}

TEST(NightEffects, ThatHalveHaveChanged) {
    const Hall hall;
    hall.make_readings(1, 0.5, n_known + 3);
    const StockRecord told = hall.night(Hall::first_night(), n_known + 14);
    EXPECT_EQ(told.effects.at(0).state, "changed") << told.told;
    ASSERT_EQ(told.changes.size(), 1U);
    EXPECT_NEAR(told.changes[0].size, -0.5, 0.15);
    EXPECT_EQ(told.searches, 0);
}

TEST(NightEffects, ThatBeginAreSoughtAndToldOnce) {
    const Hall hall;
    hall.make_readings(1, 1, n_known + 5, [](int) { return 4; });
    const StockRecord told = hall.night(Hall::first_night(), n_known + 14);
    EXPECT_EQ(told.searches, 1);
    EXPECT_EQ(told.told.find("new: electricity: "), 0U) << told.told;
    EXPECT_NE(told.told.find("since 2021-08-1"), std::string::npos) << told.told;
    const StockRecord next = hall.night(told, n_known + 21);
    EXPECT_EQ(next.told, "");
    EXPECT_EQ(next.searches, 0);
}

/// What the nights that follow the first tell, week by week; empty if nothing.
std::vector<std::string> told_in_weeks(const Hall& hall, int n_weeks) {
    std::vector<std::string> told;
    StockRecord record = Hall::first_night();
    for (int week = 2; week <= n_weeks; ++week) {
        record = hall.night(record, n_known + 7 * week);
        told.push_back(record.told);
    }
    return told;
}

TEST(NightEffects, WithoutANameAreToldOnceThoughTheyFadeWithTheSeason) {
    const Hall hall;
    hall.make_readings(1, 1, n_known + 5, [](int day) { return 4 - 3 * day / 80.0; });
    const auto told = told_in_weeks(hall, 12);
    EXPECT_EQ(told[0].find("new: electricity: "), 0U) << told[0];
    for (std::size_t k = 1; k < told.size(); ++k) EXPECT_EQ(told[k], "") << k;
}

TEST(NightEffects, WithoutANameAreToldToEnd) {
    const Hall hall;
    hall.make_readings(1, 1, n_known + 5, [](int day) { return day < 39 ? 4 : 0; });
    const auto told = told_in_weeks(hall, 8);
    EXPECT_EQ(told[0].find("new: electricity: "), 0U) << told[0];
    for (std::size_t k = 1; k + 2 < told.size(); ++k) EXPECT_EQ(told[k], "") << k;
    const std::string& end = told.back().empty() ? told[told.size() - 2] : told.back();
    EXPECT_EQ(end.find("ended: electricity: "), 0U) << end;
}

TEST(NightEffects, AreSoughtAnewWhereNoDayIsNewOrTheDescriptionIsAnother) {
    const Hall hall;
    hall.make_readings(1, 1, 0);
    StockRecord before = Hall::first_night();
    before.tested_to = day_number(n_known + 14);
    EXPECT_EQ(hall.night(before, n_known + 14).status, "calibrated");
    before = Hall::first_night();
    before.adopted_hash = "other";
    const StockRecord record = hall.night(before, n_known + 14);
    EXPECT_EQ(record.status, "calibrated");
    EXPECT_EQ(record.adopted_hash, "same");
    EXPECT_EQ(record.searches, 1);
}

}  // namespace
}  // namespace bemcal::job
