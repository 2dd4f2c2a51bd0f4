/// Nights of a stock whose study is a posterior or a loop: what the first finds, and that
/// the next one does what has changed, from there.
#include "job/small_office.hpp"
#include "job/stock.hpp"
#include "stats/metrics.hpp"
#include "stock/calibration.hpp"
#include "stock/look.hpp"
#include "stock/record.hpp"
#include "stock/stage.hpp"
#include "study/fit_model.hpp"
#include "study/points.hpp"
#include "study/small_case.hpp"
#include "support/stage_answers.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr const char* posterior_study =
    "kind = \"posterior\"\nn_chains = 2\nwarm_up = 20\ndraws_per_round = 20\n"
    "most_draws = 20\nn_predictive = 10\nautocorrelated = false\n";
constexpr const char* loop_study =
    "kind = \"loop\"\nmost_effects = 1\ntry_structures = false\n";

/// Two small offices with a meter of their own each, and one whose file is missing.
class Stock3 {
  public:
    explicit Stock3(const std::string& study) {
        folder_.write("weather.csv", small_weather());
        folder_.write("one.csv", small_readings());
        folder_.write("two.csv", small_readings());
        folder_.write("building.toml", small_stock_building());
        folder_.write("stock.csv",
                      "name,meter\none,one.csv\ntwo,two.csv\nthree,three.csv\n");
        folder_.write(
            "job.toml",
            "seed = 3\n[stock]\nfalse_alarms = 0.001\ntable = \"stock.csv\"\ntemplate = "
            "\"building.toml\"\n[[study]]\n" +
                study);
    }

    /// Of the second building, the last day is missing from now on.
    void change_second() const { folder_.write("two.csv", small_readings(24 * 58)); }
    void break_second() const { folder_.write("two.csv", "time,elec_kWh,T_air_C\n"); }
    void mend_second() const { folder_.write("two.csv", small_readings()); }
    void write_second_anew(const std::string& when) const {
        folder_.write("two.csv", "# written " + when + "\n" + small_readings());
    }
    void add_third() const { folder_.write("three.csv", small_readings()); }
    /// Its numbers of electricity are Wh from now on.
    void misread_second() const {
        std::string text = "time,elec_kWh,T_air_C\n";
        for (int k = 0; k < 24 * 59; ++k)
            text += fmt::format("{},{},{:.1f}\n",
                                physics::format_time(physics::parse_time("2021-01-01") +
                                                     std::chrono::hours(k + 1)),
                                12000 + k % 24, 20 + 0.1 * (k % 24));
        folder_.write("two.csv", text);
    }
    Job job() const { return read_job(folder_ / "job.toml"); }

  private:
    Folder folder_;
};

using test::answers_of;

std::vector<stock::StockRecord> night(const Stock3& stock,
                                      std::vector<stock::StockRecord> before) {
    const Job job = stock.job();
    const auto stage = stock::make_stock_stage(job, {"1", std::move(before)});
    const auto answers = answers_of(*stage);
    return stock::records_in(stage->conclude(answers).datasets);
}

void expect_sound(const stock::StockRecord& record,
                  const std::string& status = "calibrated") {
    EXPECT_EQ(record.status, status) << record.reason;
    ASSERT_EQ(record.values.size(), 3U);
    for (const stock::StockRecord::Value& value : record.values) {
        EXPECT_LT(value.low, value.value) << value.name;
        EXPECT_GT(value.high, value.value) << value.name;
    }
    ASSERT_FALSE(record.fits.empty());
    for (const stock::StockRecord::Fit& fit : record.fits)
        EXPECT_TRUE(fit.n > 0 && std::isfinite(fit.before) && std::isfinite(fit.cv_rmse))
            << fit.meter << " in " << fit.period;
}

