/// Functions that a posterior sampled: their values and bands, in a table and end to end.
#include "posterior/function_results.hpp"
#include "study/find.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace bemcal::posterior {
namespace {

using Values = std::vector<double>;

study::SampledFunction of_two_columns() {
    study::SampledFunction function{
        "use by wind", "gains", "wind", "W/m2", {functions::Points::Kind::knots, {0, 9}},
        {1, 2}};
    function.columns = Matrix(2, 2);
    function.columns(0, 0) = 1;
    function.columns(1, 0) = -1;
    function.columns(1, 1) = 0.5;
    return function;
}

/// Three draws of another parameter, the size and two columns.
study::FoundPoints three_draws() {
    study::FoundPoints draws;
    draws.parameters = {"walls", "use by wind: size", "use by wind 1", "use by wind 2"};
    draws.rows = Matrix(3, 4);
    const Values rows{9, 1, 0.1, 0, 9, 1, 0.2, 1, 9, 1, 0.6, -1};
    std::ranges::copy(rows, draws.rows.values.begin());
    return draws;
}

TEST(FunctionResults, ValuesAreThoseGivenAndTheColumnsOfEachDraw) {
    study::DatasetBuilder builder("p");
    add_functions({of_two_columns()}, three_draws(), builder);
    const auto datasets = builder.take();
    const auto near = [&](const char* leaf, const Values& expected) {
        const Values& found = test::find(datasets, leaf).values;
        ASSERT_EQ(found.size(), expected.size()) << leaf;
        for (std::size_t k = 0; k < found.size(); ++k)
            EXPECT_NEAR(found[k], expected[k], 1e-12) << leaf;
    };
    EXPECT_EQ(test::find(datasets, "function").texts,
              std::vector<std::string>{"use by wind"});
    near("function_point_of", {0, 0});
    near("function_point_at", {0, 9});
    near("function_point_value", {1.3, 1.7});  // of 1.1, 1.2, 1.6 and 1.9, 2.3, 0.9
    near("function_point_least", {1.11, 1.0});
    near("function_point_most", {1.56, 2.26});
}

TEST(FunctionResults, WithoutFunctionsNothingIsWritten) {
    study::DatasetBuilder builder("p");
    add_functions({}, three_draws(), builder);
    EXPECT_TRUE(builder.take().empty());
}

}  // namespace
}  // namespace bemcal::posterior
