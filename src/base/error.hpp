/// Errors: those that a user can cause, each with the exit code of BSD's sysexits; what
/// cannot be simulated; our own mistakes.
///
/// A message to the user says where (file:line:key or file:row:column), what is wrong,
/// why, and what to write instead. `require` guards against our own mistakes; no input
/// may reach it.
#pragma once

#include <stdexcept>
#include <string>

namespace bemcal {

enum class ExitCode {
    ok = 0,
    not_reached = 1,     ///< all is written, but a target was missed: not converged
    usage = 64,          ///< the command line
    data = 65,           ///< the content of a data file
    no_input = 66,       ///< a file that cannot be opened
    software = 70,       ///< our own mistake
    os = 71,             ///< the machine refused memory, a thread or a process
    cannot_create = 73,  ///< an output that exists or cannot be made
    io = 74,             ///< reading or writing failed, the disk is full
    more_to_do = 75,     ///< stopped by a signal or a time limit; `--resume` goes on
    config = 78,         ///< the job file
};

/// What a user has to mend; caught in main, printed, and turned into the exit code.
class UserError : public std::runtime_error {
  public:
    UserError(ExitCode exit_code, const std::string& message)
        : std::runtime_error(message), exit_code_(exit_code) {}
    ExitCode exit_code() const { return exit_code_; }

  private:
    ExitCode exit_code_;
};

/// What the model cannot simulate: a point outside the method, an effect that cannot
/// enter a building. Who tries many of them leaves such a one out; every other error ends
/// the work.
class CannotSimulate : public std::domain_error {
  public:
    using std::domain_error::domain_error;
};

/// Throws std::logic_error: a mistake in the program, never in the input.
inline void require(bool condition, const char* what) {
    if (!condition) throw std::logic_error(what);
}

}  // namespace bemcal
