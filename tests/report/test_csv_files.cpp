/// A result as CSV files: which there are, and what stands in them.
#include "base/error.hpp"
#include "report/csv_files.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

using study::Dataset;

std::string content_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

store::ResultFile small_result() {
    std::vector<double> draws(2 * 300);
    for (std::size_t k = 0; k < draws.size(); ++k) draws[k] = static_cast<double>(k);
    store::ResultFile result;
    result.datasets = {
        {"office/loop/kind", {}, {}, {}, {"loop"}},
        {"office/loop/effect", {"effect"}, {2}, {}, {"wind", "sun, low"}},
        {"office/loop/meter", {"meter"}, {2}, {}, {"gas", "heat"}},
        {"office/loop/size", {"effect"}, {2}, {0.1, std::nan("")}, {}, "1/h"},
        {"office/loop/brings", {"effect", "meter"}, {2, 2}, {1, 2, 3, 4}, {}, "kWh"},
        {"office/loop/draw", {"chain", "draw"}, {2, 300}, draws, {}},
        {"office/loop/training/time",
         {"time"},
         {1},
         {1609459200},
         {},
         "seconds since 1970-01-01 00:00:00"},
        {"office/loop/training/made_up", {"time", "meter"}, {1, 2}, {5, 6}, {}}};
    return result;
}

TEST(CsvFiles, HaveAFileForEachLeadingDimensionWithNamesFromCoordinates) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(write_csv_files(small_result(), folder / "new"), 5);
    const std::filesystem::path loop = folder / "new/office/loop";
    EXPECT_EQ(content_of(loop / "effect.csv"),
              "effect,size [1/h],brings gas [kWh],brings heat [kWh]\n"
              "wind,0.1,1,2\n\"sun, low\",,3,4\n");
    EXPECT_EQ(content_of(loop / "values.csv"), "name,value,unit\nkind,loop,\n");
    EXPECT_EQ(content_of(loop / "training/time.csv"),
              "time,made_up gas,made_up heat\n2021-01-01 00:00:00,5,6\n");
}

TEST(CsvFiles, PutDimensionsIntoRowsWhereTheyWouldBeTooManyColumns) {
    const test::TemporaryFolder folder;
    write_csv_files(small_result(), folder / "new");
    const std::string text = content_of(folder / "new/office/loop/chain-draw.csv");
    EXPECT_TRUE(text.starts_with("chain,draw,draw\n1,1,0\n1,2,1\n")) << text;
    EXPECT_TRUE(text.ends_with("2,300,599\n"));
}

TEST(CsvFiles, AreWrittenOverNothingAndOnlyIntoTheFolder) {
    const test::TemporaryFolder folder;
    folder.write("mine.txt", "kept");
    EXPECT_THROW(write_csv_files(small_result(), folder.path()), UserError);
    store::ResultFile crafted;
    crafted.datasets = {{"../away/x", {"n"}, {1}, {1}, {}}};
    EXPECT_THROW(write_csv_files(crafted, folder / "new"), UserError);
    EXPECT_FALSE(std::filesystem::exists(folder / "new"));
}

TEST(CsvFiles, OfADamagedResultAreRefused) {
    const test::TemporaryFolder folder;
    store::ResultFile damaged;
    damaged.datasets = {{"a/b/x", {"n"}, {3}, {1}, {}}};
    EXPECT_THROW(write_csv_files(damaged, folder / "new"), UserError);
    damaged.datasets = {{"a/b/x", {"n"}, {1}, {1}, {}},
                        {"a/b/y", {"n"}, {2}, {1, 2}, {}}};
    EXPECT_THROW(write_csv_files(damaged, folder / "newer"), UserError);
}

}  // namespace
}  // namespace bemcal::report
