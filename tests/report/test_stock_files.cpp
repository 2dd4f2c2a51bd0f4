#include "base/disk.hpp"
#include "base/error.hpp"
#include "report/stock_files.hpp"
#include "report/stock_tables.hpp"
#include "stock/record.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

store::ResultFile night_of(const std::vector<std::string>& names) {
    store::ResultFile result;
    result.attributes["title"] = "houses";
    std::vector<stock::StockRecord> records(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) records[k].name = names[k];
    result.datasets =
        stock::datasets_of(names.size(), [&](std::size_t k) { return records[k]; });
    return result;
}

run::OutputNames names_of(const test::TemporaryFolder& folder, const std::string& night) {
    return {folder / (night + ".h5"), folder / (night + ".csv"),
            folder / "houses-history.csv", folder / (night + "-changes.csv")};
}

std::string text_of(const std::filesystem::path& path) {
    return read_regular(path);
}

TEST(StockFiles, ANightDoneAgainIsReplacedInTheHistoryWhateverItsName) {
    const test::TemporaryFolder folder;
    for (const char* name : {"mon", "a,b", "a,b", "mon"})
        write_stock_files(names_of(folder, name), night_of({"one", "two\nlines"}));
    const std::string history = text_of(folder / "houses-history.csv");
    EXPECT_EQ(std::ranges::count(history, '\n'), 5) << history;
    EXPECT_NE(history.find("\"a,b\",one,"), std::string::npos) << history;
}

TEST(StockFiles, EachChangeThatWasToldHasALine) {
    const test::TemporaryFolder folder;
    std::vector<stock::StockRecord> records(2);
    records[0].name = "quiet";
    records[1].name = "other";
    records[1].searches = 1;
    records[1].told =
        "ended: wind: infiltration, on 2022-03-04; new: gas: all hours, +7 "
        "kWh/d, since 2022-03-05";
    store::ResultFile night = night_of({});
    night.datasets =
        stock::datasets_of(records.size(), [&](std::size_t k) { return records[k]; });
    write_stock_files(names_of(folder, "mon"), night);
    EXPECT_EQ(text_of(folder / "mon-changes.csv"),
              "building,change,effect,searches\n"
              "other,ended,\"wind: infiltration, on 2022-03-04\",1\n"
              "other,new,\"gas: all hours, +7 kWh/d, since 2022-03-05\",1\n");
}

TEST(StockFiles, AFileThatNoNightWroteIsKept) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "mon.csv") << "my,own\n";
    EXPECT_THROW(write_stock_files(names_of(folder, "mon"), night_of({"one"})),
                 UserError);
    EXPECT_EQ(text_of(folder / "mon.csv"), "my,own\n");
    std::ofstream(folder / "houses-history.csv") << "my,own\n";
    EXPECT_THROW(write_stock_files(names_of(folder, "tue"), night_of({"one"})),
                 UserError);
    EXPECT_EQ(text_of(folder / "houses-history.csv"), "my,own\n");
}

TEST(StockFiles, NoTemporaryNameFollowsALink) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "victim") << "precious";
    for (const char* name : {"mon.csv.tmp", "houses-history.csv.tmp"})
        std::filesystem::create_symlink("victim", folder / name);
    write_stock_files(names_of(folder, "mon"), night_of({"one"}));
    EXPECT_EQ(text_of(folder / "victim"), "precious");
}

TEST(CsvCell, AFormulaIsMadeAText) {
    EXPECT_EQ(csv_cell("=cmd|calc!A1"), "'=cmd|calc!A1");
    EXPECT_EQ(csv_cell("+1"), "'+1");
    EXPECT_EQ(csv_cell("-1"), "'-1");
    EXPECT_EQ(csv_cell("@SUM(A1)"), "'@SUM(A1)");
    EXPECT_EQ(csv_cell("  =1"), "'  =1");
    EXPECT_EQ(csv_cell("=1,2"), "\"'=1,2\"");
    EXPECT_EQ(csv_cell("\t=1"), "\\t=1");
    EXPECT_EQ(csv_cell("\r=1"), "\\x0d=1");
    EXPECT_EQ(csv_cell("a=b-c"), "a=b-c");
    EXPECT_EQ(csv_cell(""), "");
    EXPECT_EQ(csv_cell("-"), "-");  // no unit
}

TEST(CsvCell, IsOneLineWithQuotesWhereNeeded) {
    EXPECT_EQ(csv_cell("a,\"b\""), "\"a,\"\"b\"\"\"");
    EXPECT_EQ(csv_cell("a\nb"), "a\\nb");
    EXPECT_EQ(csv_cell("x\x1b[31m"), "x\\x1b[31m");
}

}  // namespace
}  // namespace bemcal::report
