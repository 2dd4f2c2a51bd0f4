/// Pages with pictures of a result's loops or stock: a Python script in a process of its
/// own, and a line that says what was written or how to do it.
/// Plain handling of processes, without a source. No time limit, and the script's
/// messages are not shown; a missing page is no error.
#include "run/loop_page.hpp"

#include "store/layout.hpp"

#include <algorithm>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

namespace bemcal::run {
namespace {

namespace fs = std::filesystem;

/// Runs a program to its end, with nothing said; whether it ended with 0.
bool succeeds(std::vector<std::string> words) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t silent;
    posix_spawn_file_actions_init(&silent);
    for (const int stream : {1, 2})
        posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    int status = 0;
    const bool runs = posix_spawn(&child, arguments[0], &silent, nullptr,
                                  arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&silent);
    return runs && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

std::string building_of(const std::string& loop) {
    return loop.substr(0, loop.find('/'));
}

/// What the page of a loop adds to the result's name.
std::string suffix_of(const std::string& loop, const std::vector<std::string>& loops) {
    if (loops.size() < 2) return "";
    const std::string building = building_of(loop);
    const auto n = std::ranges::count(loops, building, building_of);
    return "-" + (n > 1 ? building + "-" + loop.substr(building.size() + 1) : building);
}

}  // namespace

std::string PageWriter::write_stock(const fs::path& result,
                                    const fs::path& history) const {
    fs::path page = result;
    page.replace_extension(".html");
    fs::path program = script.value_or("scripts/loop_report");
    program.replace_filename("stock_report");
    const std::vector<std::string> words{python.string(), program.string(),
                                         result.string(), page.string(),
                                         "--history",     history.string()};
    if (script && succeeds(words))
        return fmt::format("wrote {}, the same", page.string());
    return fmt::format(
        "no page, which takes Python with h5py, matplotlib and jinja2; to "
        "make it: {}",
        fmt::join(std::vector(words.begin() + 1, words.end()), " "));
}

std::vector<std::string> loops_in(const std::vector<study::Dataset>& datasets) {
    std::vector<std::string> loops;
    for (const study::Dataset& dataset : datasets)
        if (store::leaf_of(dataset.path) == "structure_chosen")
            loops.push_back(store::group_of(dataset.path));
    return loops;
}

std::vector<std::string> PageWriter::write(const fs::path& result,
                                           const std::vector<std::string>& loops) const {
    std::vector<std::string> lines;
    lines.reserve(loops.size());
    for (const std::string& loop : loops) {
        fs::path page = result;
        page.replace_filename(result.stem().string() + suffix_of(loop, loops) + ".html");
        std::vector<std::string> words{script.value_or("scripts/loop_report").string(),
                                       result.string(), page.string()};
        if (loops.size() > 1) words.insert(words.end(), {"--stage", loop});
        const std::string command = fmt::format("{}", fmt::join(words, " "));
        words.insert(words.begin(), python.string());
        lines.push_back(
            script && succeeds(words)
                ? fmt::format("wrote {}, the same with pictures", page.string())
                : fmt::format("no page with pictures, which takes Python with h5py, "
                              "matplotlib and jinja2; to make it: {}",
                              command));
    }
    return lines;
}

}  // namespace bemcal::run
