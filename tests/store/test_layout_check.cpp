#include "base/error.hpp"
#include "store/layout_check.hpp"

#include <gtest/gtest.h>

namespace bemcal::store {
namespace {

using study::Dataset;

/// "" where the layout is ours.
std::string refusal_of(std::vector<Dataset> datasets) {
    ResultFile result;
    result.datasets = std::move(datasets);
    try {
        check_layout(result);
        return "";
    } catch (const UserError& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::data);
        return error.what();
    }
}

Dataset texts(const std::string& path, const std::string& dim,
              std::vector<std::string> values) {
    const std::size_t n = values.size();
    return {path, {dim}, {n}, {}, std::move(values)};
}

const Dataset output = texts("a/sa/output", "output", {"heating", "cooling"});
const Dataset parameter = texts("a/sa/parameter", "parameter", {"u", "v", "w"});
const Dataset indices{
    "a/sa/total_order", {"output", "parameter"}, {2, 3}, std::vector<double>(6, 0.5), {}};

TEST(LayoutCheck, WhatIsOursPasses) {
    EXPECT_EQ(refusal_of({output, parameter, indices}), "");
    EXPECT_EQ(refusal_of({indices}), "");
}

TEST(LayoutCheck, UnknownDatasetsPass) {
    EXPECT_EQ(refusal_of({{"a/sa/unheard_of", {"x"}, {2}, {1, 2}, {}}}), "");
}

TEST(LayoutCheck, OtherDimensionsAreNamed) {
    EXPECT_EQ(refusal_of({{"a/sa/total_order", {"x"}, {2}, {1, 2}, {}}}),
              "damaged: dataset a/sa/total_order has shape (2), and dimensions \"x\", "
              "where numbers of \"output parameter\" belong");
}

TEST(LayoutCheck, TextsInPlaceOfNumbersAreNamed) {
    EXPECT_EQ(refusal_of({{"a/sa/parameter", {"parameter"}, {2}, {1, 2}, {}}}),
              "damaged: dataset a/sa/parameter has shape (2), and dimensions "
              "\"parameter\", where texts of \"parameter\" belong");
}

TEST(LayoutCheck, LengthsGoWithTheNamesBesideThem) {
    EXPECT_EQ(refusal_of({output, texts("a/sa/parameter", "parameter", {"u"}), indices}),
              "damaged: dataset a/sa/total_order has shape (2, 3), and there are 1 of "
              "\"parameter\"");
}

TEST(LayoutCheck, OrWithThoseOfAGroupAbove) {
    EXPECT_EQ(refusal_of({texts("a/parameter", "parameter", {"u", "v", "w"}), output,
                          texts("a/sa/parameter", "parameter", {"u"}), indices}),
              "");
}

}  // namespace
}  // namespace bemcal::store
