/// Reads a section of a job file through the schema: typed values, defaults, ranges, and
/// errors that name file, line and key.
/// Follows from pbrt's rule: an unknown key, or one that nobody asked for, is an error.
/// Rules between keys are left to the readers; names of periods and the like are free.
#include "schema/section.hpp"

#include "base/error.hpp"
#include "input/suggest.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::schema {

namespace {

[[noreturn]] void fail_config(const std::string& message) {
    throw UserError(ExitCode::config, message);
}

double parsed_default(const Key& row) {
    const std::string_view text = row.fallback;
    if (text == "inf") return physics::unlimited;
    double value = std::nan("");
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

bool is_top(std::string_view section) {
    return section == "job" || section == "building";
}

std::string path_below(std::string_view section, std::string_view key) {
    if (is_top(section)) return std::string(key);
    return key.empty() ? std::string(section) : fmt::format("{}.{}", section, key);
}

/// What the key means, at the end of a message.
std::string more_on(const Key& row) {
    std::string_view sentence = row.sentence;
    if (sentence.ends_with('.')) sentence.remove_suffix(1);
    return sentence.empty() ? "" : fmt::format(" ({})", sentence);
}

}  // namespace

Section::Section(const Node& node, const char* schema, const std::string& file,
                 std::string shown, const Table& table, Mistakes* mistakes)
    : node_(&node),
      schema_(schema),
      file_(&file),
      shown_(shown.empty() ? std::string(schema) : std::move(shown)),
      table_(&table),
      mistakes_(mistakes) {
    if (node.kind != Node::Kind::table)
        fail_config(fmt::format("{}:{}: {} = {}: expected a section with keys", file,
                                node.line, schema, written(node)));
    node.section = schema;
    node.used = true;
    if (table.find(schema) == nullptr)
        throw std::logic_error(fmt::format("no section {}", schema));
    is_known_ = std::ranges::none_of(
        node.entries, [&](const Entry& entry) { return is_unknown(entry); });
    check_known();
    check_values();
}

std::string Section::path_of(std::string_view key) const {
    return path_below(shown_, key);
}

bool Section::is_unknown(const Entry& entry) const {
    return !table_->find(schema_)->takes_any_key &&
           table_->find(schema_, entry.key) == nullptr;
}

/// At the top, all of the kind that an unknown key may stand for is lost.
void Section::check_known() const {
    if (is_known_) return;
    std::vector<std::string> known;
    for (const Key& key : table_->keys_of(schema_)) known.emplace_back(key.key);
    for (const Entry& entry : node_->entries) {
        if (!is_unknown(entry)) continue;
        attempt([&] {
            fail_config(fmt::format("{}:{}: {}: unknown key{}", *file_, entry.line,
                                    path_of(entry.key),
                                    input::suggestion(entry.key, known)));
        });
        mistakes_->lose(entry.node);
        if (is_top(schema_)) mistakes_->lose(input::nearest(entry.key, known));
    }
}

/// An unknown key may be any of those that are missing; but at the top it is a section,
/// and the others are read without it.
void Section::check_is_missing() const {
    if (!is_top(schema_) && !is_known_) throw Follows();
}

/// Reads a value as its row wants it, for its mistake alone.
void Section::look_at(const Key& row) const {
    switch (row.type) {
        case Type::number:
        case Type::integer:
            number(row.key);
            break;
        case Type::numbers:
            numbers(row.key);
            break;
        case Type::flag:
            flag(row.key);
            break;
        case Type::choice:
            choice(row.key);
            break;
        case Type::input:
            if (find(row.key)->node.kind == Node::Kind::number) number(row.key);
            break;
        default:  // what is in it is seen when it is opened or used
            break;
    }
}

/// Where mistakes are kept, those in the values of one section are told together.
void Section::check_values() {
    if (mistakes_ == nullptr) return;
    for (const Entry& entry : node_->entries) {
        const Key* row = table_->find(schema_, entry.key);
        if (row == nullptr) continue;
        const bool was_used = entry.node.used;
        const bool is_right = attempt([&] { look_at(*row); });
        entry.node.used = was_used || !is_right;
        if (!is_right) wrong_.push_back(&entry);
    }
}

void Section::check_is_right(const Entry& entry) const {
    if (std::ranges::find(wrong_, &entry) != wrong_.end()) throw Follows();
}

const Entry* Section::find(std::string_view key) const {
    for (const Entry& entry : node_->entries)
        if (entry.key == key) return &entry;
    return nullptr;
}

bool Section::has(std::string_view key) const {
    if (find(key) != nullptr) return true;
    check_is_missing();
    return false;
}

const Key& Section::row(std::string_view key) const {
    const Key* row = table_->find(schema_, key);
    if (row == nullptr) throw std::logic_error(fmt::format("no row {}.{}", schema_, key));
    return *row;
}

std::string Section::place(std::string_view key) const {
    const Entry* entry = key.empty() ? nullptr : find(key);
    return fmt::format("{}:{}", *file_,
                       std::max(entry != nullptr ? entry->line : node_->line, 1));
}

std::filesystem::path Section::path(const std::string& name) const {
    return std::filesystem::path(*file_).parent_path() / name;
}

/// What has no right name may be meant by any name of its kind.
void Section::note_name(std::string_view key) const {
    if (mistakes_ == nullptr || key != "name") return;
    const std::string_view schema = schema_;
    mistakes_->lose(std::string(schema.substr(schema.rfind('.') + 1)));
}

void Section::fail(std::string_view key, const std::string& message) const {
    note_name(key);
    fail_config(fmt::format("{}: {}: {}", place(key), path_of(key), message));
}

void Section::fail_value(std::string_view key, const std::string& message) const {
    const Entry* entry = find(key);
    if (entry == nullptr) fail(key, message);
    note_name(key);
    fail_config(fmt::format("{}: {} = {}: {}", place(key), path_of(key),
                            written(entry->node), message));
}

const Node& Section::node(std::string_view key) const {
    const Entry* entry = find(key);
    if (entry == nullptr && is_top(schema_) && is_lost(std::string(key)))
        throw Follows();  // it stands there by an unknown name
    if (entry == nullptr) {
        note_name(key);
        check_is_missing();
        fail(key, fmt::format("is missing; expected {}{}", expectation(row(key)),
                              more_on(row(key))));
    }
    check_is_right(*entry);
    entry->node.used = true;
    return entry->node;
}

double Section::number(std::string_view key) const {
    const Key& wanted = row(key);
    if (wanted.fallback != nullptr && !has(key)) return parsed_default(wanted);
    return checked_number(node(key), wanted, where(key));
}

long long Section::integer(std::string_view key) const {
    return static_cast<long long>(number(key));
}

bool Section::flag(std::string_view key) const {
    if (!has(key)) return std::string_view(row(key).fallback) == "true";
    const Node& value = node(key);
    if (value.kind != Node::Kind::flag) fail_value(key, "expected true or false");
    return value.number != 0;
}

std::string Section::text(std::string_view key) const {
    const Key& wanted = row(key);
    if (wanted.fallback != nullptr && !has(key)) return wanted.fallback;
    const Node& value = node(key);
    const bool is_date = wanted.type == Type::date && value.kind == Node::Kind::date;
    if (value.kind != Node::Kind::text && !is_date)
        fail_value(key, fmt::format("expected {}", expectation(wanted)));
    if (value.text.empty()) fail_value(key, "is empty");
    return value.text;
}

std::string Section::choice(std::string_view key) const {
    const std::string word = text(key);
    if (!word.empty()) choice_index(key);
    return word;
}

int Section::choice_index(std::string_view key) const {
    const std::vector<std::string> words = choices_of(row(key));
    const std::string word = text(key);
    for (std::size_t i = 0; i < words.size(); ++i)
        if (words[i] == word) return static_cast<int>(i);
    fail_value(key, fmt::format("expected {}{}", expectation(row(key)),
                                input::nearest(word, words).empty()
                                    ? ""
                                    : input::suggestion(word, words)));
}

std::vector<double> Section::numbers(std::string_view key) const {
    std::vector<double> values;
    if (row(key).fallback != nullptr && !has(key)) return values;
    const Node& list = node(key);
    if (list.kind != Node::Kind::array)
        fail_value(key, fmt::format("expected {}", expectation(row(key))));
    for (const Entry& entry : list.entries)
        values.push_back(checked_number(entry.node, row(key), where(key)));
    return values;
}

std::vector<std::string> Section::texts(std::string_view key) const {
    std::vector<std::string> values;
    const Key* wanted =
        table_->find(schema_, key);  // none for a period of the user's own name
    if (wanted != nullptr && wanted->fallback != nullptr && !has(key)) return values;
    const Node& list = node(key);
    const auto take = [&](const Node& item) {
        if (item.kind != Node::Kind::text && item.kind != Node::Kind::date)
            fail_value(key,
                       fmt::format("expected a list of texts, not {}", written(item)));
        values.push_back(item.text);
    };
    if (list.kind != Node::Kind::array) {
        take(list);
    } else {
        for (const Entry& entry : list.entries) take(entry.node);
    }
    return values;
}

std::vector<const Node*> Section::words(std::string_view key) const {
    std::vector<const Node*> values;
    if (!has(key)) return values;
    const Node& list = node(key);
    const auto take = [&](const Node& item) {
        if (item.kind != Node::Kind::text && item.kind != Node::Kind::number)
            fail_value(key,
                       fmt::format("expected texts and numbers, not {}", written(item)));
        values.push_back(&item);
    };
    if (list.kind != Node::Kind::array) {
        take(list);
    } else {
        for (const Entry& entry : list.entries) take(entry.node);
    }
    return values;
}

const Table& Section::table_with(const char* schema) const {
    return table_->find(schema) != nullptr ? *table_ : job_table();
}

Section Section::table(std::string_view key, const char* schema) const {
    return {node(key), schema, *file_, path_of(key), table_with(schema), mistakes_};
}

std::vector<const Node*> Section::list_of_tables(std::string_view key) const {
    std::vector<const Node*> list;
    if (row(key).fallback != nullptr && !has(key)) return list;
    const Node& value = node(key);
    if (value.kind == Node::Kind::table)
        fail(key,
             fmt::format("expected a list of sections; write [[{}]] with two brackets",
                         path_of(key)));
    if (value.kind != Node::Kind::array)
        fail_value(key, fmt::format("expected {}", expectation(row(key))));
    for (const Entry& entry : value.entries) list.push_back(&entry.node);
    return list;
}

std::vector<Section> Section::tables(std::string_view key, const char* schema) const {
    std::vector<Section> list;
    for (const Node* node : list_of_tables(key))
        list.push_back(section_of(*node, schema));
    return list;
}

Section Section::section_of(const Node& node, const char* schema) const {
    return {node, schema, *file_, "", table_with(schema), mistakes_};
}

void Section::skip(std::string_view key) const {
    if (mistakes_ == nullptr) return;
    mistakes_->lose(std::string(key));
    if (const Entry* entry = find(key)) mistakes_->lose(entry->node);
}

double checked_number(const Node& value, const Key& row, const std::string& where) {
    const auto wrong = [&](const std::string& why) {
        fail_config(fmt::format("{} = {}: {}", where, written(value), why));
    };
    if (value.kind != Node::Kind::number)
        wrong(fmt::format("expected {}", expectation(row)));
    if (row.type == Type::integer && !value.is_integer)
        wrong(fmt::format("expected {}", expectation(row)));
    if (std::isnan(value.number)) wrong(fmt::format("expected {}", expectation(row)));
    if (value.number < row.least || value.number > row.most)
        wrong(fmt::format("expected {}{}", expectation(row), more_on(row)));
    return value.number;
}

std::string plain(double number) {
    const bool whole = std::abs(number) < 1e15 && number == std::floor(number);
    return whole ? fmt::format("{:.0f}", number) : fmt::format("{:g}", number);
}

std::string written(const Node& node) {
    switch (node.kind) {
        case Node::Kind::table:
            return "{...}";
        case Node::Kind::array:
            return "[...]";
        case Node::Kind::flag:
            return node.number != 0 ? "true" : "false";
        case Node::Kind::number:
            return fmt::format("{}", node.number);
        case Node::Kind::date:
            return node.text;
        case Node::Kind::text:
            break;
    }
    return node.text.size() > 60 ? fmt::format("\"{}...\"", node.text.substr(0, 57))
                                 : fmt::format("\"{}\"", node.text);
}

namespace {

void check_used(const Section& root, const Node& node) {
    for (const Entry& entry : node.entries) {
        if (!entry.node.used && node.section != nullptr)
            root.attempt([&] {
                fail_config(fmt::format(
                    "{}:{}: {}: has no effect here, because of the values of other keys "
                    "or because nothing refers to it; remove it",
                    root.file(), entry.line, path_below(node.section, entry.key)));
            });
        check_used(root, entry.node);
    }
}

}  // namespace

void check_all_used(const Section& root) {
    check_used(root, root.root());
}

}  // namespace bemcal::schema
