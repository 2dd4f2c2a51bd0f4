#include "base/machine.hpp"

#include <cerrno>
#include <filesystem>
#include <functional>
#include <new>
#include <system_error>

#include <gtest/gtest.h>

namespace bemcal {
namespace {

template <class Error>
std::exception_ptr made(const Error& error) {
    return std::make_exception_ptr(error);
}

std::system_error refused(int error) {
    return {error, std::generic_category(), "it"};
}

ExitCode code_of(const std::exception_ptr& error) {
    return as_user_error(error).exit_code();
}

/// Whether it ends the run instead of being an item's answer.
template <class Error>
bool ends_the_run(const Error& thrown) {
    try {
        try {
            throw thrown;
        } catch (const std::exception& error) {
            rethrow_unless_answer(error);
        }
    } catch (const Error&) {
        return true;
    }
    return false;
}

TEST(Machine, WhatItRefusesEndsTheRun) {
    EXPECT_TRUE(ends_the_run(std::bad_alloc()));
    EXPECT_TRUE(ends_the_run(refused(EAGAIN)));
    EXPECT_TRUE(ends_the_run(MachineError(ENOSPC, "full")));
}

TEST(Machine, AMistakeInTheProgramEndsTheRun) {
    EXPECT_TRUE(ends_the_run(std::logic_error("cannot be")));
    EXPECT_TRUE(ends_the_run(std::out_of_range("at")));
    EXPECT_TRUE(ends_the_run(std::length_error("vector")));
}

TEST(Machine, AModelsOwnErrorAndAUsersAreAnswers) {
    EXPECT_FALSE(ends_the_run(std::domain_error("left the method")));
    EXPECT_FALSE(ends_the_run(std::invalid_argument("no such schedule")));
    EXPECT_FALSE(ends_the_run(std::runtime_error("no licence")));
    EXPECT_FALSE(ends_the_run(UserError(ExitCode::data, "a meter's file")));
}

TEST(Machine, EachHasItsCode) {
    EXPECT_EQ(code_of(made(std::bad_alloc())), ExitCode::os);
    EXPECT_EQ(code_of(made(refused(ENOMEM))), ExitCode::os);
    EXPECT_EQ(code_of(made(refused(EAGAIN))), ExitCode::os);
    EXPECT_EQ(code_of(made(refused(ENOSPC))), ExitCode::io);
    EXPECT_EQ(code_of(made(MachineError(EMFILE, "files"))), ExitCode::os);
    EXPECT_EQ(code_of(made(MachineError(EDQUOT, "quota"))), ExitCode::io);
    EXPECT_EQ(code_of(made(std::logic_error("cannot be"))), ExitCode::software);
    EXPECT_EQ(code_of(made(42)), ExitCode::software);
    EXPECT_EQ(code_of(made(UserError(ExitCode::config, "key"))), ExitCode::config);
}

TEST(Machine, ANameThatIsTooLongIsToldWithItsPath) {
    try {
        static_cast<void>(std::filesystem::is_directory(std::string(300, 'n')));
        ADD_FAILURE();
    } catch (const std::filesystem::filesystem_error&) {
        const UserError error = as_user_error(std::current_exception());
        EXPECT_EQ(error.exit_code(), ExitCode::no_input);
        EXPECT_NE(std::string(error.what()).find("nnn: File name too long"),
                  std::string::npos);
    }
}

TEST(Machine, ErrnosAreToldApart) {
    for (const int error : {ENOMEM, EMFILE, ENFILE, ENOSPC, EDQUOT, EAGAIN})
        EXPECT_TRUE(is_of_machine(error)) << error;
    for (const int error : {ENOENT, EACCES, EISDIR, EIO})
        EXPECT_FALSE(is_of_machine(error)) << error;
}

}  // namespace
}  // namespace bemcal
