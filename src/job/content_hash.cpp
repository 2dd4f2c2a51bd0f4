/// Hashes the tree of a job's document, tables by the names of their keys.
/// Follows from schema/document. Two spellings of one number are one; defaults that are
/// written out are not left out.
#include "job/content_hash.hpp"

#include "base/hash.hpp"
#include "schema/document.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace bemcal::job {
namespace {

using schema::Entry, schema::Node;

constexpr std::array<std::string_view, 9> how_a_night_runs = {
    "stock.budget",      "stock.hours",        "stock.drift_value",
    "stock.drift_error", "stock.keep_results", "stock.false_alarms",
    "stock.table",       "output.file",        "output.max_failed_share"};

/// A table is what stands in it: one of such keys alone says nothing.
void add(const Node& node, const std::string& path, Hasher& hasher) {
    if (std::ranges::find(how_a_night_runs, path) != how_a_night_runs.end()) return;
    if (node.kind != Node::Kind::table) {
        hasher.add(std::string_view(path));
        hasher.add(std::string_view(schema::name_of(node.kind)));
        hasher.add(std::string_view(node.text));
        hasher.add(std::span(&node.number, 1));
    }
    std::vector<const Entry*> entries;
    entries.reserve(node.entries.size());
    for (const Entry& entry : node.entries) entries.push_back(&entry);
    if (node.kind == Node::Kind::table)
        std::ranges::sort(entries, {}, [](const Entry* entry) { return entry->key; });
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const std::string& key = entries[k]->key;
        const std::string own = key.empty() ? std::to_string(k) : key;
        add(entries[k]->node, path.empty() ? own : fmt::format("{}.{}", path, own),
            hasher);
    }
}

}  // namespace

std::string content_hash(std::string_view text, const std::string& file) {
    Hasher hasher;
    add(schema::parse_document(text, file), "", hasher);
    return hasher.hex();
}

}  // namespace bemcal::job
