/// Files of tests/bad_jobs: each breaks the sample job in one way and says which message
/// and exit code that must give. Lines of such a file:
///     file: NAME       what the edits below apply to (office.toml at first)
///     replace: TEXT    with: TEXT     (\n in a text is a new line)
///     drop: TEXT       the line that begins so goes
///     write: TEXT      the whole file, perhaps a new one
///     empty: / remove: the whole file
///     exit: NUMBER     message: TEXT  (the folder of the job is left out of the message)
#pragma once

#include "job/small_office.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace bemcal::job {

struct BadJob {
    std::map<std::string, std::string> files{{"office.toml", small_office_text()},
                                             {"weather.csv", small_weather()},
                                             {"measured.csv", small_readings()}};
    int exit_code = 0;
    std::string message;
};

/// What reading a job ends with.
struct Ending {
    int exit_code = 0;
    std::string message;  ///< without the job's folder; "" where it goes well
};

inline std::string without(std::string text, const std::string& part) {
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part))
        text.erase(at, part.size());
    return text;
}

inline std::string unescaped(std::string text) {
    for (std::size_t at = text.find("\\n"); at != std::string::npos;
         at = text.find("\\n"))
        text.replace(at, 2, "\n");
    return text;
}

inline std::string without_line(std::string text, const std::string& begin) {
    const std::size_t at = text.find("\n" + begin) + 1;
    if (at == 0) throw std::logic_error("no line begins with " + begin);
    return text.erase(at, text.find('\n', at) + 1 - at);
}

/// Applies one line of a description.
inline void apply(BadJob& job, std::string& file, std::string& from,
                  const std::string& key, const std::string& value) {
    if (key == "file") file = value;
    if (key == "replace") from = unescaped(value);
    if (key == "with")
        job.files[file] = replaced(job.files[file], from, unescaped(value));
    if (key == "write") job.files[file] = unescaped(value);
    if (key == "drop") job.files[file] = without_line(job.files[file], value);
    if (key == "empty") job.files[file].clear();
    if (key == "remove") job.files.erase(file);
    if (key == "exit") job.exit_code = std::stoi(value);
    if (key == "message") job.message = value;
}

/// Makes the mistake of a description, beside those that the job has. Throws
/// std::logic_error where another edit has taken its place.
inline void spoil(BadJob& job, const std::filesystem::path& description) {
    std::string file = "office.toml", from, line;
    std::istringstream lines(text_of(description));
    while (std::getline(lines, line)) {
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        const std::size_t begin = std::min(line.size(), colon + 2);
        apply(job, file, from, line.substr(0, colon), line.substr(begin));
    }
}

inline Ending ending_of(const BadJob& bad) {
    const Folder folder;
    for (const auto& [name, text] : bad.files) folder.write(name, text);
    ExitCode exit_code = ExitCode::ok;
    const std::string message = message_of(folder / "office.toml", &exit_code);
    return {static_cast<int>(exit_code), without(message, folder.path().string() + "/")};
}

/// In the order of their names.
inline std::vector<std::filesystem::path> descriptions_of_bad_jobs() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(BEMCAL_ROOT "/tests/bad_jobs"))
        files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

}  // namespace bemcal::job
