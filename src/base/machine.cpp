/// Sorts exceptions by who is to blame.
/// Our own rules, without a source, on the standard library's classes.
/// Whether a step is tried again is the caller's.
#include "base/machine.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>
#include <typeinfo>

#include <fmt/format.h>

namespace bemcal {
namespace {

constexpr const char* no_memory =
    "the machine has no memory left; give the run more of it, or fewer threads "
    "(--threads)";

bool is_of_room(int error) {
    return error == ENOSPC || error == EDQUOT || error == EIO || error == EFBIG;
}

bool is_mistake(const std::exception& error) {
    return dynamic_cast<const std::logic_error*>(&error) != nullptr &&
           dynamic_cast<const std::invalid_argument*>(&error) == nullptr &&
           dynamic_cast<const std::domain_error*>(&error) == nullptr;
}

/// errno, where a file's name is at fault.
bool is_of_name(int error) {
    for (const int each : {ENOENT, ENOTDIR, EACCES, ENAMETOOLONG, ELOOP})
        if (error == each) return true;
    return false;
}

UserError as_user_error(const std::filesystem::filesystem_error& error) {
    const int number = error.code().value();
    return {is_of_name(number)                             ? ExitCode::no_input
            : is_of_machine(number) && !is_of_room(number) ? ExitCode::os
                                                           : ExitCode::io,
            fmt::format("{}: {}", error.path1().string(), error.code().message())};
}

UserError as_user_error(const std::system_error& error) {
    const int number = error.code().value();
    if (number == ENOMEM) return {ExitCode::os, no_memory};
    return {is_of_room(number) ? ExitCode::io : ExitCode::os, error.what()};
}

}  // namespace

bool is_of_machine(int error) {
    for (const int each :
         {ENOMEM, EAGAIN, EMFILE, ENFILE, ENOSPC, EDQUOT, ENOLCK, ENOBUFS})
        if (error == each) return true;
    return false;
}

void rethrow_of_machine(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
        dynamic_cast<const std::system_error*>(&error) != nullptr ||
        dynamic_cast<const MachineError*>(&error) != nullptr)
        throw;
}

void rethrow_unless_answer(const std::exception& error) {
    rethrow_of_machine(error);
    if (is_mistake(error)) throw;
}

UserError as_user_error(const std::exception_ptr& error) noexcept {
    try {
        std::rethrow_exception(error);
    } catch (const UserError& known) {
        return known;
    } catch (const std::bad_alloc&) {
        return {ExitCode::os, no_memory};
    } catch (const std::filesystem::filesystem_error& refused) {
        return as_user_error(refused);
    } catch (const std::system_error& refused) {
        return as_user_error(refused);
    } catch (const MachineError& refused) {
        return {is_of_room(refused.error()) ? ExitCode::io : ExitCode::os,
                refused.what()};
    } catch (const std::exception& mistake) {
        return {ExitCode::software, fmt::format("program error: {}", mistake.what())};
    } catch (...) {
        return {ExitCode::software, "program error without a name"};
    }
}

}  // namespace bemcal
