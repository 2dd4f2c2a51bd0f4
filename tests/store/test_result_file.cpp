#include "base/error.hpp"
#include "store/result_file.hpp"
#include "store/result_reading.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

namespace bemcal::store {
namespace {

ResultFile example() {
    ResultFile result;
    result.attributes = {{"program", "bemcal-batch"}, {"job_name", "b\xc3\xbcro"}};
    result.run = {{"n_ranks", "2"}};
    result.datasets = {
        {"office/sa/output", {"output"}, {2}, {}, {"heating", "cooling"}},
        {"office/sa/parameter", {"parameter"}, {3}, {}, {"a", "b", "c"}},
        {"office/sa/total_order",
         {"output", "parameter"},
         {2, 3},
         {1, 2, 3, 4, NAN, 6},
         {}},
        {"office/sa/sample_a",
         {"base_point", "parameter"},
         {4, 3},
         std::vector<double>(12, 0.5),
         {}},
        {"office/sa/threshold", {}, {}, {0.05}, {}},
        {"office/sa/failed_point", {"failure"}, {0}, {}, {}},
        {"office/screen/candidate", {"candidate"}, {2}, {}, {"nominal", "best"}},
        {"office/screen/training/gas/time", {"time"}, {3}, {0, 3600, 7200}, {}},
        {"office/screen/training/gas/simulated",
         {"candidate", "time"},
         {2, 3},
         {1, 2, 3, 4, 5, 6},
         {}},
    };
    return result;
}

const study::Dataset& dataset(const ResultFile& result, const std::string& path) {
    for (const auto& found : result.datasets)
        if (found.path == path) return found;
    throw std::out_of_range(path);
}

TEST(ResultFile, IsReadBackAsItWasWritten) {
    const test::TemporaryFolder folder;
    const ResultFile written = example();
    const std::string hash = write_result(folder / "a.h5", written);
    const ResultFile read = read_result(folder / "a.h5");
    EXPECT_TRUE(read.complete);
    EXPECT_EQ(read.hash, hash);
    EXPECT_EQ(read.attributes, written.attributes);
    EXPECT_EQ(read.run.at("n_ranks"), "2");
    EXPECT_TRUE(read.run.contains("seconds_store"));
    ASSERT_EQ(read.datasets.size(), written.datasets.size());
    for (const auto& original : written.datasets) {
        const auto& again = dataset(read, original.path);
        EXPECT_EQ(again.dims, original.dims) << original.path;
        EXPECT_EQ(again.shape, original.shape) << original.path;
        EXPECT_EQ(again.texts, original.texts) << original.path;
    }
    EXPECT_EQ(result_hash(read), hash);
}

ResultFile of_buildings(int n) {
    ResultFile all;
    for (int k = 0; k < n; ++k)
        for (study::Dataset each : example().datasets) {
            each.path.replace(0, std::string("office").size(), std::to_string(k));
            all.datasets.push_back(std::move(each));
        }
    all.attributes = example().attributes;
    return all;
}

/// Processor time of reading it. [ticks]
std::clock_t time_to_read(const std::filesystem::path& file) {
    const std::clock_t begin = std::clock();
    EXPECT_FALSE(read_here(file, "").datasets.empty());
    return std::clock() - begin;
}

/// With the square of their number it was 100 times as much.
TEST(ResultFile, TenTimesAsManyBuildingsTakeTenTimesAsLongToRead) {
    const test::TemporaryFolder folder;
    write_result(folder / "few.h5", of_buildings(40));
    write_result(folder / "many.h5", of_buildings(400));
    const double few = static_cast<double>(time_to_read(folder / "few.h5")),
                 many = static_cast<double>(time_to_read(folder / "many.h5"));
    EXPECT_LE(many, 30 * few);
}

TEST(ResultFile, OfOneGroupOnlyItsDatasetsAreRead) {
    const test::TemporaryFolder folder;
    const std::string hash = write_result(folder / "a.h5", example());
    const ResultFile read = read_result(folder / "a.h5", "office/screen");
    EXPECT_EQ(read.datasets.size(), 3U);
    EXPECT_EQ(dataset(read, "office/screen/candidate").texts[1], "best");
    EXPECT_EQ(read.hash, hash);
    EXPECT_TRUE(read_result(folder / "a.h5", "offi").datasets.empty());
}

TEST(ResultFile, TheHashCoversEverythingButTheRun) {
    const std::string hash = result_hash(example());
    ResultFile other = example();
    other.run["n_ranks"] = "16";
    std::swap(other.datasets[0], other.datasets[3]);
    EXPECT_EQ(result_hash(other), hash);
    other.datasets[2].values[0] = std::nextafter(1.0, 2.0);
    EXPECT_NE(result_hash(other), hash);
    other = example();
    other.attributes["job_name"] = "other";
    EXPECT_NE(result_hash(other), hash);
    other = example();
    other.datasets[1].texts[0] = "z";
    EXPECT_NE(result_hash(other), hash);
}

TEST(ResultFile, ADatasetOutsideTheLayoutIsAProgramError) {
    const test::TemporaryFolder folder;
    ResultFile result = example();
    result.datasets.push_back({"office/unheard_of", {}, {}, {1}, {}});
    EXPECT_THROW(write_result(folder / "a.h5", result), std::logic_error);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(ResultFile, NoFileOfThatNameAndOtherFilesAreUserErrors) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "text.h5") << "not HDF5";
    std::ofstream(folder / "empty.h5");
    for (const char* name : {"missing.h5", "text.h5", "empty.h5"})
        EXPECT_THROW(read_result(folder / name), UserError) << name;
}

TEST(ResultFile, ASealSaysWhetherTheContentIsWhatWasWritten) {
    const test::TemporaryFolder folder;
    const std::string hash = write_result(folder / "a.h5", example());
    EXPECT_EQ(read_head(folder / "a.h5").hash, hash);
    EXPECT_TRUE(read_head(folder / "a.h5").datasets.empty());
    EXPECT_TRUE(is_sound(read_result(folder / "a.h5")));
    std::fstream file(folder / "a.h5", std::ios::in | std::ios::out | std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    const double value = example().datasets[2].values[0];
    const std::string number(reinterpret_cast<const char*>(&value), sizeof value);
    const std::size_t at = bytes.find(number);
    ASSERT_NE(at, std::string::npos);
    file.clear();
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(number[0] ^ 1));
    file.close();
    EXPECT_FALSE(is_sound(read_result(folder / "a.h5")));
}

TEST(ResultFile, UnitsAndTheRunAreWatchedToo) {
    const test::TemporaryFolder folder;
    write_result(folder / "a.h5", example());
    const ResultFile read = read_result(folder / "a.h5");
    EXPECT_TRUE(is_sound(read));
    ResultFile changed = read;
    changed.datasets[2].unit += "x";
    EXPECT_FALSE(is_sound(changed));
    changed = read;
    changed.run["failed"] = "";
    EXPECT_FALSE(is_sound(changed));
    EXPECT_EQ(result_hash(changed), read.hash);
}

TEST(ResultFile, ANameThatWasTakenMeanwhileIsKept) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "part");
    folder.write("a.h5", "somebody's");
    EXPECT_THROW(write_result(folder / "a.h5", example(), {folder / "part", Replace::no}),
                 UserError);
    EXPECT_EQ(read_regular(folder / "a.h5"), "somebody's");
    EXPECT_TRUE(std::filesystem::is_empty(folder / "part"));
    write_result(folder / "a.h5", example(), {folder / "part", Replace::yes});
    EXPECT_TRUE(is_sound(read_result(folder / "a.h5")));
}

