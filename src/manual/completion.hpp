/// Completion of the command line by shells.
#pragma once

#include "manual/command.hpp"

namespace bemcal::manual {

/// For share/bash-completion/completions.
std::string bash_completion(const Program& program);
/// For share/zsh/site-functions, as _NAME.
std::string zsh_completion(const Program& program);

}  // namespace bemcal::manual
