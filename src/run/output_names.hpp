/// The names of all that a run writes, kept apart from what it reads: a result never
/// takes the place of an input, nor does what is written beside it.
#pragma once

#include "job/job.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace bemcal::run {

/// A page with pictures.
struct Page {
    std::filesystem::path file;
    std::vector<std::string> stages;  ///< BUILDING, or studies of none; empty = all
};

/// The pages of a result with stages of these names: RESULT.html of one building; of
/// several RESULT-BUILDING.html, and RESULT.html of studies that are of no single one.
std::vector<Page> pages_of(const std::filesystem::path& result,
                           const std::vector<std::string>& stages);

struct OutputWish {
    std::filesystem::path named;  ///< -o; empty = the job's, else its name with .h5
    bool is_numbered = false;     ///< NAME-001.h5, or the next number that is free
    std::filesystem::path last_night{};  ///< read as well; may be empty
};

struct OutputNames {
    std::filesystem::path result;
    std::filesystem::path table, history, changes;  ///< of a stock
};

/// Names that follow from others avoid the inputs, and files that no run wrote: a table
/// is RESULT.csv or else RESULT-table.csv, changes RESULT-changes.csv, a history
/// TITLE-history.csv or else TITLE-history-2.csv. Throws UserError (cannot_create) where
/// the name that the user gave is an input's, by name or through links, is too long, or
/// is that of a file which is no result.
OutputNames choose_output(const job::Job& job, const OutputWish& wish);

/// RESULT.html, or RESULTSUFFIX.html.
std::filesystem::path page_of(const std::filesystem::path& result,
                              const std::string& suffix = "");

}  // namespace bemcal::run
