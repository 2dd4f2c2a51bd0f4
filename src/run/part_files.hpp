/// The files in a folder NAME.part: which of them runs made, known by name and form, and
/// how those, and no others, are removed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bemcal::run {

constexpr const char* identity_name = "identity.txt";
constexpr const char* lock_name = "lock";
constexpr const char* result_name = "result";  ///< of the result while it is written

struct PartFiles {
    bool has_identity = false, has_logs = false;
    std::vector<std::filesystem::path> ours;     ///< but for the lock
    std::vector<std::filesystem::path> foreign;  ///< what no run made
    bool has_run() const { return has_identity || has_logs; }
};

/// Nothing where there is no such folder. Throws UserError where it cannot be read.
PartFiles part_files(const std::filesystem::path& folder);

/// Removes what runs made there, but for the lock and for `kept`. \return what could not
/// be removed, in words
std::vector<std::string> remove_part_files(
    const std::filesystem::path& folder,
    const std::vector<std::filesystem::path>& kept = {});

/// "thesis.txt, notes": names, of many the first.
std::string names_of(const std::vector<std::filesystem::path>& files);

}  // namespace bemcal::run
