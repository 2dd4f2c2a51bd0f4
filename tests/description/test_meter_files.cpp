/// [[meter]]: readings in several files, and meters without any.
#include "job/small_office.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

constexpr const char* file_key = "file = \"measured.csv\"\ncolumn = \"elec_kWh\"\n";

/// The head of the sample's readings and rows [from, to).
std::string rows(std::size_t from, std::size_t to) {
    std::istringstream lines(small_readings());
    std::string line, text;
    for (std::size_t k = 0; std::getline(lines, line); ++k)
        if (k == 0 || (k > from && k <= to)) text += line + "\n";
    return text;
}

std::string with_files(const std::string& files) {
    return replaced(small_office_text(), file_key,
                    "file = " + files + "\ncolumn = \"elec_kWh\"\n");
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, [](double x, double y) {
        return x == y || (std::isnan(x) && std::isnan(y));
    });
}

TEST(MeterFiles, TwoFilesAreReadAsTheOneTheyWereCutFrom) {
    const Folder folder;
    const Job whole = read_job(write_small_office(folder));
    folder.write("a.csv", rows(0, 700));
    folder.write("b.csv", rows(700, 2000));
    const Job cut =
        read_job(write_small_office(folder, with_files("[\"a.csv\", \"b.csv\"]")));
    const study::Meter &one = whole.buildings[0].meters[0],
                       &two = cut.buildings[0].meters[0];
    EXPECT_EQ(one.axis.start, two.axis.start);
    EXPECT_TRUE(same(one.values, two.values));
}

TEST(MeterFiles, WhatLiesBetweenTwoFilesIsMissing) {
    const Folder folder;
    folder.write("a.csv", rows(0, 700));
    folder.write("b.csv", rows(705, 2000));
    const Job job =
        read_job(write_small_office(folder, with_files("[\"a.csv\", \"b.csv\"]")));
    const std::vector<double>& values = job.buildings[0].meters[0].values;
    EXPECT_EQ(values.size(), 24 * 59);
    EXPECT_FALSE(std::isnan(values[699]));
    EXPECT_TRUE(std::all_of(values.begin() + 700, values.begin() + 705,
                            [](double v) { return std::isnan(v); }));
    EXPECT_FALSE(std::isnan(values[705]));
}

bool has_decision(const Job& job, const std::string& finding) {
    return std::ranges::any_of(job.buildings[0].decisions, [&](const auto& decision) {
        return decision.finding.find(finding) != std::string::npos;
    });
}

TEST(MeterFiles, RowsOfTwoFilesAreTakenOnceWhereTheyAreAlike) {
    const Folder folder;
    const Job whole = read_job(write_small_office(folder));
    folder.write("a.csv", rows(0, 700));
    folder.write("b.csv", rows(650, 2000));
    const Job job =
        read_job(write_small_office(folder, with_files("[\"a.csv\", \"b.csv\"]")));
    EXPECT_TRUE(
        same(job.buildings[0].meters[0].values, whole.buildings[0].meters[0].values));
    EXPECT_TRUE(
        has_decision(job, "b.csv: 50 readings that the files before it have, too"));
}

TEST(MeterFiles, WhatTheirStampsShowAlikeIsSaidOnce) {
    const Folder folder;
    for (const int year : {2021, 2022}) {
        std::string text = "time,elec_kWh\n";
        for (int hour = 1; hour <= 24 * 30; ++hour)  // the last one is at midnight
            text += fmt::format("{}-01-{:02}T{:02}:00:00,{}\n", year, hour / 24 + 1,
                                hour % 24, 5 + hour % 24);
        folder.write(fmt::format("{}.csv", year), text);
    }
    const std::string said = with_files("[\"2021.csv\", \"2022.csv\"]");
    const Job job =
        read_job(write_small_office(folder, replaced(said, "stamp = \"end\"\n", "")));
    EXPECT_EQ(
        std::ranges::count_if(job.buildings[0].decisions,
                              [](const auto& decision) {
                                  return decision.finding.find("they close whole days") !=
                                         std::string::npos;
                              }),
        1);
}

