/// Whatever is wrong with a dataset, the tables are text or a message: every dataset of
/// results of all kinds is taken away, cut, made longer, of another kind, or no number.
#include "base/error.hpp"
#include "fuzz/result_targets.hpp"
#include "job/small_results.hpp"
#include "report/tables.hpp"

#include <cmath>
#include <functional>
#include <map>

#include <gtest/gtest.h>

namespace bemcal::report {
namespace {

using store::ResultFile;
using study::Dataset;

/// Every reader answers, or says which dataset is damaged.
void expect_answers(const ResultFile& result) {
    for (const std::string& refusal : fuzz::try_result(result))
        EXPECT_TRUE(refusal.starts_with("damaged: dataset ")) << refusal;
}

void cut_to(Dataset& dataset, std::size_t axis, std::size_t size) {
    dataset.shape[axis] = size;
    fuzz::fit_to_shape(dataset, !dataset.texts.empty(), 1);
}

using Damage = std::function<void(Dataset&)>;

std::vector<Damage> damages() {
    std::vector<Damage> all;
    for (const std::size_t axis : {0, 1, 2})
        for (const std::size_t size : {0, 3})
            all.emplace_back([=](Dataset& d) {
                if (axis < d.shape.size()) cut_to(d, axis, size);
            });
    for (const double value : {std::nan(""), 1e300, -1.0, 1e9})
        all.emplace_back([=](Dataset& d) {
            std::ranges::fill(d.values, value);
            std::ranges::fill(d.texts, std::to_string(value));
        });
    all.emplace_back([](Dataset& d) {
        d.texts.assign(d.values.size(), "text");
        d.values.clear();
    });
    all.emplace_back([](Dataset& d) {
        d.values.assign(d.texts.size(), 3);
        d.texts.clear();
    });
    all.emplace_back([](Dataset& d) {
        d.dims.clear();
        d.shape.clear();
        if (!d.values.empty()) d.values.resize(1);
        if (!d.texts.empty()) d.texts.resize(1);
    });
    return all;
}

/// "office/screening" of "office/screening/training/gas/time".
std::string study_of(const Dataset& dataset) {
    const std::size_t end = dataset.path.find('/', dataset.path.find('/') + 1);
    return dataset.path.substr(0, end);
}

/// The result of each study alone.
std::vector<ResultFile> parts_of(const ResultFile& result) {
    std::map<std::string, ResultFile> parts;
    for (const Dataset& dataset : result.datasets) {
        const std::string study =
            dataset.path.starts_with("stock/") ? "stock" : study_of(dataset);
        ResultFile& part = parts[study];
        part.attributes = result.attributes;
        part.datasets.push_back(dataset);
    }
    std::vector<ResultFile> all;
    for (auto& [study, part] : parts) all.push_back(std::move(part));
    return all;
}

void damage_each_dataset_of(const ResultFile& good) {
    EXPECT_FALSE(tables_of(good).empty());
    for (std::size_t k = 0; k < good.datasets.size(); ++k) {
        SCOPED_TRACE(good.datasets[k].path);
        ResultFile damaged = good;
        damaged.datasets.erase(damaged.datasets.begin() + static_cast<std::ptrdiff_t>(k));
        expect_answers(damaged);
        for (const Damage& damage : damages()) {
            damaged.datasets = good.datasets;
            damage(damaged.datasets[k]);
            expect_answers(damaged);
        }
    }
}

TEST(DamagedTables, OfEveryKindOfStudyAreTextOrAMessage) {
    const auto parts = parts_of(job::small_result());
    EXPECT_EQ(parts.size(), 9U);
    for (const ResultFile& part : parts) damage_each_dataset_of(part);
}

TEST(DamagedTables, OfAStockAreTextOrAMessage) {
    damage_each_dataset_of(job::small_stock_result());
}

TEST(DamagedTables, ADatasetThatIsMissingIsNamed) {
    ResultFile result = job::small_stock_result();
    std::erase_if(result.datasets,
                  [](const Dataset& d) { return d.path == "stock/stock_fit_meter"; });
    try {
        tables_of(result);
        FAIL();
    } catch (const UserError& error) {
        EXPECT_STREQ(
            error.what(),
            "damaged: dataset stock/stock_fit_meter is missing, and a value 1 is "
            "used");
    }
}

}  // namespace
}  // namespace bemcal::report
