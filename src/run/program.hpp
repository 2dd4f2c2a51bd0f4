/// Runs another program to its end.
#pragma once

#include <string>
#include <vector>

namespace bemcal::run {

enum class Said { shown, hidden };

/// \param words  the program's path, then its arguments
/// \return its exit code; -1 where it did not run or was ended
int code_of_program(std::vector<std::string> words, Said said);

}  // namespace bemcal::run
