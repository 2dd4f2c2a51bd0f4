/// Pages of a result's loops: scripts/loop_report, in a process of its own, writes one
/// for each building. A result without its page is complete; what stood in the way is
/// said, and how to make the page.
#pragma once

#include "study/summary.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::run {

/// "BUILDING/STUDY" of everything that has a page.
std::vector<std::string> loops_in(const std::vector<study::Summary>& found);

struct PageWriter {
    /// scripts/loop_report; none: it was not found
    std::optional<std::filesystem::path> script;
    std::filesystem::path python = "/usr/bin/python3";

    /// As pages_of names them.
    /// \return a line for each: that it was written, or how to make it
    std::vector<std::string> write(const std::filesystem::path& result,
                                   const std::vector<std::string>& loops) const;
    /// RESULT.html of a stock, by scripts/stock_report, with the nights of its history.
    std::string write_stock(const std::filesystem::path& result,
                            const std::filesystem::path& history) const;
};

}  // namespace bemcal::run
