/// Handlers of std::atexit and std::set_terminate.
/// Our own rules, without a source. Signals that end a program are left as they are.
#include "run/last_words.hpp"

#include "base/machine.hpp"
#include "base/terminal.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace bemcal::run {
namespace {

std::atomic<bool> is_planned = false, is_ending = false;

[[noreturn]] void leave(ExitCode code) {
    std::fflush(nullptr);
    std::_Exit(static_cast<int>(code));
}

/// A library has called exit.
void on_exit() {
    if (is_planned || is_ending.exchange(true)) return;
    print(stderr,
          "bemcal-batch: a library ended the program, most likely because the "
          "machine has no memory or threads left; what is finished is kept: give "
          "it more, or fewer threads (--threads), and go on with --resume\n");
    leave(ExitCode::os);
}

/// What is said has to be made, which may need what is not there.
[[noreturn]] void on_terminate() {
    if (is_ending.exchange(true)) leave(ExitCode::os);
    const std::exception_ptr met = std::current_exception();
    if (!met) leave(ExitCode::software);
    const UserError error = as_user_error(met);
    print(stderr, "bemcal-batch: " + std::string(error.what()) +
                      "; what is finished is kept, and --resume goes on\n");
    leave(error.exit_code());
}

}  // namespace

void watch_for_unplanned_end() {
    std::set_terminate(on_terminate);
    std::atexit(on_exit);
}

void end_is_planned() {
    is_planned = true;
}

}  // namespace bemcal::run
