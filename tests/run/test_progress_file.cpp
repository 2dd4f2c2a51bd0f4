#include "base/disk.hpp"
#include "run/part_files.hpp"
#include "run/progress_file.hpp"
#include "support/temporary_folder.hpp"

#include <optional>

#include <gtest/gtest.h>

namespace bemcal::run {
namespace {

class ProgressOnDisk : public ::testing::Test {
  protected:
    std::filesystem::path folder() const { return folder_.path(); }
    std::filesystem::path file() const { return folder_ / progress_name; }
    test::TemporaryFolder folder_;
};

TEST_F(ProgressOnDisk, IsTheLastLineUntilTheRunEnds) {
    EXPECT_EQ(read_progress(folder()), "");
    {
        ProgressFile progress(folder());
        EXPECT_EQ(read_progress(folder()), "") << "nothing was told yet";
        progress.write("office/posterior: a long line, 0:17 left");
        progress.write("office/posterior: short");
        EXPECT_EQ(read_progress(folder()), "office/posterior: short");
        progress.write(std::string(9000, 'x'));
        EXPECT_EQ(std::filesystem::file_size(file()), 512U);
        EXPECT_EQ(read_progress(folder()).find_first_not_of('x'), std::string::npos);
        progress.write("two\nlines");
        EXPECT_EQ(read_progress(folder()), "two\\nlines");
    }
    EXPECT_FALSE(is_taken(file()));
}

TEST_F(ProgressOnDisk, HalfOfTwoLinesIsNone) {
    ProgressFile progress(folder());
    progress.write("office/posterior: 3 of 8 items");
    std::string text = read_regular(file());
    text[text.find('3')] = '4';
    text[text.find("of 8")] = 'O';
    folder_.write(progress_name, text);
    EXPECT_EQ(read_progress(folder()), "");
    folder_.write(progress_name, text.substr(0, 100));
    EXPECT_EQ(read_progress(folder()), "");
}

TEST_F(ProgressOnDisk, OfAKilledRunIsARunsAndMakesPlace) {
    std::string left;
    {
        ProgressFile progress(folder());
        progress.write("killed");
        left = read_regular(file());
    }
    folder_.write(progress_name, left);
    EXPECT_EQ(part_files(folder()).ours.size(), 1U);
    ProgressFile progress(folder());
    progress.write("resumed");
    EXPECT_EQ(read_progress(folder()), "resumed");
}

/// The machine may end a run between the file and its first line.
TEST_F(ProgressOnDisk, OfARunThatEndedBeforeItsFirstLineIsARuns) {
    folder_.write(progress_name, "");
    EXPECT_EQ(part_files(folder()).ours.size(), 1U);
    EXPECT_TRUE(part_files(folder()).foreign.empty());
    ProgressFile progress(folder());
    progress.write("begun");
    EXPECT_EQ(read_progress(folder()), "begun");
}

TEST_F(ProgressOnDisk, LeavesALinkToAnEmptyFile) {
    folder_.write("elsewhere", "");
    std::filesystem::create_symlink("elsewhere", file());
    EXPECT_FALSE(is_progress_file(file()));
}

TEST_F(ProgressOnDisk, LeavesAFileThatNoRunMade) {
    folder_.write(progress_name, "my notes\n");
    EXPECT_EQ(part_files(folder()).foreign.size(), 1U);
    {
        ProgressFile progress(folder());
        progress.write("a run");
    }
    EXPECT_EQ(read_regular(file()), "my notes\n");
}

}  // namespace
}  // namespace bemcal::run
