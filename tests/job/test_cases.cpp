/// scripts/case_to_job and scripts/run_case: every case at hand becomes a job that is
/// read without a complaint.
#include "job/small_office.hpp"
#include "plan/plan.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

int run_script(const std::filesystem::path& from, const std::filesystem::path& to) {
    const std::string command = std::string(BEMCAL_ROOT "/scripts/case_to_job ") +
                                from.string() + " " + to.string() + " > /dev/null";
    return std::system(command.c_str());
}

TEST(CaseToJob, EveryCaseBecomesAJobThatIsRead) {
    const std::filesystem::path cases = BEMCAL_ROOT "/../shared/cases";
    if (!std::filesystem::exists(cases)) GTEST_SKIP() << cases << " is not here";
    const Folder folder;
    for (const char* group : {"dev", "guangdong_offices"}) {
        for (const auto& entry : std::filesystem::directory_iterator(cases / group)) {
            if (!exists(entry.path() / "measured.csv")) continue;  // kept back
            const auto target = folder / entry.path().filename().string();
            ASSERT_EQ(run_script(entry.path(), target), 0) << entry.path();
            EXPECT_EQ(message_of(target / "job.toml"), "") << entry.path();
        }
    }
}

TEST(RunCase, AllCasesBecomeOneLoopThatIsRead) {
    const std::filesystem::path cases = BEMCAL_ROOT "/../shared/cases/dev";
    if (!std::filesystem::exists(cases)) GTEST_SKIP() << cases << " is not here";
    const Folder folder;
    std::string command = BEMCAL_ROOT "/scripts/run_case";
    for (const auto& entry : std::filesystem::directory_iterator(cases))
        command += " " + entry.path().string();
    command += " " + folder.path().string() + " --job-only > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const Job job = read_job(folder / "job" / "job.toml");
    EXPECT_EQ(job.buildings.size(), 10u);
    for (const study::Case& building : job.buildings) {
        ASSERT_EQ(building.periods.size(), 2u);
        EXPECT_EQ(building.parameters.size(), building.priors.size());
    }
}

TEST(CaseToJob, NothingIsOverwritten) {
    const Folder folder;
    folder.write("job.toml", "mine");
    EXPECT_NE(run_script(BEMCAL_ROOT "/../shared/cases/dev/dev_01", folder.path()), 0);
    EXPECT_EQ(text_of(folder / "job.toml"), "mine");
}

}  // namespace
}  // namespace bemcal::job
