/// Follows a run from another program: what `status --watch` does.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

namespace bemcal::run {

/// Prints the progress of the run that writes this result on stdout, again and again,
/// until it ends, however it ends. Returns at once where no run writes it, or nobody
/// reads what is printed.
/// \param every  between lines; none: a second on a terminal, else ten
void watch_run(const std::filesystem::path& output,
               std::optional<std::chrono::duration<double>> every);

}  // namespace bemcal::run