/// Of two nights. \param again  status of the one that has changed
void expect_only_changes_done(const Stock3& stock, const std::string& again) {
    const auto first = night(stock, {});
    ASSERT_EQ(first.size(), 3U);
    for (std::size_t k = 0; k < 2; ++k) expect_sound(first[k]);
    EXPECT_EQ(first[0].cause, "new");
    EXPECT_EQ(first[2].status, "failed");
    EXPECT_NE(first[2].reason.find("three.csv"), std::string::npos) << first[2].reason;

    stock.change_second();
    const auto second = night(stock, first);
    ASSERT_EQ(second.size(), 3U);
    EXPECT_EQ(second[0].status, "unchanged");
    EXPECT_EQ(second[0].values[0].value, first[0].values[0].value);
    EXPECT_EQ(second[1].cause, "data: two.csv");
    expect_sound(second[1], again);
    EXPECT_LT(second[1].fits.back().n, first[1].fits.back().n);
    EXPECT_EQ(second[2].status, "failed");
    EXPECT_EQ(second[2].cause, "");
    EXPECT_EQ(second[1].files.size(), first[1].files.size());

    const auto third = night(stock, second);
    EXPECT_EQ(third[1].status, "unchanged");
    EXPECT_EQ(third[1].cause, "");
}

TEST(StockNight, OfPosteriorsDoesWhatHasChanged) {
    expect_only_changes_done(Stock3(posterior_study), "calibrated");
}

TEST(StockNight, OfLoopsDoesWhatHasChanged) {
    expect_only_changes_done(Stock3(loop_study), "tested");
}

// What was known of a building is known behind a night that failed.
TEST(StockNight, GoesOnBehindOneThatFailed) {
    const Stock3 stock(loop_study);
    const auto first = night(stock, {});
    stock.break_second();
    const auto failed = night(stock, first);
    EXPECT_EQ(failed[1].status, "failed");
    EXPECT_EQ(failed[1].adopted, first[1].adopted);
    EXPECT_EQ(failed[1].effects.size(), first[1].effects.size());
    stock.mend_second();
    const auto mended = night(stock, failed);
    EXPECT_EQ(mended[1].cause, "data: two.csv");
    EXPECT_EQ(mended[1].status, "calibrated");  // whatever has kept it
    EXPECT_EQ(mended[1].told, "");
    EXPECT_EQ(mended[1].reason, "");
}

// A file that was written anew, with the same readings, is nothing to work on.
TEST(StockNight, OfTheSameReadingsInAnotherFileHasNothingToDo) {
    const Stock3 stock(loop_study);
    const auto first = night(stock, {});
    stock.write_second_anew("today");
    const auto second = night(stock, first);  // tests the days behind training
    EXPECT_EQ(second[1].status, "tested");
    stock.write_second_anew("tomorrow");
    const auto third = night(stock, second);
    EXPECT_EQ(third[1].cause, "data: two.csv");
    EXPECT_EQ(third[1].status, "unchanged");
    EXPECT_EQ(third[1].tested_to, second[1].tested_to);
    EXPECT_EQ(night(stock, third)[1].cause, "");
}

/// Whether a finding says so.
bool says(const stock::StockRecord& record, const std::string& words) {
    return std::ranges::any_of(record.findings, [&](const study::DataDecision& found) {
        return found.finding.find(words) != std::string::npos;
    });
}

std::vector<double> heating_at(const study::Case& building,
                               const std::vector<double>& values) {
    const physics::Drive drive = study::drive_of(building, building.periods[0]);
    const study::FitModel model(
        building.building, building.parameters, drive,
        {{physics::Quantity::heating, physics::Interval::hourly}});
    Matrix point(1, values.size());
    point.values = values;
    return model.predict(point).values;
}

