/// scripts/case_to_job: every case at hand becomes a job that is read without a
/// complaint.
#include "job/plan.hpp"
#include "job/small_office.hpp"

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

TEST(CaseToJob, NothingIsOverwritten) {
    const Folder folder;
    folder.write("job.toml", "mine");
    EXPECT_NE(run_script(BEMCAL_ROOT "/../shared/cases/dev/dev_01", folder.path()), 0);
    EXPECT_EQ(text_of(folder / "job.toml"), "mine");
}

}  // namespace
}  // namespace bemcal::job
