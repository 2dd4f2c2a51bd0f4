/// A TOML text as a plain tree with line numbers, so that only document.cpp knows the
/// parser.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bemcal::schema {

struct Entry;

struct Node {
    enum class Kind { table, array, text, number, flag, date };
    Kind kind = Kind::table;
    int line = 0;
    std::string text;   ///< of a text; of a date in ISO form
    double number = 0;  ///< of a number; 0 or 1 of a flag
    bool is_integer = false;
    std::vector<Entry> entries;  ///< of a table, in the order of the file; of an array
    /// The schema's section that it was read by, and whether it was read at all.
    mutable const char* section = nullptr;
    mutable bool used = false;
};

struct Entry {
    std::string key;  ///< empty in an array
    int line = 0;
    Node node;
};

const char* name_of(Node::Kind kind);  ///< "a table", "a text", ...

/// Throws UserError (config) with file:line where the text is not TOML.
Node parse_document(std::string_view text, const std::string& file);

}  // namespace bemcal::schema
