/// Hashes the tree of a job's document, tables by the names of their keys.
/// Follows from schema/document. Two spellings of one number are one; defaults that are
/// written out are not left out.
#include "job/content_hash.hpp"

#include "base/hash.hpp"
#include "schema/document.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace bemcal::job {
namespace {

using schema::Entry, schema::Node;

constexpr std::array<std::string_view, 9> how_a_night_runs = {
    "stock.budget",      "stock.hours",        "stock.drift_value",
    "stock.drift_error", "stock.keep_results", "stock.false_alarms",
    "stock.table",       "max_failed_share",   "output.file"};

void add(const Node& node, const std::string& path, Hasher& hasher) {
    hasher.add(std::string_view(schema::name_of(node.kind)));
    hasher.add(std::string_view(node.text));
    hasher.add(std::span(&node.number, 1));
    std::vector<const Entry*> entries;
    entries.reserve(node.entries.size());
    for (const Entry& entry : node.entries) entries.push_back(&entry);
    if (node.kind == Node::Kind::table)
        std::ranges::sort(entries, {}, [](const Entry* entry) { return entry->key; });
    for (const Entry* entry : entries) {
        const std::string at = path.empty() ? entry->key : path + "." + entry->key;
        if (std::ranges::find(how_a_night_runs, at) != how_a_night_runs.end()) continue;
        hasher.add(std::string_view(entry->key));
        add(entry->node, at, hasher);
    }
}

}  // namespace

std::string content_hash(std::string_view text, const std::string& file) {
    Hasher hasher;
    add(schema::parse_document(text, file), "", hasher);
    return hasher.hex();
}

}  // namespace bemcal::job
