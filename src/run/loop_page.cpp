/// Pages with pictures of a result's loops or stock: a Python script in a process of its
/// own, and a line that says what was written or how to do it.
/// Plain handling of files, without a source. The script's messages are not shown; a
/// missing page is no error, one that cannot be written is.
#include "run/loop_page.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "run/output_names.hpp"
#include "run/program.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

/// Whether something stands there that a script of ours did not make. An empty file is
/// nobody's loss.
bool is_of_another(const fs::path& page) {
    std::ifstream in(page, std::ios::binary);
    std::string begin(4096, '\0');
    in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
    return !begin.empty() && begin.find("content=\"bemcal-batch\"") == std::string::npos;
}

/// Under a fresh name first. \param words  the command; one of them is the page's name
/// \return whether it is there now
bool makes(std::vector<std::string> words, const fs::path& page) {
    FreshFile fresh(folder_of(page), page.filename().string());
    std::ranges::replace(words, page.string(), fresh.path().string());
    const int code = code_of_program(std::move(words), Said::hidden);
    if (code == static_cast<int>(ExitCode::io))
        throw UserError(ExitCode::io, page.string() +
                                          ": the page cannot be written; the result is "
                                          "whole");
    if (code == 0) fresh.move_to(page, Replace::yes);
    return code == 0;
}

constexpr const char* needs = "which takes Python with h5py, matplotlib and jinja2";

/// Why there is no page.
std::string reason(const fs::path& page) {
    return is_of_another(page)
               ? page.string() + " is there already and no run wrote it; move it away"
               : needs;
}

}  // namespace

std::string PageWriter::write_stock(const fs::path& result,
                                    const fs::path& history) const {
    const fs::path page = page_of(result);
    fs::path program = script.value_or("scripts/loop_report");
    program.replace_filename("stock_report");
    const std::vector<std::string> words{python.string(), program.string(),
                                         result.string(), page.string(),
                                         "--history",     history.string()};
    if (script && !is_of_another(page) && makes(words, page))
        return fmt::format("wrote {}, the same", page.string());
    return fmt::format("no page, {}; to make it: {}", reason(page),
                       fmt::join(std::vector(words.begin() + 1, words.end()), " "));
}

std::vector<std::string> loops_in(const std::vector<study::Summary>& found) {
    std::vector<std::string> loops;
    for (const study::Summary& summary : found)
        if (summary.has_page) loops.push_back(summary.study);
    return loops;
}

std::vector<std::string> PageWriter::write(const fs::path& result,
                                           const std::vector<std::string>& loops) const {
    std::vector<std::string> lines;
    lines.reserve(loops.size());
    const std::vector<fs::path> pages = pages_of(result, loops);
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const fs::path& page = pages[k];
        std::vector<std::string> words{script.value_or("scripts/loop_report").string(),
                                       result.string(), page.string()};
        if (loops.size() > 1) words.insert(words.end(), {"--stage", loops[k]});
        const std::string command = fmt::format("{}", fmt::join(words, " "));
        words.insert(words.begin(), python.string());
        lines.push_back(
            script && !is_of_another(page) && makes(words, page)
                ? fmt::format("wrote {}, the same with pictures", page.string())
                : fmt::format("no page with pictures, {}; to make it: {}", reason(page),
                              command));
    }
    return lines;
}

}  // namespace bemcal::run
