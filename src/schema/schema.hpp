/// The job file's schema: declared tables, from which reading, checking, defaults, error
/// messages and `describe job` all come. One is of the job and its buildings; each kind
/// of study has one of its own, beside its reader (job/kind.hpp).
///
/// The numbers of a building (U-values, set-points, ...) are rows of physics::fields();
/// they join the job's table here. Sections are named as in the file: "zone.window" is
/// [[zone.window]].
#pragma once

#include "physics/parameters.hpp"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::schema {

enum class Type {
    number,  ///< within [least, most]
    integer,
    flag,  ///< true or false
    text,
    choice,   ///< one of the words in `unit`, separated by |
    date,     ///< 2021-03-05, in quotes or not
    numbers,  ///< a list
    texts,    ///< a list, or one alone
    words,    ///< texts and numbers, a list or one alone
    day,      ///< a number, or 24 of them, hour by hour
    input,    ///< a number, {value, low, schedule} or {series, value}
    table,    ///< a section of its own
    tables,   ///< [[...]], a list of them
};

inline constexpr const char* required = nullptr;  ///< as a key's fallback

struct Key {
    const char* section;
    const char* key;
    Type type;
    const char* unit;      ///< of numbers; the words of a choice; "" = none
    const char* fallback;  ///< as it would be written; or `required`; "" = left out
    double least, most;    ///< range of numbers
    const char* sentence;
};

struct SectionInfo {
    const char* name;
    const char* heading;   ///< as in the file
    const char* includes;  ///< another section whose keys it has too, or ""
    const char* sentence;
    bool takes_any_key = false;  ///< beside those that it has a row for
};

/// Sections and their keys, looked up by name.
class Table {
  public:
    Table(std::vector<SectionInfo> sections, std::span<const Key> keys);

    const std::vector<SectionInfo>& sections() const { return sections_; }
    /// nullptr where there is no such section.
    const SectionInfo* find(std::string_view section) const;
    /// Its own rows, then those of the section that it includes.
    const std::vector<Key>& keys_of(std::string_view section) const;
    /// The row of a key, or nullptr.
    const Key* find(std::string_view section, std::string_view key) const;

  private:
    std::vector<SectionInfo> sections_;
    std::map<std::string, std::vector<Key>, std::less<>> keys_;
};

/// Of a job and its buildings, with the buildings' fields.
const Table& job_table();

/// Its rows as they are declared: sections, keys, keys of [simulator].
std::span<const SectionInfo> declared_sections();
std::span<const Key> declared_keys();
std::span<const Key> simulator_keys();

/// The row of a key in the job's table, or nullptr.
const Key* find_key(std::string_view section, std::string_view key);

std::vector<std::string> choices_of(const Key& key);
/// "0 to 20 1/h", "a whole number from 1 on", "one of epw, csv", "a text", ...
std::string expectation(const Key& key);

/// The section of a part of a building: "zone.window" for a window.
const char* section_of(physics::Part part);

}  // namespace bemcal::schema
