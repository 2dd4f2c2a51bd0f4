#include "base/error.hpp"
#include "job/stock.hpp"
#include "run/output_names.hpp"
#include "run/part_folder.hpp"
#include "stock/record.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

class OutputNames : public ::testing::Test {
  protected:
    OutputNames() {
        write("office.toml", "job");
        write("meter.csv", "time,gas");
        job_.name = "office";
        job_.file = folder_ / "office.toml";
        job_.inputs = {{job_.file, "1"}, {folder_ / "meter.csv", "2"}};
    }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }
    /// As if the working folder were the job's.
    std::string chosen(const std::string& named) const {
        return choose_output(job_, {folder_ / named}).result.filename().string();
    }
    std::string table(const std::string& named) const {
        return choose_output(job_, {folder_ / named}).table.filename().string();
    }
    std::string history(const std::string& named) const {
        return choose_output(job_, {folder_ / named}).history.filename().string();
    }
    std::string refusal(const std::string& named) const {
        try {
            choose_output(job_, {folder_ / named});
        } catch (const UserError& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::cannot_create);
            return error.what();
        }
        return {};
    }
    void expect_refused(const std::string& named, const std::string& words) const {
        EXPECT_NE(refusal(named).find(words), std::string::npos) << refusal(named);
    }
    /// The table itself is the job, and names a meter's file.
    void make_stock() {
        write("stock.csv", "name,gas\none,readings.csv\n");
        auto stock = std::make_shared<job::Stock>();
        stock->table = folder_ / "stock.csv";
        stock->lines.resize(1);
        stock->lines[0].cells = {"one", "readings.csv"};
        job_.stock = stock;
        job_.name = "stock";
        job_.file = stock->table;
        job_.inputs = {{stock->table, "1"}};
    }

    test::TemporaryFolder folder_;
    job::Job job_;
};

TEST_F(OutputNames, AResultNeverTakesTheNameOfAnInput) {
    EXPECT_EQ(chosen("a.h5"), "a.h5");
    expect_refused("meter.csv", "is an input of this job");
    expect_refused("office.toml", "choose another name, like -o");
}

TEST_F(OutputNames, NorThroughLinks) {
    fs::create_symlink("meter.csv", folder_ / "soft.h5");
    fs::create_hard_link(folder_ / "meter.csv", folder_ / "hard.h5");
    fs::create_directory_symlink(folder_.path(), folder_ / "again");
    for (const char* name : {"soft.h5", "hard.h5", "again/meter.csv", "x/../meter.csv"})
        expect_refused(name, "is an input of this job");
}

TEST_F(OutputNames, AnInputInTheFolderOfTheUnfinishedRunIsRefused) {
    job_.inputs.push_back({part_folder_of(folder_ / "a.h5") / "weather.csv", "3"});
    expect_refused("a.h5", "is an input of this job, and the run would keep");
}

TEST_F(OutputNames, TheLastNightIsAnInput) {
    write("last.h5", "\x89HDF...");
    OutputWish wish{folder_ / "last.h5"};
    wish.last_night = folder_ / "last.h5";
    EXPECT_THROW(choose_output(job_, wish), UserError);
}

TEST_F(OutputNames, ATableAvoidsTheInputs) {
    make_stock();
    EXPECT_EQ(table("night.h5"), "night.csv");
    EXPECT_EQ(table("stock.h5"), "stock-table.csv");
    EXPECT_EQ(table("readings.h5"), "readings-table.csv") << "named by a cell";
    fs::create_symlink("stock.csv", folder_ / "link.csv");
    EXPECT_EQ(table("link.h5"), "link-table.csv");
}

TEST_F(OutputNames, ATableAndAHistoryAvoidFilesThatNoRunWrote) {
    make_stock();
    write("night.csv", "my,own,table\n");
    write("night-table.csv", "my,own,table\n");
    write("stock-history.csv", "my,own,history\n");
    EXPECT_EQ(table("night.h5"), "night-table-2.csv");
    EXPECT_EQ(history("night.h5"), "stock-history-2.csv");
    write("night.csv", stock::table_head);
    write("stock-history.csv", stock::history_head + std::string("a night\n"));
    EXPECT_EQ(table("night.h5"), "night.csv");
    EXPECT_EQ(history("night.h5"), "stock-history.csv");
}

TEST_F(OutputNames, ADefaultNameAvoidsTheInputs) {
    const fs::path before = fs::current_path();
    fs::current_path(folder_.path());
    EXPECT_EQ(choose_output(job_, {}).result, "office.h5");
    write("office.h5", "readings of somebody");
    job_.inputs.push_back({folder_ / "office.h5", "4"});
    EXPECT_EQ(choose_output(job_, {}).result, "office-result.h5");
    job_.inputs.push_back({folder_ / "office-result.h5", "4"});
    EXPECT_EQ(choose_output(job_, {}).result, "office-result-2.h5");
    fs::current_path(before);
}

TEST_F(OutputNames, AFileThatIsNoResultIsNotReplacedByOne) {
    write("night.h5", "my own notes");
    expect_refused("night.h5", "night.h5: is there already, and is no result");
    write("night.h5", "\x89HDF...");
    EXPECT_EQ(chosen("night.h5"), "night.h5");
}

TEST_F(OutputNames, APipeADeviceOrAFolderIsNotReplacedByOne) {
    make_stock();
    ASSERT_EQ(::mkfifo((folder_ / "pipe.h5").c_str(), 0600), 0);
    fs::create_symlink("/dev/null", folder_ / "device.h5");
    for (const char* name : {"pipe.h5", "device.h5"})
        expect_refused(name, std::string(name) + ": is there already, and is no result");
    ASSERT_EQ(::mkfifo((folder_ / "night.csv").c_str(), 0600), 0);
    fs::create_directory(folder_ / "night-table.csv");
    EXPECT_EQ(table("night.h5"), "night-table-2.csv");
}

TEST_F(OutputNames, LongNamesAreRefusedOrShortened) {
    expect_refused(std::string(250, 'n') + ".h5", "more than 240 bytes");
    job_.name = std::string(300, 'n');
    EXPECT_LT(choose_output(job_, {}).result.string().size(), 240U);
}

}  // namespace
}  // namespace bemcal::run
