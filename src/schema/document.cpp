/// Parses TOML into a tree of nodes with line numbers, in the order of the file.
/// Source: TOML, by toml++, behind two guards: letters beyond ASCII outside quotes are
/// refused, and failed assertions of the parser become messages.
/// What keys mean, their defaults and ranges are left to `schema` and `section`.
#include "schema/document.hpp"

#include "base/byte_order_mark.hpp"
#include "base/error.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
// The parser asserts what some texts do not hold (a key that begins with an odd
// character). Those must end as messages, not as aborts.
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : bemcal::schema::parser_gave_up())
namespace bemcal::schema {
struct ParserGaveUp {};
[[noreturn]] static void parser_gave_up() {
    throw ParserGaveUp();
}
}  // namespace bemcal::schema
#include <toml++/toml.h>

namespace bemcal::schema {

namespace {

int line_of(const toml::source_region& source) {
    return static_cast<int>(source.begin.line);
}

Node convert(const toml::node& from);

void convert_table(const toml::table& table, Node& node) {
    node.kind = Node::Kind::table;
    for (auto&& [key, value] : table) {
        node.entries.push_back(
            {std::string(key.str()), line_of(key.source()), convert(value)});
    }
    // The parser sorts by name; the order of the file is the one that the user wrote.
    std::stable_sort(node.entries.begin(), node.entries.end(),
                     [](const Entry& a, const Entry& b) { return a.line < b.line; });
}

void convert_array(const toml::array& array, Node& node) {
    node.kind = Node::Kind::array;
    for (const toml::node& value : array)
        node.entries.push_back({"", line_of(value.source()), convert(value)});
}

void convert_date(const toml::node& from, Node& node) {
    std::ostringstream out;
    from.visit([&](const auto& value) {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (toml::is_date<Value> || toml::is_date_time<Value> ||
                      toml::is_time<Value>)
            out << value.get();
    });
    node.kind = Node::Kind::date;
    node.text = out.str();
}

Node convert(const toml::node& from) {
    Node node;
    node.line = line_of(from.source());
    if (const auto* table = from.as_table()) {
        convert_table(*table, node);
    } else if (const auto* array = from.as_array()) {
        convert_array(*array, node);
    } else if (const auto* text = from.as_string()) {
        node.kind = Node::Kind::text;
        node.text = text->get();
    } else if (const auto* flag = from.as_boolean()) {
        node.kind = Node::Kind::flag;
        node.number = flag->get() ? 1 : 0;
    } else if (const auto number = from.value<double>(); number && from.is_number()) {
        node.kind = Node::Kind::number;
        node.number = *number;
        node.is_integer = from.is_integer();
    } else if (const auto* integer = from.as_integer()) {
        node.kind = Node::Kind::number;  // too large for a double to hold exactly
        node.number = static_cast<double>(integer->get());
        node.is_integer = true;
    } else {
        convert_date(from, node);
    }
    return node;
}

/// Letters beyond ASCII may stand in quotes and comments only; the parser's table of
/// blanks (toml++ 3.3, is_non_ascii_horizontal_whitespace) is undefined for some of them
/// elsewhere. Quotes are followed line by line: that of a text over several lines is not.
void check_ascii(std::string_view text, const std::string& file) {
    int line = 1;
    char quote = 0;
    bool comment = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\n') {
            ++line;
            quote = 0;
            comment = false;
        } else if (!comment && quote == 0 && (static_cast<unsigned char>(c) > 127)) {
            throw UserError(ExitCode::config,
                            fmt::format("{}:{}: a letter beyond ASCII outside quotes; "
                                        "expected texts in \"quotes\"",
                                        file, line));
        } else if (quote == '"' && c == '\\') {
            ++i;
        } else if (quote != 0) {
            if (c == quote) quote = 0;
        } else if (!comment && (c == '"' || c == '\'')) {
            quote = c;
        } else if (c == '#') {
            comment = true;
        }
    }
}

/// The text with every byte beyond ASCII as two hexadecimal digits.
std::string in_ascii(std::string_view text) {
    std::string ascii;
    ascii.reserve(text.size());
    for (const char c : text)
        if (const auto byte = static_cast<unsigned char>(c); byte > 127)
            fmt::format_to(std::back_inserter(ascii), "{:02x}", byte);
        else
            ascii += c;
    return ascii;
}

/// Parsed twice: what is wrong with the syntax is found in ASCII alone, since the parser
/// looks letters up in that same table when it words an error.
toml::table parse(std::string_view text, const std::string& file) {
    text = without_byte_order_mark(text);
    check_ascii(text, file);
    static_cast<void>(toml::parse(in_ascii(text), file));
    return toml::parse(text, file);
}

}  // namespace

const char* name_of(Node::Kind kind) {
    switch (kind) {
        case Node::Kind::table:
            return "a table";
        case Node::Kind::array:
            return "a list";
        case Node::Kind::text:
            return "a text";
        case Node::Kind::number:
            return "a number";
        case Node::Kind::flag:
            return "true or false";
        case Node::Kind::date:
            return "a date";
    }
    return "";
}

Node parse_document(std::string_view text, const std::string& file) {
    try {
        return convert(parse(text, file));
    } catch (const toml::parse_error& error) {
        throw UserError(ExitCode::config,
                        fmt::format("{}:{}: {}; expected TOML (key = value, [section])",
                                    file, line_of(error.source()), error.description()));
    } catch (const ParserGaveUp&) {
        throw UserError(
            ExitCode::config,
            fmt::format("{}: is not TOML: a key has no name or begins with an odd "
                        "character; expected TOML (key = value, [section])",
                        file));
    }
}

}  // namespace bemcal::schema
