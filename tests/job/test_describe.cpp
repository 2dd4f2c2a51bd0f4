/// The two references: complete, and the table behind them sound.
#include "job/job.hpp"
#include "schema/schema.hpp"

#include <set>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

TEST(Schema, EveryRowBelongsToASectionAndStandsThereOnce) {
    std::set<std::string> names;
    for (const schema::SectionInfo& section : schema::sections())
        names.insert(section.name);
    for (const schema::Key& key : schema::key_table())
        EXPECT_TRUE(names.contains(key.section)) << key.key;
    for (const schema::SectionInfo& section : schema::sections()) {
        std::set<std::string> keys;
        for (const schema::Key& key : schema::keys_of(section.name))
            EXPECT_TRUE(keys.insert(key.key).second) << section.name << "." << key.key;
    }
}

TEST(Schema, EveryRangeIsInOrderAndEveryDefaultOfAChoiceIsOneOfItsWords) {
    for (const schema::Key& key : schema::key_table()) {
        EXPECT_LE(key.least, key.most) << key.key;
        if (key.type != schema::Type::choice || key.fallback == nullptr ||
            *key.fallback == '\0')
            continue;
        const std::vector<std::string> words = schema::choices_of(key);
        EXPECT_NE(std::find(words.begin(), words.end(), key.fallback), words.end())
            << key.key;
    }
}

TEST(Describe, JobNamesEveryKeyOfEverySection) {
    const std::string text = describe_job();
    for (const schema::SectionInfo& section : schema::sections())
        EXPECT_NE(text.find(std::string("\n") + section.heading), std::string::npos)
            << section.heading;
    for (const schema::Key& key : schema::key_table())
        EXPECT_NE(text.find(std::string("\n  ") + key.key + " "), std::string::npos)
            << key.key;
    EXPECT_NE(text.find("\n  u_value "), std::string::npos);
}

TEST(Describe, ParametersNamesEveryNumberOfABuilding) {
    const std::string text = describe_parameters();
    for (const physics::Field& field : physics::fields())
        EXPECT_NE(text.find(std::string(".") + field.key + " "), std::string::npos)
            << field.key;
}

}  // namespace
}  // namespace bemcal::job
