/// Runs points of a command: a folder each, filled templates, links, more files that are
/// handed over, the command; then whoever asked reads what it wrote. Whatever goes wrong
/// is the point's reason.
/// Plain handling of files, without a source. Points are not cached and not tried again
/// here; processes are process's.
#include "external/point_runner.hpp"

#include "base/hash.hpp"
#include "base/terminal.hpp"
#include "external/process.hpp"
#include "external/regular_file.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace bemcal::external {
namespace {

namespace fs = std::filesystem;

/// Something went wrong with one point; what() is its reason.
struct PointFailure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::string name_of_point(std::span<const double> point, const Handed& handed) {
    Hasher hasher;
    hasher.add(point);
    for (const HandedFile& file : handed.files) hasher.add(file.text);
    for (const std::string& text : handed.texts) hasher.add(text);
    return "point-" + hasher.hex().substr(0, 16);
}

/// A folder that was not there before; an earlier run may have left one of that name, and
/// another thread may have the same point.
fs::path make_folder(const fs::path& parent, const std::string& name) {
    std::error_code error;
    fs::create_directories(parent, error);
    for (int number = 1; number < 1000000; ++number) {
        const fs::path folder =
            parent / (number == 1 ? name : fmt::format("{}-{}", name, number));
        if (fs::create_directory(folder, error)) return folder;
        if (error) break;
    }
    throw PointFailure(fmt::format("its folder cannot be made: {}",
                                   error ? error.message() : "too many of its name"));
}

void write_text(const fs::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text << std::flush;
    if (!out)
        throw PointFailure(fmt::format("{} cannot be written: {}",
                                       file.filename().string(), std::strerror(errno)));
}

void link_file(const fs::path& from, const fs::path& folder) {
    std::error_code error;
    fs::create_symlink(from, folder / from.filename(), error);
    if (error)
        throw PointFailure(fmt::format("{} cannot be linked: {}",
                                       from.filename().string(), error.message()));
}

std::string without(std::string text, const std::string& part) {
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part))
        text.erase(at, part.size());
    return text;
}

/// The last line that says something, without the folder's own name, so that a reason is
/// the same wherever the point ran; of plain characters, at most 200.
std::string last_line(const fs::path& folder, const char* file) {
    std::istringstream in(end_of_file(folder / file, 10000));
    std::string line, last;
    while (std::getline(in, line))
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    last = without(last, fs::absolute(folder).string() + "/");
    last.resize(std::min<std::size_t>(last.size(), 200));
    for (char& c : last)
        if (c < ' ' || c > '~') c = c == '\r' || c == '\t' ? ' ' : '?';
    return last;
}

std::string how(const Ended& ended, const CommandOptions& options) {
    switch (ended.how) {
        case Ending::exited:
            return fmt::format("exit code {}", ended.number);
        case Ending::killed:
            if (ended.number == SIGXFSZ)
                return fmt::format("ended as a file reached output_limit = {:g} MB",
                                   options.output_limit / 1e6);
            return fmt::format("ended by signal {} ({})", ended.number,
                               strsignal(ended.number));
        case Ending::time_limit:
            return fmt::format("not done at its time limit of {} s",
                               options.time_limit_s);
        case Ending::not_started:
            return fmt::format("cannot be started: {}", std::strerror(ended.number));
    }
    return "";
}

}  // namespace

PointRunner::PointRunner(CommandOptions options)
    : options_(std::move(options)), environment_(environment_for_children()) {}

PointRunner::~PointRunner() {
    std::error_code ignored;
    fs::remove(options_.folder, ignored);
}

std::string PointRunner::run(std::span<const double> point, const Handed& handed,
                             const Read& read) const {
    const std::string name = name_of_point(point, handed);
    try {
        const fs::path folder = make_folder(options_.folder, name);
        const std::string failure = run_in(folder, point, handed, read);
        const bool keeps = options_.keep == Keep::all ||
                           (options_.keep == Keep::failed && !failure.empty());
        std::error_code ignored;
        if (!keeps) fs::remove_all(folder, ignored);
        if (failure.empty()) return {};
        // What it wrote may be of any kind, and a reason is a text of the result.
        const std::string why = in_one_line(failure);
        return keeps ? fmt::format("{} (in {})", why, name) : why;
    } catch (const PointFailure& failure) {
        return failure.what();
    }
}

std::string PointRunner::run_in(const fs::path& folder, std::span<const double> point,
                                const Handed& handed, const Read& read) const {
    try {
        prepare(folder, point, handed);
    } catch (const PointFailure& failure) {
        return failure.what();
    }
    const Ended ended = run_command(command_of(folder, point));
    if (ended.how != Ending::exited || ended.number != 0) {
        const std::string said = last_line(folder, standard_error);
        return how(ended, options_) + (said.empty() ? "" : ": " + said);
    }
    return read(folder);
}

void PointRunner::prepare(const fs::path& folder, std::span<const double> point,
                          const Handed& handed) const {
    for (const InputFile& input : options_.inputs)
        write_text(folder / input.name, input.text.filled(point, handed.texts));
    for (const fs::path& file : options_.links) link_file(file, folder);
    for (const HandedFile& file : handed.files) write_text(folder / file.name, file.text);
}

Command PointRunner::command_of(const fs::path& folder,
                                std::span<const double> point) const {
    Command command{options_.program,      {},
                    environment_,          fs::absolute(folder),
                    standard_output,       standard_error,
                    options_.time_limit_s, options_.output_limit};
    command.arguments.reserve(options_.arguments.size());
    for (const TextTemplate& argument : options_.arguments)
        command.arguments.push_back(argument.filled(point));
    return command;
}

}  // namespace bemcal::external
