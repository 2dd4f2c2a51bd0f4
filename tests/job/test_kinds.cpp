/// The table of kinds of study, and what a [[study]] with a wrong kind or key gets.
#include "job/kinds.hpp"
#include "job/small_office.hpp"
#include "physics/quantities.hpp"
#include "schema/document.hpp"

#include <set>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

TEST(Kinds, HaveAWordOfTheirOwnAndAReaderAndStages) {
    std::set<std::string> words;
    for (const Kind* kind : kinds()) {
        EXPECT_TRUE(words.insert(kind->word).second) << kind->word;
        EXPECT_EQ(find_kind(kind->word), kind);
        EXPECT_NE(kind->read, nullptr) << kind->word;
        EXPECT_NE(kind->stages, nullptr) << kind->word;
        EXPECT_STREQ(kind->sections[0][0].name, "study") << kind->word;
        EXPECT_EQ(kind->sections[0][0].heading,
                  std::string("[[study]] kind = \"") + kind->word + "\"");
    }
    EXPECT_EQ(find_kind("screen"), nullptr);
}

TEST(Kinds, AreListedByWhatTheyCanBeDoneWith) {
    EXPECT_EQ(words_of_kinds([](const Kind& kind) { return kind.takes_stock; }),
              "screening, posterior or loop");
    EXPECT_EQ(words_of_kinds([](const Kind& kind) { return kind.takes_simulator; }),
              "sensitivity, kennedy_ohagan, optimisation or grid");
    EXPECT_EQ(words_of_kinds([](const Kind& kind) { return kind.points_of != nullptr; }),
              "screening, posterior or grid");
}

/// What opening a [[study]] of that text ends with; "" where it goes well.
std::string message_of_study(const std::string& text) {
    const std::string file = "job.toml";
    const schema::Node tree = schema::parse_document(text, file);
    try {
        open_study(tree, file);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

TEST(Kinds, AKeyOfNoKindGetsTheKeysOfThisOneTheNearestFirst) {
    EXPECT_EQ(message_of_study("kind = \"screening\"\nn_bst = 5\n"),
              "job.toml:2: study.n_bst: is no key of kind \"screening\"; expected one of "
              "n_best, name, runs, kind, n_points, keep_points, points_per_item");
    EXPECT_EQ(message_of_study("kind = \"hourly_sensitivity\"\nscrambel = true\n"),
              "job.toml:2: study.scrambel: is no key of kind \"hourly_sensitivity\"; "
              "expected one of scramble, name, n_base, period, kind, quantity");
}

TEST(Kinds, AKeyOfAnotherKindIsSaidToBeOne) {
    EXPECT_EQ(message_of_study("kind = \"screening\"\nbudget = 5\n"),
              "job.toml:2: study.budget: is a key of kind \"grid\"; this study is of "
              "kind \"screening\", whose keys are name, n_best, runs, kind, n_points, "
              "keep_points, points_per_item");
    EXPECT_NE(message_of_study("kind = \"loop\"\nn_base = 5\n")
                  .find("is a key of kind \"sensitivity\", \"hourly_sensitivity\" and "
                        "\"office_hour_sensitivity\"; this study is of kind \"loop\""),
              std::string::npos);
}

TEST(Kinds, StagesOfAGridAndOfACalibrationHaveKeysOfTheirOwn) {
    const schema::Table &grid = table_of(*find_kind("grid")),
                        &stages = table_of(*find_kind("stages"));
    EXPECT_TRUE(grid.find("study.stage")->takes_any_key);
    EXPECT_TRUE(grid.keys_of("study.stage").empty());
    EXPECT_FALSE(stages.find("study.stage")->takes_any_key);
    EXPECT_NE(stages.find("study.stage", "periods"), nullptr);
}

TEST(Kinds, QuantitiesOfKindsStandInTheOrderOfTheirTable) {
    const std::vector<std::string> words(physics::quantity_names.begin(),
                                         physics::quantity_names.end());
    const schema::Key* of_hours =
        table_of(*find_kind("hourly_sensitivity")).find("study", "quantity");
    const schema::Key* of_targets =
        table_of(*find_kind("grid")).find("study.target", "quantity");
    ASSERT_TRUE(of_hours != nullptr && of_targets != nullptr);
    EXPECT_EQ(schema::choices_of(*of_hours), words);
    EXPECT_EQ(schema::choices_of(*of_targets), words);
}

TEST(Kinds, AWordThatIsNoneGetsAllOfThemAndAMissingOneToo) {
    EXPECT_NE(message_of_study("kind = \"grids\"\n").find("did you mean \"grid\"?"),
              std::string::npos);
    EXPECT_NE(message_of_study("n_points = 5\n")
                  .find("study.kind: is missing; expected one of sensitivity, "),
              std::string::npos);
}

}  // namespace
}  // namespace bemcal::job