TEST(ResultFile, AFolderThatIsNotThereIsAUserError) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_result(folder / "no" / "a.h5", example()), UserError);
}

TEST(ResultFile, AFullDiskLeavesNoFileAndTheOldOneWhole) {
    const test::TemporaryFolder folder;
    ::signal(SIGXFSZ, SIG_IGN);
    const std::string hash = write_result(folder / "a.h5", example());
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    ResultFile large = example();
    large.datasets.push_back({"x/points",
                              {"point", "parameter"},
                              {1000, 10},
                              std::vector<double>(10000, 1.0),
                              {}});
    for (const rlim_t limit : {100, 1000, 5000, 20000, 60000}) {
        const rlimit small{limit, old.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &small);
        EXPECT_THROW(write_result(folder / "a.h5", large), UserError) << limit;
        ::setrlimit(RLIMIT_FSIZE, &old);
        EXPECT_EQ(read_result(folder / "a.h5").hash, hash);
        EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.writing"));
    }
}

/// Runs Python code on a written example; 77 = a package is missing.
int run_python(const std::filesystem::path& file, const std::string& code) {
    const std::string command = "/usr/bin/python3 -c '" + code + "' " + file.string();
    return WEXITSTATUS(std::system(command.c_str()));
}

void expect_opened_by_xarray(const char* engine, const char* module) {
    const test::TemporaryFolder folder;
    write_result(folder / "a.h5", example());
    const int code = run_python(folder / "a.h5", std::string(R"(
import sys
try:
    import xarray, )") + module + R"(
except ImportError:
    sys.exit(77)
def group(name):
    return xarray.open_dataset(sys.argv[1], group=name, engine=")" +
                                                     engine + R"(")
sa = group("office/sa")
assert sa.total_order.dims == ("output", "parameter"), sa
assert float(sa.total_order.sel(output="heating", parameter="c")) == 3
assert sa.total_order.attrs["units"] == "1" and sa.total_order.attrs["long_name"]
assert sa.sample_a.dims == ("base_point", "parameter")
assert float(sa.threshold) == 0.05
gas = group("office/screen/training/gas")
assert str(gas.time.values[1]).startswith("1970-01-01T01:00"), gas.time
assert gas.simulated.dims == ("candidate", "time")
assert group("").attrs["COMPLETE"] == "yes"
)");
    if (code == 77) GTEST_SKIP() << "no xarray with " << module;
    EXPECT_EQ(code, 0);
}

/// Draws of two chains, as a posterior stores them.
ResultFile posterior_example() {
    ResultFile result;
    result.attributes = {{"program", "bemcal-batch"}};
    const std::string g = "office/posterior/";
    result.datasets = {
        {g + "unknown", {"unknown"}, {2}, {}, {"U_wall", "log_density"}},
        {g + "convergence", {}, {}, {}, {"converged"}},
        {g + "posterior/U_wall",
         {"chain", "draw"},
         {2, 3},
         {1, 2, 3, 4, 5, 6},
         {},
         "W/K"},
        {g + "sample_stats/lp", {"chain", "draw"}, {2, 3}, {6, 5, 4, 3, 2, 1}, {}},
        {g + "prior/U_wall", {"chain", "draw"}, {1, 5}, {1, 2, 3, 4, 5}, {}, "W/K"},
        {g + "observed_data/time_gas", {"time_gas"}, {2}, {0, 3600}, {}},
        {g + "observed_data/gas", {"time_gas"}, {2}, {7, 8}, {}, "kWh"},
        {g + "posterior_predictive/time_gas", {"time_gas"}, {2}, {0, 3600}, {}},
        {g + "posterior_predictive/gas",
         {"chain", "draw", "time_gas"},
         {1, 2, 2},
         {7, 8, 9, 10},
         {},
         "kWh"}};
    return result;
}

TEST(ResultFile, AUnitOfTheDatasetsOwnIsWrittenAndReadAgain) {
    const test::TemporaryFolder folder;
    write_result(folder / "a.h5", posterior_example());
    std::map<std::string, std::string> units;
    for (const auto& dataset : read_result(folder / "a.h5").datasets)
        units[dataset.path] = dataset.unit;
    EXPECT_EQ(units["office/posterior/posterior/U_wall"], "W/K");
    EXPECT_EQ(units["office/posterior/sample_stats/lp"], "1");
}

TEST(ResultFile, XarrayAndArvizOpenAPosteriorsGroups) {
    const test::TemporaryFolder folder;
    write_result(folder / "a.h5", posterior_example());
    const int code = run_python(folder / "a.h5", R"(
import sys
try:
    import xarray, netCDF4
except ImportError:
    sys.exit(77)
def group(name):
    return xarray.open_dataset(sys.argv[1], group="office/posterior/" + name)
draws = group("posterior")
assert draws.U_wall.dims == ("chain", "draw") and draws.U_wall.shape == (2, 3), draws
assert float(draws.U_wall[1, 0]) == 4 and draws.U_wall.attrs["units"] == "W/K"
assert group("sample_stats").lp.dims == ("chain", "draw")
assert group("prior").U_wall.shape == (1, 5)
assert group("observed_data").gas.dims == ("time_gas",)
assert group("posterior_predictive").gas.dims == ("chain", "draw", "time_gas")
try:
    import arviz
except ImportError:
    sys.exit(0)
names = ["posterior", "sample_stats", "prior", "observed_data", "posterior_predictive"]
data = arviz.InferenceData(**{name: group(name) for name in names})
assert float(arviz.summary(data)["mean"]["U_wall"]) == 3.5
)");
    if (code == 77) GTEST_SKIP() << "no xarray with netCDF4";
    EXPECT_EQ(code, 0);
}

TEST(ResultFile, XarrayOpensItThroughNetcdf4) {
    expect_opened_by_xarray("netcdf4", "netCDF4");
}
TEST(ResultFile, XarrayOpensItThroughH5netcdf) {
    expect_opened_by_xarray("h5netcdf", "h5netcdf");
}

}  // namespace
}  // namespace bemcal::store