// What a parameter means is of the description, in every night.
TEST(StockNight, StartsFromTheModelThatTheLastOneLeft) {
    study::Case building = test::small_case();
    building.parameters[0].effect = physics::Effect::factor;
    building.parameters[0].nominal = 1;
    building.parameters[2].effect = physics::Effect::offset;
    building.parameters[2].nominal = 0;
    const std::vector<double> left = {1.4, 0.6, -1.5}, other = {0.7, 0.4, 0.5};
    const auto as_left = heating_at(building, left),
               as_other = heating_at(building, other);
    std::map<std::string, double> values;
    for (std::size_t k = 0; k < left.size(); ++k)
        values[building.parameters[k].name] = left[k];
    stock::start_from(values, building);
    const auto nominal =
                   heating_at(building, study::nominal_row(building.parameters).values),
               elsewhere = heating_at(building, other);
    for (std::size_t h = 0; h < nominal.size(); ++h) {
        EXPECT_NEAR(nominal[h], as_left[h], 1e-9) << h;
        EXPECT_NEAR(elsewhere[h], as_other[h], 1e-9) << h;
    }
}

// Errors of training are those that the loop ended with.
TEST(StockNight, TestsTheModelThatTheLoopFound) {
    const Stock3 stock(std::string(loop_study) + "functions = false\n");
    const Job job = stock.job();
    const stock::StockRecord found = night(stock, {}).at(0);
    std::vector<input::InputFile> log;
    const study::Case adopted = stock::adopted_building(
        job, job.stock->lines.at(0), found, stock::known_of(found), log);
    const bool has_factor = std::ranges::any_of(adopted.parameters, [](const auto& each) {
        return each.effect == physics::Effect::factor &&
               std::abs(each.nominal - 1) > 0.01;
    });
    EXPECT_TRUE(has_factor);
    const stock::DaySums sums = stock::day_sums(adopted);
    const auto n = static_cast<std::size_t>(study::hours_of(adopted.periods[0]));
    for (const stock::StockRecord::Fit& fit : found.fits) {
        if (fit.period != found.fits[0].period) continue;
        const auto meter =
            std::ranges::find(adopted.meters, fit.meter, &study::Meter::name);
        ASSERT_NE(meter, adopted.meters.end());
        const auto& series =
            sums.series[static_cast<std::size_t>(meter - adopted.meters.begin())];
        const auto errors = stats::metrics_of(std::span(series.predicted).first(n),
                                              std::span(series.measured).first(n));
        EXPECT_NEAR(errors.cv_rmse, fit.cv_rmse, 1e-9) << fit.meter;
    }
}

TEST(StockNight, TellsOfAMeterBeyondTheModelAndGoesOn) {
    const Stock3 stock("kind = \"screening\"\nn_points = 4\n");
    stock.misread_second();
    const Job job = stock.job();
    const auto stage = stock::make_stock_stage(job, {"1", {}});
    const auto answers = answers_of(*stage);
    const auto records = stock::records_in(stage->conclude(answers).datasets);
    EXPECT_EQ(records.at(1).status, "calibrated") << records[1].reason;
    EXPECT_TRUE(says(records[1], "the most that the model reaches"));
    EXPECT_TRUE(stage->shortfall(answers).empty());
    for (const study::Summary& found : stage->conclude(answers).summaries)
        EXPECT_EQ(found.shortfall, "");
}

TEST(StockNight, FindsAnAnswerOutdatedWhoseFileHasChangedOrCome) {
    const Stock3 stock("kind = \"screening\"\nn_points = 4\n");
    const Job job = stock.job();
    const auto answers = answers_of(*stock::make_stock_stage(job, {"1", {}}));
    ASSERT_EQ(answers.size(), 4U);  // the look at all, then a building each
    const auto outdated = [&] {
        const Job now = stock.job();
        const auto stage = stock::make_stock_stage(now, {"1", {}});
        std::string all;
        for (int item = 0; item < 4; ++item)
            all += stage->outdated(item, answers[static_cast<std::size_t>(item)]) + ";";
        return all;
    };
    EXPECT_EQ(outdated(), ";;;;");
    stock.change_second();
    EXPECT_EQ(outdated(), ";;two: two.csv has changed since;;");
    stock.add_third();
    EXPECT_EQ(outdated(),
              ";;two: two.csv has changed since;three: three.csv has changed since;");
}

}  // namespace
}  // namespace bemcal::job
