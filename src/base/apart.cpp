/// A forked process with limits of time and memory, whose end is told in words.
/// Source: POSIX (fork, waitpid, setrlimit); Linux for its end with ours and for the
/// memory in use. No limit of time on the clock, and no protection from code that an
/// attacker gets to run.
#include "base/apart.hpp"

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <new>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bemcal {
namespace {

constexpr int out_of_memory = 2, failed = 3;  ///< exit codes of the process

[[noreturn]] void fail(const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
}

/// Memory that we could write to [bytes]; 0 where it is not known.
std::size_t memory_in_use() {
    unsigned long pages = 0;
    if (std::FILE* in = std::fopen("/proc/self/statm", "re")) {
        if (std::fscanf(in, "%*u %*u %*u %*u %*u %lu", &pages) != 1) pages = 0;
        std::fclose(in);
    }
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource_t what, std::size_t most) {
    rlimit now{};
    if (::getrlimit(what, &now) != 0 || now.rlim_cur <= most) return;
    now.rlim_cur = most;
    ::setrlimit(what, &now);
}

/// Signals that are sent to us are ours to answer; faults end it.
void set_signals() {
    for (const int sent : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2})
        std::signal(sent, SIG_IGN);
    for (const int fault :
         {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGXCPU, SIGPIPE})
        std::signal(fault, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

void set_apart(pid_t parent, const Apart::Limits& limits) {
    set_signals();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(failed);
    ::prctl(PR_SET_DUMPABLE, 0);
    limit(RLIMIT_CPU, static_cast<std::size_t>(std::ceil(limits.processor_s)));
    if (const std::size_t used = memory_in_use(); used > 0)
        limit(RLIMIT_DATA, used + limits.memory);
    const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, stream);
}

int code_of(const std::function<void(std::FILE*)>& work, std::FILE* out) {
    try {
        work(out);
        return std::fflush(out) == 0 && std::ferror(out) == 0 ? 0 : failed;
    } catch (const std::bad_alloc&) {
        return out_of_memory;
    } catch (const std::exception&) {
        return failed;
    }
}

std::string in_words(int status) {
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGXCPU ? "it came to no end"
                                           : ::strsignal(WTERMSIG(status));
    switch (WEXITSTATUS(status)) {
        case 0:
            return {};
        case out_of_memory:
            return "there is too little memory for it";
        default:
            return "it failed";
    }
}

}  // namespace

Apart::Apart(const std::function<void(std::FILE*)>& work, const Limits& limits) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail("no pipe");
    const pid_t parent = ::getpid();
    id_ = ::fork();
    if (id_ == 0) {
        ::close(ends[0]);
        set_apart(parent, limits);
        std::FILE* out = ::fdopen(ends[1], "w");
        ::_exit(out == nullptr ? failed : code_of(work, out));
    }
    const int error = errno;
    ::close(ends[1]);
    answer_ = ::fdopen(ends[0], "r");
    if (answer_ == nullptr) ::close(ends[0]);
    if (id_ > 0 && answer_ != nullptr) return;
    if (id_ > 0) ::kill(id_, SIGKILL);
    if (id_ > 0) ending();
    if (answer_ != nullptr) std::fclose(answer_);
    errno = error;
    fail("no process of its own");
}

Apart::~Apart() {
    if (id_ < 0) return;
    ::kill(id_, SIGKILL);
    ending();
}

std::string Apart::ending() {
    if (id_ < 0) return ending_;
    if (answer_ != nullptr) std::fclose(std::exchange(answer_, nullptr));
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
    id_ = -1;
    return ending_ = in_words(status);
}

}  // namespace bemcal
