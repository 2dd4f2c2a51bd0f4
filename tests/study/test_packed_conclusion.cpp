#include "study/packed_conclusion.hpp"

#include <cmath>

#include <gtest/gtest.h>

using namespace bemcal::study;

TEST(PackedConclusion, HasItsDatasetsAsTheyWere) {
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
    const auto back = unpack_conclusion(pack({given})).datasets;
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

TEST(PackedConclusion, HasItsSummariesAsTheyWere) {
    Summary given;
    given.study = "a/loop";
    given.building = "a";
    given.values = {{"u_wall", 0.4, 0.3, 0.5}};
    given.fits = {{1, 2, 0.3, 0.2, -0.1}, {}};
    given.points.parameters = {"u_wall", "air"};
    given.points.rows = bemcal::Matrix(2, 2, 0.25);
    given.given = {{"leaks", {{"aperture", "-", true, "south facade", "", {0.5, 1}}}}};
    given.findings = {{"loop", "found: wind", "accepted"}};
    given.score = 3.5;
    given.failure = "why";
    given.shortfall = "biased";
    const auto all = unpack_conclusion(pack({{}, {Summary{}, given}})).summaries;
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].score, std::numeric_limits<double>::infinity());
    const Summary& back = all[1];
    EXPECT_EQ(back.study, given.study);
    EXPECT_EQ(back.building, given.building);
    ASSERT_EQ(back.values.size(), 1U);
    EXPECT_EQ(back.values[0].name, "u_wall");
    EXPECT_EQ(back.values[0].value, 0.4);
    EXPECT_EQ(back.values[0].low, 0.3);
    EXPECT_EQ(back.values[0].high, 0.5);
    ASSERT_EQ(back.fits.size(), 2U);
    EXPECT_EQ(back.fits[0].period, 1U);
    EXPECT_EQ(back.fits[0].meter, 2U);
    EXPECT_EQ(back.fits[0].before, 0.3);
    EXPECT_EQ(back.fits[0].cv_rmse, 0.2);
    EXPECT_EQ(back.fits[0].nmbe, -0.1);
    EXPECT_NE(back.fits[1].before, back.fits[1].before);  // NaN
    EXPECT_EQ(back.points.parameters, given.points.parameters);
    EXPECT_EQ(back.points.rows.rows, 2U);
    EXPECT_EQ(back.points.rows.cols, 2U);
    EXPECT_EQ(back.points.rows.values, given.points.rows.values);
    ASSERT_EQ(back.given.size(), 1U);
    EXPECT_EQ(back.given[0].name, "leaks");
    const auto& at = back.given[0].at.at(0);
    EXPECT_EQ(at.hook, "aperture");
    EXPECT_TRUE(at.is_factor);
    EXPECT_EQ(at.facade, "south facade");
    EXPECT_EQ(at.values, (std::vector<double>{0.5, 1}));
    EXPECT_TRUE(std::isnan(at.opens_above));
    ASSERT_EQ(back.findings.size(), 1U);
    EXPECT_EQ(back.findings[0].finding, "found: wind");
    EXPECT_EQ(back.findings[0].action, "accepted");
    EXPECT_EQ(back.score, 3.5);
    EXPECT_EQ(back.failure, "why");
    EXPECT_EQ(back.shortfall, "biased");
}
