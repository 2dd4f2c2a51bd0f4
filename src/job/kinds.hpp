/// The kinds of study: ONE table, a row for each, in the order of `describe job`.
#pragma once

#include "job/kind.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::job {

std::span<const Kind* const> kinds();

/// The kind with that word, or nullptr.
const Kind* find_kind(std::string_view word);

/// "a, b or c": the words of the kinds for which it is true.
std::string words_of_kinds(bool (*is_meant)(const Kind&));

/// `kind` and `name`, which every [[study]] has.
const schema::Table& common_table();
/// The sections and keys of a kind's [[study]], the common ones first.
const schema::Table& table_of(const Kind& kind);

/// A [[study]], opened with the keys of its kind.
struct OpenStudy {
    const Kind* kind;
    schema::Section section;
};
/// \param file  must outlive what is returned, as the node must
/// \param mistakes  keeps them; nullptr: the first one is thrown
/// Throws UserError for a kind that is none, and for a key that is not the kind's.
OpenStudy open_study(const schema::Node& node, const std::string& file,
                     schema::Mistakes* mistakes = nullptr);
/// All of a job, in the order of the file.
std::vector<OpenStudy> open_studies(const schema::Section& root);

}  // namespace bemcal::job
