#include "description/result_names.hpp"
#include "store/dataset_path.hpp"
#include "store/layout.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

namespace bemcal::store {
namespace {

TEST(Layout, EveryNameStandsOnceWithItsDimensions) {
    std::set<std::string> names;
    for (const LayoutRow& row : layout())
        EXPECT_TRUE(names.insert(std::string(row.leaf) + " " + row.dims).second)
            << row.leaf;
}

TEST(Layout, OneNameMayStandForOtherDimensionsInAnotherKindOfStudy) {
    const auto meaning = [](std::vector<std::string> dims) {
        return std::string(
            layout_of({"a/b/simulated", std::move(dims), {}, {}, {}}).dims);
    };
    EXPECT_EQ(meaning({"candidate", "time"}), "candidate time");
    EXPECT_EQ(meaning({"model", "time"}), "model time");
    EXPECT_THROW(meaning({"time"}), std::logic_error);
}

TEST(Layout, EveryNumberHasAUnitAndEveryRowAMeaning) {
    for (const LayoutRow& row : layout()) {
        EXPECT_EQ(std::string(row.unit).empty(), row.kind == Kind::text) << row.leaf;
        EXPECT_FALSE(std::string(row.meaning).empty()) << row.leaf;
    }
}

/// A period's group stands in its study's, beside the datasets and dimensions there.
TEST(Layout, NoPeriodMayBeCalledAsWhatAScreeningStores) {
    const auto at = [](const char* leaf) {
        return std::ranges::find_if(layout(), [&](const LayoutRow& row) {
            return row.leaf == std::string(leaf);
        });
    };
    const auto check = [](auto first, auto last) {
        for (auto row = first; row <= last; ++row) {
            std::istringstream names(std::string(row->leaf) + " " + row->dims);
            for (std::string name; names >> name;)
                EXPECT_NE(description::refusal_of_name(description::Named::period, name),
                          "")
                    << name;
        }
    };
    check(at("parameter"), at("failed_reason"));
    check(at("meter"), at("n_points"));
    check(at("unknown"), at("data_words"));
    check(at("channel"), at("misfit"));
    EXPECT_EQ(description::refusal_of_name(description::Named::period, "heating"), "");
}

TEST(Layout, NoPeriodOrBuildingMayBeCalledAsAGroupOfAPosterior) {
    for (const LayoutRow& row : layout()) {
        const std::string group = group_of(row.leaf);
        if (group.empty()) continue;
        EXPECT_NE(description::refusal_of_name(description::Named::period, group), "")
            << group;
        EXPECT_NE(description::refusal_of_name(description::Named::building, group), "")
            << group;
    }
}

TEST(Layout, WhatTheUserNamesIsFoundByItsGroupAndDimensions) {
    const auto meaning = [](const char* path, std::vector<std::string> dims) {
        return std::string(layout_of({path, std::move(dims), {}, {}, {}}).leaf);
    };
    EXPECT_EQ(meaning("office/posterior/posterior/U_wall", {"chain", "draw"}),
              "posterior/*");
    EXPECT_EQ(meaning("office/posterior/posterior/heating", {"chain", "draw"}),
              "posterior/*");
    EXPECT_EQ(meaning("office/posterior/target_ess", {}), "target_ess");
    EXPECT_EQ(meaning("a/b/posterior_predictive/gas", {"chain", "draw", "time_gas"}),
              "posterior_predictive/*");
    EXPECT_EQ(meaning("a/b/observed_data/time_gas", {"time_gas"}), "time_*");
    EXPECT_THROW(meaning("a/b/posterior/U_wall", {"draw", "chain"}), std::logic_error);
    EXPECT_THROW(meaning("a/b/elsewhere/U_wall", {"chain", "draw"}), std::logic_error);
}

TEST(Layout, NoRowHasADimensionTwiceSinceNetcdfReadersRefuseThat) {
    for (const LayoutRow& row : layout()) {
        std::istringstream dims(row.dims);
        std::set<std::string> seen;
        for (std::string dim; dims >> dim;)
            EXPECT_TRUE(seen.insert(dim).second) << row.leaf;
    }
}

TEST(Layout, FindsADatasetByTheLastPartOfItsPath) {
    const LayoutRow& row = layout_of(
        {"office/sensitivity/total_order", {"output", "parameter"}, {1, 1}, {0.5}, {}});
    EXPECT_STREQ(row.unit, "1");
}

TEST(Layout, AnUnknownNameOrOtherDimensionsAreAProgramError) {
    EXPECT_THROW(layout_of({"a/no_such_leaf", {}, {}, {1}, {}}), std::logic_error);
    EXPECT_THROW(layout_of({"a/total_order", {"parameter"}, {1}, {1}, {}}),
                 std::logic_error);
    EXPECT_THROW(layout_of({"a/threshold", {}, {}, {}, {"text"}}), std::logic_error);
}

TEST(Layout, TheDescriptionNamesEveryRow) {
    const std::string text = describe_results();
    for (const LayoutRow& row : layout())
        EXPECT_NE(text.find(row.leaf), std::string::npos);
}

}  // namespace
}  // namespace bemcal::store
