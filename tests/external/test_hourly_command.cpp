#include "external/command_simulator.hpp"
#include "external/effect_files.hpp"
#include "external/folder.hpp"

#include <gtest/gtest.h>

namespace bemcal::external {
namespace {

using study::GivenEffect;

/// A shell script that is to write hours.csv.
CommandOptions hourly(const Folder& folder, const std::string& text) {
    folder.write("run.sh", text);
    CommandOptions options;
    physics::Parameter parameter;
    parameter.name = "a";
    options.parameters = {parameter};
    OutputRule gas;
    gas.name = "gas";
    gas.file = "hours.csv";
    gas.column = "gas";
    gas.factor = 0.001;
    options.hours = {gas};
    options.links = {folder / "run.sh"};
    options.program = "/bin/sh";
    for (const char* word : {"sh", "run.sh", "@a@"})
        options.arguments.emplace_back(word, "job", std::vector<std::string>{"a"});
    options.time_limit_s = 20;
    options.folder = folder / "points";
    return options;
}

/// From 2021 on.
study::Period days_of(std::size_t n_hours) {
    const physics::Seconds from = physics::parse_time("2021-01-01");
    return {"training", from, from + std::chrono::hours(n_hours)};
}

study::SimulatedHours hours_of(const CommandOptions& options,
                               const std::vector<GivenEffect>& effects = {},
                               std::size_t n_hours = 2) {
    const std::vector<study::Period> periods{days_of(n_hours)};
    return make_hourly_simulator(options)->hours(std::vector{3.0}, effects, periods);
}

std::string without_folder(const std::string& failure) {
    return failure.substr(0, failure.find(" (in point-"));
}

/// An effect of two hours at three hooks.
std::vector<GivenEffect> some_effect() {
    return {{"a \"name\"",
             {{"infiltration", "1/h", false, "", "", {0.25, 0.5}},
              {"aperture", "-", true, "south facade", "", {-0.1, 0}},
              {"venting", "1/h", false, "", "", {2, 2}, 22.5}}}};
}

TEST(HourlyCommand, ReadsARowForEachHour) {
    const Folder folder;
    const auto simulated = hours_of(
        hourly(folder, "printf 'hour,gas\\n1,%s000\\n2,4000\\n' $1 > hours.csv"));
    EXPECT_EQ(simulated.failure, "");
    ASSERT_EQ(simulated.meters.size(), 1U);
    EXPECT_EQ(simulated.meters[0], (std::vector<double>{3, 4}));
    EXPECT_TRUE(simulated.left_out.empty());
}

TEST(HourlyCommand, SaysHowManyHoursAreExpected) {
    const Folder folder;
    const auto simulated =
        hours_of(hourly(folder, "printf 'gas\\n1\\n' > hours.csv"), {}, 8760);
    EXPECT_EQ(without_folder(simulated.failure),
              "no hours of gas: hours.csv: the column \"gas\" has 1 numbers; expected "
              "8760, one for each hour of the periods");
    EXPECT_TRUE(simulated.meters.empty());
}

TEST(HourlyCommand, WritesThePeriodsThatAreAskedFor) {
    const Folder folder;
    CommandOptions options = hourly(folder,
                                    "test \"`cat days.csv | tr '\\n' ' '`\" = "
                                    "'period,first,last training,2021-01-01,2021-01-02 '"
                                    " && (echo gas; seq 48) > hours.csv");
    EXPECT_FALSE(make_hourly_simulator(options)->takes_periods());
    options.periods_file = "days.csv";
    EXPECT_TRUE(make_hourly_simulator(options)->takes_periods());
    const auto simulated = hours_of(options, {}, 48);
    EXPECT_EQ(simulated.failure, "");
}

TEST(HourlyCommand, SaysWhyThereIsNothing) {
    const Folder folder;
    EXPECT_EQ(without_folder(hours_of(hourly(folder, "true")).failure),
              "no hours of gas: hours.csv: it has not been written");
    EXPECT_EQ(without_folder(
                  hours_of(hourly(folder, "printf 'heat\\n1\\n' > hours.csv")).failure),
              "no hours of gas: hours.csv: has no column \"gas\", but heat");
    EXPECT_EQ(without_folder(hours_of(hourly(folder, "echo severe >&2; exit 3")).failure),
              "exit code 3: severe");
    EXPECT_EQ(
        without_folder(
            hours_of(hourly(folder, "printf 'gas\\n1\\ninf\\n' > hours.csv")).failure),
        "no hours of gas: hours.csv: the column \"gas\" has inf, not a finite "
        "number");
}

TEST(HourlyCommand, EffectsAreHandedOverAsFiles) {
    const Folder folder;
    CommandOptions options =
        hourly(folder,
               "printf 'gas\\n1\\n2\\n' > hours.csv; cp effects.toml effects.csv ../..;"
               "echo 'aperture: no shades' > effects_left_out.txt");
    const auto simulated = hours_of(options, some_effect());
    EXPECT_EQ(simulated.failure, "");
    EXPECT_EQ(simulated.left_out, std::vector<std::string>{"aperture: no shades"});
    EXPECT_EQ(folder.text("effects.toml"),
              "[[effect]]\nname = \"a \\\"name\\\"\"\nhook = \"infiltration\"\nunit = "
              "\"1/h\"\nenters = \"add\"\ncolumn = \"effect_1\"\n\n"
              "[[effect]]\nname = \"a \\\"name\\\"\"\nhook = \"aperture\"\nunit = \"-\"\n"
              "enters = \"factor\"\nfacade = \"south facade\"\ncolumn = \"effect_2\"\n\n"
              "[[effect]]\nname = \"a \\\"name\\\"\"\nhook = \"venting\"\nunit = "
              "\"1/h\"\nenters = \"add\"\nopens_above = 22.5\ncolumn = \"effect_3\"\n\n");
    EXPECT_EQ(folder.text("effects.csv"),
              "effect_1,effect_2,effect_3\n0.25,-0.1,2\n0.5,0,2\n");
}

TEST(HourlyCommand, EffectsStandInPlacesOfTemplates) {
    const Folder folder;
    CommandOptions options = hourly(
        folder,
        "printf 'gas\\n1\\n2\\n' > hours.csv; cp air.dat ../..; ! test -e effects.toml");
    options.places = {{"air", "infiltration", "", ""},
                      {"shade", "aperture", "", ""},
                      {"south_shade", "aperture", "south facade", ""}};
    options.inputs.push_back(
        {"air.dat", TextTemplate("@air@;@shade@;@south_shade@", "air.dat.in",
                                 {"a", "air", "shade", "south_shade"})});
    std::vector<GivenEffect> effects = some_effect();
    effects.push_back({"another", {{"infiltration", "1/h", false, "", "", {1, -0.125}}}});
    const auto simulated = hours_of(options, effects);
    EXPECT_EQ(simulated.failure, "");
    EXPECT_EQ(folder.text("air.dat"), "1.25\n0.375;0\n0;-0.1\n0") << "they add up";
    EXPECT_EQ(simulated.left_out,
              std::vector<std::string>{"venting: no [[simulator.effect]] takes it"});
    hours_of(options);
    EXPECT_EQ(folder.text("air.dat"), "0\n0;0\n0;0\n0") << "without effects";
}

// A point whose files cannot be laid out leaves no more behind than one that fails later.
TEST(HourlyCommand, AFolderThatCannotBeFilledGoesAsOthersDo) {
    const Folder folder;
    CommandOptions options = hourly(folder, "true");
    options.links.push_back(options.links[0]);
    EXPECT_NE(hours_of(options).failure.find("run.sh cannot be linked: File exists (in "
                                             "point-"),
              std::string::npos);
    EXPECT_EQ(folder.n_files(), 2U);  // the script, and the points' folder
    options.keep = Keep::none;
    options.folder = folder / "others";
    EXPECT_EQ(hours_of(options).failure, "run.sh cannot be linked: File exists");
    EXPECT_EQ(folder.n_files(), 2U);
}

TEST(HourlyCommand, WithoutEffectsThereAreNoFiles) {
    const Folder folder;
    EXPECT_TRUE(files_of({}).empty());
    EXPECT_TRUE(files_of(std::vector<GivenEffect>{{"nothing it knows", {}}}).empty());
    const auto simulated = hours_of(
        hourly(folder, "test -e effects.toml || printf 'gas\\n1\\n2\\n' > hours.csv"));
    EXPECT_EQ(simulated.failure, "");
}

}  // namespace
}  // namespace bemcal::external
