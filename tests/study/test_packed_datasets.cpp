#include "study/packed_datasets.hpp"

#include <gtest/gtest.h>

using namespace bemcal::study;

TEST(PackedDatasets, ComeBackAsTheyWere) {
    const std::vector<Dataset> given = {{"a/b", {"x", "y"}, {2, 1}, {1.5, -2}, {}, "K"},
                                        {"a/names",
                                         {"x"},
                                         {2},
                                         {},
                                         {"",
                                          "gr\xC3\xB6\xC3\x9F"
                                          "er"},
                                         ""},
                                        {"a/one", {}, {}, {7}, {}, ""}};
    const auto back = unpack(pack(given));
    ASSERT_EQ(back.size(), given.size());
    for (std::size_t k = 0; k < given.size(); ++k) {
        EXPECT_EQ(back[k].path, given[k].path);
        EXPECT_EQ(back[k].dims, given[k].dims);
        EXPECT_EQ(back[k].shape, given[k].shape);
        EXPECT_EQ(back[k].values, given[k].values);
        EXPECT_EQ(back[k].texts, given[k].texts);
        EXPECT_EQ(back[k].unit, given[k].unit);
    }
}
