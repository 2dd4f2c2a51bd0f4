/// Man pages of the program (section 1) and of a job file (section 5).
#pragma once

#include "manual/command.hpp"

namespace bemcal::manual {

/// bemcal-batch.1
std::string man_page_of(const Program& program);

/// bemcal-job.5
/// \param description  as `describe job` prints it
std::string man_page_of_job(const Program& program, const std::string& description);

}  // namespace bemcal::manual
