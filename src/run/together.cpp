/// Work that all ranks do at once, whose failure on one is the failure of all: exit code
/// and message are gathered, and the first rank's is thrown everywhere.
/// Our own rule, without a source. Errors of users and of the machine only: any other is
/// a program error and ends the run.
#include "run/together.hpp"

#include "base/machine.hpp"

#include <cstring>
#include <exception>

#include <fmt/format.h>

namespace bemcal::run {
namespace {

Bytes report_of(ExitCode code, const std::string& text) {
    Bytes report(1 + text.size());
    report[0] = static_cast<std::byte>(code);
    std::memcpy(report.data() + 1, text.data(), text.size());
    return report;
}

/// Exit code and message, or nothing where all went well.
Bytes attempt(const std::function<void()>& work) {
    try {
        work();
    } catch (const UserError& error) {
        return report_of(error.exit_code(), error.what());
    } catch (const std::exception&) {
        const UserError error = as_user_error(std::current_exception());
        if (error.exit_code() == ExitCode::software) throw;
        return report_of(error.exit_code(), error.what());
    }
    return {};
}

}  // namespace

void together(Comm& comm, const std::function<void()>& work) {
    Bytes mine = attempt(work);
    if (!mine.empty() && comm.rank() != 0) {
        const std::string where =
            fmt::format("rank {} on {}: ", comm.rank(), host_name());
        const auto* raw = reinterpret_cast<const std::byte*>(where.data());
        mine.insert(mine.begin() + 1, raw, raw + where.size());
    }
    for (const Bytes& report : comm.all_gather(mine))
        if (!report.empty())
            throw UserError(static_cast<ExitCode>(report[0]),
                            std::string(reinterpret_cast<const char*>(report.data()) + 1,
                                        report.size() - 1));
}

}  // namespace bemcal::run
