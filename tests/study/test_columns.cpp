#include "study/columns.hpp"

#include <limits>

#include <gtest/gtest.h>

using namespace bemcal::study;

namespace {

struct Person {
    std::string name = "nobody";
    double age = -1;
};
constexpr auto visit_person = [](auto& person, auto&& see) {
    see("person", person.name);
    see("person_age", person.age);
};

}  // namespace

TEST(Columns, AreARowForEachStructAndBack) {
    ColumnWriter columns("house", "person");
    columns.add(Person{"Ann", 41}, visit_person);
    columns.add(Person{"Bo", 3}, visit_person);
    std::vector<Dataset> datasets;
    columns.take(datasets);
    ASSERT_EQ(datasets.size(), 2U);
    EXPECT_EQ(datasets[0].path, "house/person");
    EXPECT_EQ(datasets[0].dims, std::vector<std::string>{"person"});
    EXPECT_EQ(datasets[0].texts, (std::vector<std::string>{"Ann", "Bo"}));
    EXPECT_EQ(datasets[1].values, (std::vector<double>{41, 3}));
    const auto back = rows_in<Person>(datasets, "house", visit_person);
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[1].name, "Bo");
    EXPECT_EQ(back[1].age, 3);
}

TEST(Columns, AreThereWithoutARowWhereTheyAreDeclared) {
    std::vector<Dataset> datasets;
    ColumnWriter none("house", "person");
    none.take(datasets);
    EXPECT_TRUE(datasets.empty());
    ColumnWriter declared("house", "person");
    declared.declare<Person>(visit_person);
    declared.take(datasets);
    ASSERT_EQ(datasets.size(), 2U);
    EXPECT_EQ(datasets[1].shape, std::vector<std::size_t>{0});
    EXPECT_TRUE(rows_in<Person>(datasets, "house", visit_person).empty());
}

TEST(Columns, ThatAreMissingLeaveTheFieldAsItIs) {
    const std::vector<Dataset> datasets{{"house/person", {"person"}, {1}, {}, {"Ann"}}};
    const auto back = rows_in<Person>(datasets, "house", visit_person);
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].age, -1);
    EXPECT_TRUE(rows_in<Person>(datasets, "elsewhere", visit_person).empty());
}

TEST(PlaceIn, IsNoPlaceForWhatIsNoIndex) {
    EXPECT_EQ(place_in(2, 3), 2U);
    for (const double value :
         {-1.0, 3.0, 1e300, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(place_in(value, 3), 3U);
}
