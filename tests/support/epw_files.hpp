/// EPW texts and files, read as a job reads them.
#pragma once

#include "input/epw.hpp"
#include "input/input_files.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bemcal::test {

inline input::EpwFile parse_epw(std::string_view text, const std::string& name,
                                const input::EpwOptions& options = {}) {
    return input::parse_epw_chain({{name, text}}, options);
}

inline input::EpwFile read_epw_chain(const std::vector<std::filesystem::path>& files,
                                     const input::EpwOptions& options = {}) {
    input::InputFiles inputs;
    std::vector<input::EpwText> texts;
    texts.reserve(files.size());
    for (const std::filesystem::path& file : files)
        texts.push_back({file.string(), inputs.text(file)});
    return input::parse_epw_chain(texts, options);
}

inline input::EpwFile read_epw(const std::filesystem::path& file,
                               const input::EpwOptions& options = {}) {
    return read_epw_chain({file}, options);
}

}  // namespace bemcal::test
