/// Pages with pictures of a result or a stock: a Python script in a process of its
/// own, and a line that says what was written or how to do it.
/// Plain handling of files, without a source. The script's messages are not shown; a
/// missing page is no error, one that cannot be written is.
#include "run/result_page.hpp"

#include "base/disk.hpp"
#include "base/error.hpp"
#include "run/program.hpp"

#include <algorithm>
#include <fstream>
#include <span>
#include <utility>

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
/// \return the script's exit code; 0 = it is there now
int make(std::vector<std::string> words, const fs::path& page) {
    FreshFile fresh(folder_of(page), page.filename().string());
    std::ranges::replace(words, page.string(), fresh.path().string());
    const int code = code_of_program(std::move(words), Said::hidden);
    if (code == static_cast<int>(ExitCode::io))
        throw UserError(ExitCode::io, page.string() +
                                          ": the page cannot be written; the result is "
                                          "whole");
    if (code == 0) fresh.move_to(page, Replace::yes);
    return code;
}

/// A page takes some seconds, and nobody looks at hundreds.
constexpr std::size_t most_pages = 12;

constexpr const char* nothing_to_show =
    "as no study has a result that pictures show: one that was not reached has none";
constexpr const char* needs = "which takes Python with h5py, matplotlib and jinja2";

/// Makes the page, unless something stands in its place.
/// \return nothing where it is there, else why it is not
std::optional<std::string> what_is_in_the_way(const std::optional<fs::path>& script,
                                              std::vector<std::string> words,
                                              const fs::path& page) {
    if (is_of_another(page))
        return page.string() + " is there already and no run wrote it; move it away";
    const int code = script ? make(std::move(words), page) : 1;
    if (code == 0) return std::nullopt;
    return code == static_cast<int>(ExitCode::data) ? nothing_to_show : needs;
}

}  // namespace

std::string PageWriter::command_of(const fs::path& result, const Page& page) const {
    return fmt::format("{}", fmt::join(words_of(result, page), " "));
}

std::vector<std::string> PageWriter::words_of(const fs::path& result,
                                              const Page& page) const {
    std::vector<std::string> words{script.value_or("scripts/result_report").string(),
                                   result.string(), page.file.string()};
    for (const std::string& stage : page.stages)
        words.insert(words.end(), {"--stage", stage});
    return words;
}

std::string PageWriter::write_page(const fs::path& result, const Page& page) const {
    std::vector<std::string> words = words_of(result, page);
    words.insert(words.begin(), python.string());
    const auto why = what_is_in_the_way(script, std::move(words), page.file);
    if (!why) return fmt::format("wrote {}, the same with pictures", page.file.string());
    return fmt::format("no page with pictures, {}; to make it: {}", *why,
                       command_of(result, page));
}

std::string PageWriter::write_stock(const fs::path& result,
                                    const fs::path& history) const {
    const fs::path page = page_of(result);
    fs::path program = script.value_or("scripts/result_report");
    program.replace_filename("stock_report");
    const std::vector<std::string> words{python.string(), program.string(),
                                         result.string(), page.string(),
                                         "--history",     history.string()};
    const auto why = what_is_in_the_way(script, words, page);
    if (!why) return fmt::format("wrote {}, the same", page.string());
    return fmt::format("no page, {}; to make it: {}", *why,
                       fmt::join(std::vector(words.begin() + 1, words.end()), " "));
}

std::vector<std::string> PageWriter::write(const fs::path& result,
                                           const std::vector<std::string>& stages) const {
    std::vector<std::string> lines;
    const std::vector<Page> pages = pages_of(result, stages);
    for (const Page& page : std::span(pages).first(std::min(pages.size(), most_pages)))
        lines.push_back(write_page(result, page));
    if (pages.size() > most_pages)
        lines.push_back(fmt::format("no pages of the other {} buildings; to make one: {}",
                                    pages.size() - most_pages,
                                    command_of(result, pages[most_pages])));
    return lines;
}

}  // namespace bemcal::run
