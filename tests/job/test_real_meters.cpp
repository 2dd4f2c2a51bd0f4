/// Meters as published, where they are at hand: what the checks find in them.
#include "job/data_checks.hpp"
#include "job/input_files.hpp"
#include "job/small_office.hpp"

#include <filesystem>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

const std::filesystem::path data = BEMCAL_ROOT "/../shared/data";

TEST(RealMeters, CambridgeGasIsReadAndChecked) {
    const auto file = data / "cambridge" / "gas_as_published.csv.gz";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
    InputFiles files;
    const Csv& csv = files.csv(file);
    int n_steps = 0;
    for (std::size_t column = 1; column < csv.columns.size(); ++column) {
        const std::vector<double> readings = numbers_in(csv, column);
        const auto zeros = constant_runs(readings, 25, true);
        const auto same = constant_runs(readings, 25, false);
        for (const UnitStep& step : unit_steps(readings, 24)) {
            ++n_steps;
            fmt::print("{}: a step by {:.3g} at {} ({})\n", csv.columns[column],
                       step.ratio, csv.cell(static_cast<std::size_t>(step.at), 0),
                       step.units);
        }
        fmt::print("{}: {} runs of zeros, {} of another value\n", csv.columns[column],
                   zeros.size(), same.size());
    }
    EXPECT_LT(n_steps, 15);
}

}  // namespace
}  // namespace bemcal::job
