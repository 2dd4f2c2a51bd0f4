/// A section of a job file, read through the schema: typed values, defaults, and errors
/// that name file, line and key.
///
/// Unknown keys and values out of range are mistakes when the section is opened. Where
/// mistakes are kept, a value that is wrong, or a key that an unknown one may stand for,
/// ends only the step that asks for it. Every look-up marks the key as used;
/// `check_all_used` then finds those that nobody asked for (pbrt's rule: a key without
/// effect is an error, not a silence).
#pragma once

#include "schema/document.hpp"
#include "schema/mistakes.hpp"
#include "schema/schema.hpp"

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace bemcal::schema {

class Section {
  public:
    /// \param node  a table; another kind is an error. Both it and `file` must outlive
    /// this.
    /// \param shown  what messages call the section; the schema's name where it is empty
    /// \param table  that has the section and those in it; what it lacks is the job's
    /// \param mistakes  keeps those in the section and in what it holds, and must outlive
    /// them; nullptr: the first one is thrown
    Section(const Node& node, const char* schema, const std::string& file,
            std::string shown = "", const Table& table = job_table(),
            Mistakes* mistakes = nullptr);

    /// Follows where it is not there and an unknown key may stand for it.
    bool has(std::string_view key) const;
    double number(std::string_view key) const;
    long long integer(std::string_view key) const;
    bool flag(std::string_view key) const;
    std::string text(std::string_view key) const;
    std::string choice(std::string_view key) const;
    std::vector<double> numbers(std::string_view key) const;
    std::vector<std::string> texts(std::string_view key) const;
    /// Texts and numbers as written, of a list or one alone; none where it is left out.
    std::vector<const Node*> words(std::string_view key) const;
    Section table(std::string_view key, const char* schema) const;
    std::vector<Section> tables(std::string_view key, const char* schema) const;
    /// Calls `read` with each section of a list; a mistake in one does not keep it from
    /// the others. \return whether all went well
    template <class Read>
    bool each(std::string_view key, const char* schema, Read read) const {
        bool is_whole = true;
        for (const Node* node : list_of_tables(key))
            is_whole &= attempt_on(*node, [&] { read(section_of(*node, schema)); });
        return is_whole;
    }
    /// The same, unopened: for sections whose keys depend on what stands in them.
    std::vector<const Node*> list_of_tables(std::string_view key) const;
    /// The value as written, marked as used; a missing one is an error.
    const Node& node(std::string_view key) const;

    /// The choice as an enumerator; the words stand in the order of the enumeration.
    template <class Enum>
    Enum choice_as(std::string_view key) const {
        return static_cast<Enum>(choice_index(key));
    }
    /// The value if it is there.
    template <class Value>
    void number_if(std::string_view key, Value& value) const {
        if (has(key)) value = static_cast<Value>(number(key));
    }

    /// Does the work, and keeps its mistake: what stands at the keys counts as not read.
    /// \return whether it went well
    template <class Work>
    bool attempt(Work work, std::initializer_list<const char*> keys = {}) const {
        if (mistakes_ == nullptr) {
            work();
            return true;
        }
        if (mistakes_->keep(work)) return true;
        for (const char* key : keys) skip(key);
        return false;
    }
    /// Steps that do not need each other: a mistake in one does not keep the others from
    /// being done. What comes next needs all: it Follows where one did not go well.
    template <class... Works>
    void attempt_all(Works... works) const {
        bool is_whole = true;
        ((is_whole &= attempt(works)), ...);
        if (!is_whole) throw Follows();
    }
    /// The same with one step for each of a list.
    template <class List, class Work>
    void attempt_each(const List& list, Work work) const {
        bool is_whole = true;
        for (const auto& item : list) is_whole &= attempt([&] { work(item); });
        if (!is_whole) throw Follows();
    }
    /// The same for a section of a list.
    template <class Work>
    bool attempt_on(const Node& node, Work work) const {
        if (attempt(work)) return true;
        mistakes_->lose(node);
        return false;
    }
    /// What stands at the key is not read, because of another mistake.
    void skip(std::string_view key) const;
    /// Whether a name, or a path such as "zone.office", may be that of something that
    /// could not be read. What fails because of it then `Follows`.
    bool is_lost(const std::string& path) const {
        return mistakes_ != nullptr && mistakes_->is_lost(path);
    }
    /// Failures so far, of the whole job.
    std::size_t n_failures() const {
        return mistakes_ == nullptr ? 0 : mistakes_->n_failures();
    }
    Mistakes* mistakes() const { return mistakes_; }
    /// Whether the schema has each of its keys.
    bool is_known() const { return is_known_; }

    /// Throws UserError (config): "file:line: section.key: message".
    [[noreturn]] void fail(std::string_view key, const std::string& message) const;
    /// The same with the value: "file:line: section.key = value: message".
    [[noreturn]] void fail_value(std::string_view key, const std::string& message) const;
    /// Fails with the message at the first of the keys that is there; they are one
    /// mistake.
    template <class Keys = std::initializer_list<const char*>>
    void refuse(const Keys& keys, const std::string& message) const {
        for (const char* key : keys)
            if (has(key)) fail(key, message);
    }
    /// "file:line: section.key".
    std::string where(std::string_view key) const {
        return place(key) + ": " + path_of(key);
    }
    /// "file:line" of a key, or of the section where it is not there.
    std::string place(std::string_view key = "") const;

    const std::string& file() const { return *file_; }
    /// "zone.surface.area": how messages call a key.
    std::string path_of(std::string_view key) const;
    /// A file that the section names: beside its own file, unless the path is absolute.
    std::filesystem::path path(const std::string& name) const;
    const Node& root() const { return *node_; }
    const char* schema() const { return schema_; }

  private:
    const Entry* find(std::string_view key) const;
    const Key& row(std::string_view key) const;
    int choice_index(std::string_view key) const;
    void check_known() const;
    void check_values();
    void check_is_missing() const;
    void check_is_right(const Entry& entry) const;
    void look_at(const Key& row) const;
    bool is_unknown(const Entry& entry) const;
    void note_name(std::string_view key) const;
    Section section_of(const Node& node, const char* schema) const;

    const Table& table_with(const char* schema) const;

    const Node* node_;
    const char* schema_;
    const std::string* file_;
    std::string shown_;
    const Table* table_;
    Mistakes* mistakes_;
    bool is_known_ = true;
    std::vector<const Entry*> wrong_;  ///< whose values were told as mistakes
};

/// A number as the schema's row wants it; throws UserError that begins with `where`.
double checked_number(const Node& node, const Key& row, const std::string& where);

/// "20", "10000000", "0.05": a number in a message.
std::string plain(double number);

/// As a user would write it, shortened: for messages.
std::string written(const Node& node);

/// Every key that was never asked for is a mistake; the first is thrown where they are
/// not kept.
void check_all_used(const Section& root);

}  // namespace bemcal::schema
