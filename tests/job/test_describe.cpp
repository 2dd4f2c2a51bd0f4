/// The two references: complete, and the tables behind them sound.
#include "job/kinds.hpp"
#include "schema/schema.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace bemcal::job {
namespace {

/// The job's table, then one for each kind of study.
std::vector<const schema::Table*> all_tables() {
    std::vector<const schema::Table*> tables{&schema::job_table()};
    for (const Kind* kind : kinds()) tables.push_back(&table_of(*kind));
    return tables;
}

template <class Look>
void look_at_every_key(Look look) {
    for (const schema::Table* table : all_tables())
        for (const schema::SectionInfo& section : table->sections())
            for (const schema::Key& key : table->keys_of(section.name)) look(key);
}

std::vector<schema::Key> declared_keys_of(const Kind& kind) {
    std::vector<schema::Key> keys;
    for (const auto& part : kind.keys) keys.insert(keys.end(), part.begin(), part.end());
    return keys;
}

TEST(Schema, EveryRowBelongsToASectionAndStandsThereOnce) {
    for (const schema::Key& key : schema::declared_keys())
        EXPECT_NE(schema::job_table().find(key.section), nullptr) << key.key;
    for (const Kind* kind : kinds())
        for (const schema::Key& key : declared_keys_of(*kind))
            EXPECT_NE(table_of(*kind).find(key.section), nullptr)
                << kind->word << " " << key.key;
    for (const schema::Table* table : all_tables())
        for (const schema::SectionInfo& section : table->sections()) {
            std::set<std::string> keys;
            for (const schema::Key& key : table->keys_of(section.name))
                EXPECT_TRUE(keys.insert(key.key).second)
                    << section.heading << "." << key.key;
        }
}

TEST(Schema, EveryRangeIsInOrderAndEveryDefaultOfAChoiceIsOneOfItsWords) {
    look_at_every_key([](const schema::Key& key) {
        EXPECT_LE(key.least, key.most) << key.key;
        if (key.type != schema::Type::choice || key.fallback == nullptr ||
            *key.fallback == '\0')
            return;
        const std::vector<std::string> words = schema::choices_of(key);
        EXPECT_NE(std::find(words.begin(), words.end(), key.fallback), words.end())
            << key.key;
    });
}

TEST(Describe, JobNamesEveryKeyOfEverySection) {
    const std::string text = describe_job();
    for (const schema::Table* table : all_tables())
        for (const schema::SectionInfo& section : table->sections())
            EXPECT_NE(text.find(std::string("\n") + section.heading + "\n"),
                      std::string::npos)
                << section.heading;
    look_at_every_key([&](const schema::Key& key) {
        EXPECT_NE(text.find(std::string("\n  ") + key.key + " "), std::string::npos)
            << key.key;
    });
    EXPECT_NE(text.find("\n  u_value "), std::string::npos);
}

TEST(Describe, JobHasASectionForEachKindWithThatKindsKeysAlone) {
    const std::string text = describe_job();
    for (const Kind* kind : kinds()) {
        const std::string heading =
            std::string("\n[[study]] kind = \"") + kind->word + "\"\n";
        const std::size_t begin = text.find(heading);
        ASSERT_NE(begin, std::string::npos) << kind->word;
        const std::string section =
            text.substr(begin, text.find("\n  Example:\n", begin) + 1 - begin);
        const auto lines = std::count(section.begin(), section.end(), '\n');
        // A blank line, heading and sentence; without `kind` and `name`.
        EXPECT_EQ(lines, static_cast<long>(table_of(*kind).keys_of("study").size()) + 1)
            << section;
    }
}

TEST(Describe, ParametersNamesEveryNumberOfABuilding) {
    const std::string text = describe_parameters();
    for (const physics::Field& field : physics::fields())
        EXPECT_NE(text.find(std::string(".") + field.key + " "), std::string::npos)
            << field.key;
    for (const char* path :
         {"construction.NAME.layer.NAME.thickness", "zone.NAME.radiator.",
          "zone.NAME.load.NAME.density", "meter.QUANTITY.", "effect.NAME"})
        EXPECT_NE(text.find(path), std::string::npos) << path;
}

}  // namespace
}  // namespace bemcal::job
