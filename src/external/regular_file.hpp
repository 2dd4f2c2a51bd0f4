/// What a program has left under a name, which may be anything: a text, or why it is
/// none.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace bemcal::external {

struct FileText {
    std::string text;
    std::string failure;  ///< "" where there is a text
};

/// All of a file. Links, pipes and devices are refused and not waited for, and so is more
/// than `most_bytes`.
FileText text_of_file(const std::filesystem::path& file, double most_bytes);

/// The last `most` bytes of a file; nothing where it cannot be read.
std::string end_of_file(const std::filesystem::path& file, std::size_t most);

}  // namespace bemcal::external
