/// Pages with pictures of a result: scripts/result_report, in a process of its own,
/// writes one for each building. A result without its page is complete; what stood in
/// the way is said, and how to make the page.
#pragma once

#include "run/output_names.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bemcal::run {

struct PageWriter {
    /// scripts/result_report; none: it was not found
    std::optional<std::filesystem::path> script;
    std::filesystem::path python = "/usr/bin/python3";

    /// As pages_of names them; of very many buildings those of the first.
    /// \param stages  names of all stages, "BUILDING/STUDY"
    /// \return a line for each: that it was written, or how to make it
    std::vector<std::string> write(const std::filesystem::path& result,
                                   const std::vector<std::string>& stages) const;
    /// RESULT.html of a stock, by scripts/stock_report, with the nights of its history.
    std::string write_stock(const std::filesystem::path& result,
                            const std::filesystem::path& history) const;

  private:
    std::vector<std::string> words_of(const std::filesystem::path& result,
                                      const Page& page) const;
    std::string command_of(const std::filesystem::path& result, const Page& page) const;
    std::string write_page(const std::filesystem::path& result, const Page& page) const;
};

}  // namespace bemcal::run
