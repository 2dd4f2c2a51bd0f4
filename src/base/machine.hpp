/// Errors that no input is to blame for: the machine's, which end a run and are never an
/// answer, and the program's own.
///
/// Memory, room on a disk and threads are there again later: what they kept from being
/// computed has to be computed then. `what()` of an item's own error is its answer.
#pragma once

#include "base/error.hpp"

#include <exception>
#include <stdexcept>
#include <string>

namespace bemcal {

/// What the machine refused: a thread, a file, room on a disk. (Memory is
/// std::bad_alloc.)
class MachineError : public std::runtime_error {
  public:
    /// \param error  errno
    MachineError(int error, const std::string& message)
        : std::runtime_error(message), error_(error) {}
    int error() const { return error_; }

  private:
    int error_;
};

/// Whether that errno is about what the machine has left, not about a file.
bool is_of_machine(int error);

/// In a handler: throws the error again where it is the machine's.
void rethrow_of_machine(const std::exception& error);

/// The same, and where it is a mistake in the program: a std::logic_error that is none of
/// the model's own (invalid_argument, domain_error). What is left is an item's answer.
void rethrow_unless_answer(const std::exception& error);

/// For the user, with its code: os or io where it is the machine's, software where it is
/// the program's; a UserError as it is. Never throws std::bad_alloc.
UserError as_user_error(const std::exception_ptr& error) noexcept;

}  // namespace bemcal
