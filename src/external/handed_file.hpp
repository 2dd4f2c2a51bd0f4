/// A file that a point has beside those of the job.
#pragma once

#include <string>

namespace bemcal::external {

struct HandedFile {
    std::string name, text;
};

}  // namespace bemcal::external
