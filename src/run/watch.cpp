/// Prints the line that a run keeps beside its result for as long as the run holds its
/// lock.
/// Plain waiting without a source. Leaves out disks that keep no locks: no run is seen
/// there.
#include "run/watch.hpp"

#include "base/terminal.hpp"
#include "run/part_folder.hpp"
#include "run/part_lock.hpp"
#include "run/progress.hpp"
#include "run/progress_file.hpp"

#include <algorithm>
#include <string>
#include <thread>

#include <unistd.h>

namespace bemcal::run {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds on_terminal{1}, in_log{10};
constexpr Seconds longest_nap{1};  ///< so soon the end of a run is noticed

/// \return whether the run still goes on
bool wait(const std::filesystem::path& folder, Seconds all) {
    for (Seconds left = all; left.count() > 0; left -= longest_nap) {
        std::this_thread::sleep_for(std::min(left, longest_nap));
        if (!is_running(folder)) return false;
    }
    return true;
}

}  // namespace

void watch_run(const std::filesystem::path& output, std::optional<Seconds> every) {
    RewrittenLine line(STDOUT_FILENO);
    const std::filesystem::path folder = part_folder_of(output);
    const Seconds pause = every.value_or(line.is_terminal() ? on_terminal : in_log);
    if (!is_running(folder)) return;
    do {
        const std::string text = read_progress(folder);
        line.show(text.empty() ? "a run is writing it, and has told nothing yet" : text);
    } while (!is_output_lost() && wait(folder, pause));
}

}  // namespace bemcal::run
