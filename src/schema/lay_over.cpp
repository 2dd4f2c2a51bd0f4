/// Lays one tree over another, list by list and name by name.
/// Plain handling of trees, without a source. Lines stay those of the text that each node
/// is from, so a message may name a line of the other text.
/// Leaves out lists within a table: they are replaced as a whole.
#include "schema/lay_over.hpp"

#include <algorithm>

namespace bemcal::schema {

namespace {

Entry* find(Node& table, std::string_view key) {
    const auto at = std::ranges::find(table.entries, key, &Entry::key);
    return at == table.entries.end() ? nullptr : &*at;
}

void replace(const Entry& entry, Node& table) {
    if (Entry* there = find(table, entry.key))
        *there = entry;
    else
        table.entries.push_back(entry);
}

bool is_list_of_tables(const Node& node) {
    return node.kind == Node::Kind::array && !node.entries.empty() &&
           node.entries.front().node.kind == Node::Kind::table;
}

bool has_name(const Node& table, const std::string& name) {
    const Node* own = find_node(table, "name");
    return own != nullptr && own->text == name;
}

void lay_list(const Node& over, Node& base) {
    for (const Entry& entry : over.entries) {
        const Node* name = find_node(entry.node, "name");
        const auto there = std::ranges::find_if(base.entries, [&](const Entry& other) {
            return name != nullptr && has_name(other.node, name->text);
        });
        if (there == base.entries.end())
            base.entries.push_back(entry);
        else
            for (const Entry& key : entry.node.entries) replace(key, there->node);
    }
}

}  // namespace

const Node* find_node(const Node& table, std::string_view key) {
    const auto at = std::ranges::find(table.entries, key, &Entry::key);
    return at == table.entries.end() ? nullptr : &at->node;
}

void lay_over(const Node& over, Node& base) {
    for (const Entry& entry : over.entries) {
        Entry* there = find(base, entry.key);
        if (there != nullptr && is_list_of_tables(entry.node) &&
            is_list_of_tables(there->node))
            lay_list(entry.node, there->node);
        else
            replace(entry, base);
    }
}

}  // namespace bemcal::schema
