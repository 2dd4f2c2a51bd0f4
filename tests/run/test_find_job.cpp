#include "run/find_job.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

TEST(JobFile, OfAFolderIsTheOneOfItsNameElseJobToml) {
    const test::TemporaryFolder folder;
    const auto office = folder.path() / "office";
    std::filesystem::create_directory(office);
    EXPECT_EQ(job_file(office), office / "office.toml");  // which the message then names
    std::ofstream(office / "job.toml") << "\n";
    EXPECT_EQ(job_file(office), office / "job.toml");
    std::ofstream(office / "office.toml") << "\n";
    EXPECT_EQ(job_file(office), office / "office.toml");
}

TEST(Script, IsNeverTakenFromAFolderAboveTheProgramOrTheWorkingFolder) {
    const test::TemporaryFolder folder;
    const auto above = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    for (const auto& place : {above, std::filesystem::path("."), folder.path()}) {
        const auto script = place / "scripts_of_a_test";
        std::ofstream(script) << "\n";
        EXPECT_FALSE(find_script("scripts_of_a_test", {}));
        std::filesystem::remove(script);
    }
    folder.write("one", "");
    EXPECT_EQ(find_script("one", {"/nowhere", folder.path()}), folder / "one");
}

}  // namespace
}  // namespace bemcal::run
