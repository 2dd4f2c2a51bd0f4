/// What a point has beside its parameters: files beside those of the job, texts for
/// places of its templates.
#pragma once

#include <string>
#include <vector>

namespace bemcal::external {

struct HandedFile {
    std::string name, text;
};

struct Handed {
    std::vector<HandedFile> files;
    std::vector<std::string> texts{};  ///< [CommandOptions::places]
};

}  // namespace bemcal::external
