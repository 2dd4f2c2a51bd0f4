/// Studies of kind "loop": what the keys become, and what is refused.
#include "job/kind.hpp"
#include "job/small_office.hpp"
#include "job/stages.hpp"
#include "loop/options.hpp"
#include "plan/plan.hpp"

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

using Texts = std::vector<std::string>;

constexpr const char* screening_study =
    "kind = \"screening\"\nn_points = 256\npoints_per_item = 64";
constexpr const char* rain_series =
    "[[series]]\nname = \"rain\"\nfile = \"rain.csv\"\ncolumn = \"mm\"\nunit = "
    "\"mm/h\"\n\n"
    "[[study]]\n";

/// The sample job with a loop as its last study, and a series that nothing else reads.
std::string text_with(const std::string& keys) {
    const std::string text =
        replaced(small_office_text(), screening_study, "kind = \"loop\"\n" + keys);
    return replaced(text, "[[study]]\n", rain_series);
}

std::filesystem::path write_job(const Folder& folder, const std::string& keys) {
    std::string rain = "time,mm\n";
    const physics::Seconds start = physics::parse_time("2021-01-01");
    for (int k = 0; k < 24 * 59; ++k)
        rain += fmt::format("{},{}\n",
                            physics::format_time(start + std::chrono::hours(k)), k % 3);
    folder.write("rain.csv", rain);
    return write_small_office(folder, text_with(keys));
}

TEST(LoopStudy, TakesEveryKey) {
    const Folder folder;
    const Job job = read_job(write_job(
        folder,
        "period = \"training\"\nparameters = [\"infiltration\"]\nmeters = [\"air\"]\n"
        "most_effects = 2\ntry_structures = false\nblock_days = 7\nleast_gain = 3\n"
        "most_loss = 0.5\nalpha = 0.05\nexclude = [\"wind infiltration\"]\n"
        "generic = false\ncolumns = [\"rain\"]"));
    ASSERT_STREQ(job.studies[1].kind->word, "loop");
    const auto& options = job.studies[1].as<loop::LoopOptions>();
    EXPECT_EQ(options.period, "training");
    EXPECT_EQ(options.parameters, Texts{"infiltration"});
    EXPECT_EQ(options.meters, Texts{"air"});
    EXPECT_EQ(options.most_effects, 2);
    EXPECT_FALSE(options.try_structures);
    EXPECT_EQ(options.block_days, 7);
    EXPECT_EQ(options.least_gain, 3);
    EXPECT_EQ(options.most_loss, 0.5);
    EXPECT_EQ(options.alpha, 0.05);
    EXPECT_EQ(options.seed, job.seed);
    EXPECT_EQ(options.exclude, Texts{"wind infiltration"});
    EXPECT_FALSE(options.generic);
    EXPECT_EQ(options.columns, Texts{"rain"});
    ASSERT_EQ(job.buildings[0].columns.size(), 1U);
    EXPECT_EQ(job.buildings[0].columns[0].name, "rain");
    EXPECT_EQ(job.buildings[0].columns[0].unit, "mm/h");
}

TEST(LoopStudy, HasTheDefaultsOfItsOptions) {
    const Folder folder;
    const auto read = read_job(write_job(folder, "")).studies[1].as<loop::LoopOptions>();
    const loop::LoopOptions plain;
    EXPECT_EQ(read.period, "");
    EXPECT_EQ(read.most_effects, plain.most_effects);
    EXPECT_EQ(read.try_structures, plain.try_structures);
    EXPECT_EQ(read.block_days, plain.block_days);
    EXPECT_EQ(read.least_gain, plain.least_gain);
    EXPECT_EQ(read.most_loss, plain.most_loss);
    EXPECT_EQ(read.alpha, plain.alpha);
    EXPECT_EQ(read.generic, plain.generic);
    EXPECT_TRUE(read.parameters.empty() && read.meters.empty() && read.exclude.empty() &&
                read.columns.empty());
}

TEST(LoopStudy, RefusesWhatTheBuildingDoesNotHave) {
    const Folder folder;
    const auto message = [&](const std::string& keys) {
        return message_of(write_job(folder, keys));
    };
    EXPECT_NE(message("columns = [\"rian\"]").find("did you mean \"rain\"?"),
              std::string::npos)
        << message("columns = [\"rian\"]");
    EXPECT_NE(message("parameters = [\"infiltraton\"]").find("\"infiltration\"?"),
              std::string::npos);
    EXPECT_NE(message("meters = [\"water\"]").find("no meter of"), std::string::npos);
    EXPECT_NE(message("period = \"later\"").find("no such period"), std::string::npos);
    EXPECT_NE(message("block_days = 1").find("2 to 90 d"), std::string::npos);
    EXPECT_NE(message("exclude = [\"wind infiltratoin\"]").find("\"wind infiltration\"?"),
              std::string::npos)
        << message("exclude = [\"wind infiltratoin\"]");
    EXPECT_EQ(message("exclude = [\"gains: wind, at night\"]"), "");
    EXPECT_NE(message("n_points = 5").find("n_points"), std::string::npos);
}

TEST(LoopStudy, IsAStageOfItsNameAndSaysWhatItWillDo) {
    const Folder folder;
    const Job job = read_job(write_job(folder, "columns = [\"rain\"]\nmost_effects = 3"));
    EXPECT_TRUE(make_plan(job).back()->name().ends_with("loop"));
    const std::string text = plan::plan_text(job, 2);
    EXPECT_NE(text.find("at most 3 effects of the catalogue and beside it, which may "
                        "follow rain"),
              std::string::npos)
        << text;
}

// In any kind of study the building has the usual hours, and the plan says so.
TEST(LoopStudy, HoursThatNobodyWroteDownAreTheUsualOnesUntilALoopLearnsOthers) {
    const Folder folder;
    const std::string given =
        "weekdays = [0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, "
        "0]\nsaturday = 0\nsunday = 0";
    const Job job = read_job(write_small_office(
        folder,
        replaced(small_office_text(), given, "hours = \"learn\"\nuse = \"shop\"")));
    const study::Case& building = job.buildings[0];
    ASSERT_EQ(building.unknown_hours.size(), 1U);
    EXPECT_EQ(building.unknown_hours[0].profile, 1U);
    EXPECT_EQ(physics::hours_of(building.profiles[1].schedule),
              physics::usual_hours("shop"));
    const std::string text = plan::plan_text(job, 2);
    EXPECT_NE(text.find("data, schedule plant: its hours are not given: those that are "
                        "usual for its use (shop): Monday to Friday 8 to 20 h, Saturdays "
                        "8 to 20 h, Sundays and holidays off; a study of kind \"loop\" "
                        "learns them"),
              std::string::npos)
        << text;
}

}  // namespace
}  // namespace bemcal::job
