/// Reads the keys that say which lines of a CSV file are its table and how its numbers
/// are written. Follows from the schema's rows of "source". Columns are those of `time`,
/// `column` and [weather.columns]. Leaves out clocks and gaps, which `timed_csv` reads.
#include "description/csv_form.hpp"

#include <fmt/format.h>

namespace bemcal::description {

namespace {

using Names = std::vector<std::string>;

/// A text, texts in a list, or what `column` in a table says.
void add_names(const schema::Node& node, Names& names) {
    if (node.kind == schema::Node::Kind::text) names.push_back(node.text);
    for (const schema::Entry& entry : node.entries)
        if (node.kind == schema::Node::Kind::array || entry.key == "column")
            add_names(entry.node, names);
}

void add_names(const schema::Section& section, const char* key, Names& names) {
    if (section.has(key)) add_names(section.node(key), names);
}

}  // namespace

input::CsvForm csv_form(const schema::Section& section) {
    input::CsvForm form;
    for (const char* key : {"from", "to", "time"}) add_names(section, key, form.names);
    if (!form.names.empty()) form.time = form.names.front();
    for (const char* key : {"column", "estimated"}) add_names(section, key, form.names);
    if (section.has("columns"))
        for (const schema::Entry& entry : section.node("columns").entries)
            add_names(entry.node, form.names);
    section.number_if("header_line", form.header_line);
    for (const schema::Node* node : section.words("skip"))
        if (node->kind == schema::Node::Kind::number)
            form.skip_lines.push_back(static_cast<int>(node->number));
        else
            form.skip_texts.push_back(node->text);
    return form;
}

input::NumberForm number_form(const schema::Section& section) {
    input::NumberForm form(section.choice("decimal")[0]);
    form.decimal_is_said = section.has("decimal");
    form.thousands = section.choice("thousands");
    if (form.thousands == "." && !form.decimal_is_said) form.decimal = ',';
    if (form.thousands.size() == 1 && form.thousands[0] == form.decimal)
        section.fail_value("thousands",
                           "is the decimal mark, too; set decimal to another");
    for (const schema::Node* node : section.words("missing"))
        if (node->kind == schema::Node::Kind::number)
            form.missing_numbers.push_back(node->number);
        else
            form.missing.push_back(node->text);
    return form;
}

}  // namespace bemcal::description
