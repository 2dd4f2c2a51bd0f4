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

}  // namespace
}  // namespace bemcal::run
