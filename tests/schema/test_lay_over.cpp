/// One text laid over another: which tables are one, and what is replaced.
#include "schema/lay_over.hpp"

#include <gtest/gtest.h>

namespace bemcal::schema {
namespace {

Node tree(const char* text) {
    return parse_document(text, "here.toml");
}

TEST(LayOver, MakesTablesOfANameOneAndAppendsOthers) {
    Node base = tree("[[meter]]\nname = \"gas\"\nunit = \"kWh\"\nfile = \"a.csv\"\n");
    lay_over(tree("[[meter]]\nname = \"gas\"\nunit = \"m3\"\n"
                  "[[meter]]\nname = \"heat\"\n"),
             base);
    const Node& meters = *find_node(base, "meter");
    ASSERT_EQ(meters.entries.size(), 2U);
    EXPECT_EQ(find_node(meters.entries[0].node, "unit")->text, "m3");
    EXPECT_EQ(find_node(meters.entries[0].node, "file")->text, "a.csv");
    EXPECT_EQ(find_node(meters.entries[1].node, "name")->text, "heat");
}

TEST(LayOver, ReplacesAnyOtherKeyAndAddsWhatIsNotThere) {
    Node base = tree("structure = [\"a\"]\n[periods]\ntraining = [\"1\", \"2\"]\n");
    lay_over(tree("structure = [\"b\"]\n[periods]\nother = [\"3\", \"4\"]\n"
                  "[[effect]]\nname = \"wind\"\n"),
             base);
    EXPECT_EQ(find_node(base, "structure")->entries[0].node.text, "b");
    EXPECT_EQ(find_node(*find_node(base, "periods"), "training"), nullptr);
    EXPECT_NE(find_node(base, "effect"), nullptr);
}

}  // namespace
}  // namespace bemcal::schema