TEST(MeterFiles, AFileWithinAnotherAddsNothing) {
    const Folder folder;
    const Job whole = read_job(write_small_office(folder));
    folder.write("a.csv", rows(0, 2000));
    folder.write("b.csv", rows(650, 660));
    const Job job =
        read_job(write_small_office(folder, with_files("[\"a.csv\", \"b.csv\"]")));
    EXPECT_TRUE(
        same(job.buildings[0].meters[0].values, whole.buildings[0].meters[0].values));
}

TEST(MeterFiles, AReadingThatOneFileLacksIsTakenFromTheOther) {
    const Folder folder;
    const Job whole = read_job(write_small_office(folder));
    const std::string line_700 = rows(699, 700).substr(rows(0, 0).size());
    folder.write("a.csv",
                 replaced(rows(0, 700), line_700, line_700.substr(0, 20) + ",\n"));
    folder.write("b.csv", rows(650, 2000));
    const Job job =
        read_job(write_small_office(folder, with_files("[\"a.csv\", \"b.csv\"]")));
    EXPECT_TRUE(
        same(job.buildings[0].meters[0].values, whole.buildings[0].meters[0].values));
    EXPECT_TRUE(has_decision(job, "b.csv: 49 readings"));
}

TEST(MeterFiles, RowsOfTwoFilesThatDifferAreRefusedWithBothPlaces) {
    const Folder folder;
    folder.write("a.csv", rows(0, 700));
    const std::string line_700 = rows(699, 700).substr(rows(0, 0).size());
    folder.write("b.csv",
                 replaced(rows(650, 2000), line_700, line_700.substr(0, 20) + "99,20\n"));
    ExitCode exit_code = ExitCode::usage;
    const std::string message = message_of(
        write_small_office(folder, with_files("[\"a.csv\", \"b.csv\"]")), &exit_code);
    EXPECT_NE(message.find("b.csv:51: 99 here, but "), std::string::npos) << message;
    EXPECT_NE(
        message.find("a.csv:701, for the same time (2021-01-30 03:00:00); leave one "
                     "of them out"),
        std::string::npos)
        << message;
    EXPECT_EQ(exit_code, ExitCode::data);
}

TEST(MeterFiles, FilesInTheWrongOrderAreRefusedByName) {
    const Folder folder;
    folder.write("a.csv", rows(0, 700));
    folder.write("b.csv", rows(699, 2000));
    const std::string message =
        message_of(write_small_office(folder, with_files("[\"b.csv\", \"a.csv\"]")));
    EXPECT_NE(message.find("a.csv: begins at 2021-01-01 00:00:00, before the end of the "
                           "file before it"),
              std::string::npos)
        << message;
}

TEST(MeterFiles, AMeterWithoutAFileIsPredictedOnly) {
    const Folder folder;
    std::string text = replaced(small_office_text(), file_key, "");
    text = replaced(text, "unit = \"kWh\"\nstamp = \"end\"\nmask", "unit = \"kWh\"\n#");
    const Job job = read_job(write_small_office(folder, text));
    const study::Meter& meter = job.buildings[0].meters[0];
    EXPECT_EQ(meter.axis.start, job.buildings[0].periods[0].from);
    EXPECT_FALSE(meter.values.empty());
    EXPECT_TRUE(
        std::ranges::all_of(meter.values, [](double v) { return std::isnan(v); }));
}

TEST(MeterFiles, AHeldOutPeriodMayBeWithoutReadings) {
    const Folder folder;
    const std::string text =
        replaced(small_office_text(), "mask = [\"2021-01-20/2021-01-21\"]",
                 "mask = [\"2021-02-01/2021-02-28\"]");
    const Job job = read_job(write_small_office(folder, text));
    EXPECT_TRUE(std::ranges::any_of(job.buildings[0].decisions, [](const auto& decision) {
        return decision.finding == "no reading in the period held_out" &&
               decision.action == "predicted only there";
    }));
}

TEST(MeterFiles, AFileNeedsItsColumn) {
    const Folder folder;
    const std::string text =
        replaced(small_office_text(), file_key, "file = \"measured.csv\"\n");
    EXPECT_NE(message_of(write_small_office(folder, text)).find("column"),
              std::string::npos);
}

}  // namespace
}  // namespace bemcal::job
