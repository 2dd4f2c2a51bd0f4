/// Runs a program under a keeper in a session of its own, without our open files and
/// MPI's variables, and waits for what the keeper reports.
/// Source: POSIX (posix_spawn, waitpid). Memory and processor time are not limited; Linux
/// only. Ends and limits are the keeper's. Not Boost.Process: it forks a rank's memory,
/// and a session and default signals would be handlers of our own.
#include "external/process.hpp"

#include "external/keeper.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bemcal::external {
namespace {

namespace fs = std::filesystem;

/// Pointers to texts that outlive it, with the null pointer that C wants at the end.
std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    pointers.reserve(texts.size() + 1);
    for (const std::string& text : texts)
        pointers.push_back(const_cast<char*>(text.c_str()));
    pointers.push_back(nullptr);
    return pointers;
}

/// By which the keeper reports. Our ends are above the standard streams, which may be
/// closed, and go to nobody else.
class ReportPipe {
  public:
    ReportPipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) {
            error_ = errno;
            return;
        }
        for (const int k : {0, 1}) {
            ends_[k] = ::fcntl(ends[k], F_DUPFD_CLOEXEC, report_descriptor + 1);
            if (ends_[k] < 0) error_ = errno;
            ::close(ends[k]);
        }
    }
    ~ReportPipe() {
        for (const int end : ends_)
            if (end >= 0) ::close(end);
    }
    ReportPipe(const ReportPipe&) = delete;
    ReportPipe& operator=(const ReportPipe&) = delete;

    int error() const { return error_; }
    int keepers_end() const { return ends_[1]; }
    void close_keepers_end() { ::close(std::exchange(ends_[1], -1)); }
    /// Waits for it. \return whether there was one
    bool read(Ended& ended) const {
        for (;;) {
            const ssize_t n = ::read(ends_[0], &ended, sizeof ended);
            if (n == sizeof ended) return true;
            if (n >= 0 || errno != EINTR) return false;
        }
    }

  private:
    int ends_[2] = {-1, -1};
    int error_ = 0;
};

/// What happens in the child before the keeper starts.
class Preparation {
  public:
    Preparation(const Command& command, const ReportPipe& pipe) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
        open(STDIN_FILENO, "/dev/null", O_RDONLY);
        open(STDOUT_FILENO, command.folder / command.output,
             O_WRONLY | O_CREAT | O_TRUNC);
        open(STDERR_FILENO, command.folder / command.error, O_WRONLY | O_CREAT | O_TRUNC);
        note(posix_spawn_file_actions_adddup2(&actions_, pipe.keepers_end(),
                                              report_descriptor));
        note(posix_spawn_file_actions_addclosefrom_np(&actions_, report_descriptor + 1));
        note(posix_spawn_file_actions_addchdir_np(&actions_, command.folder.c_str()));
        set_signals();
    }
    ~Preparation() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    Preparation(const Preparation&) = delete;
    Preparation& operator=(const Preparation&) = delete;

    int error() const { return error_; }
    const posix_spawn_file_actions_t* actions() const { return &actions_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

  private:
    void note(int error) {
        if (error_ == 0) error_ = error;
    }
    void open(int descriptor, const fs::path& file, int flags) {
        note(posix_spawn_file_actions_addopen(&actions_, descriptor, file.c_str(), flags,
                                              0666));
    }
    /// Every signal as a program expects it, and a session of its own.
    void set_signals() {
        sigset_t all, none;
        sigfillset(&all);
        sigdelset(&all, SIGKILL);
        sigdelset(&all, SIGSTOP);
        sigemptyset(&none);
        note(posix_spawnattr_setsigdefault(&attributes_, &all));
        note(posix_spawnattr_setsigmask(&attributes_, &none));
        note(posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSID |
                                                        POSIX_SPAWN_SETSIGDEF |
                                                        POSIX_SPAWN_SETSIGMASK));
    }

    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
    int error_ = 0;
};

/// The keepers that run now, so that none outlives us where their threads cannot wait for
/// them: the one thing of this program that is known everywhere in it.
class Running {
  public:
    static Running& of_program() {
        static auto* const all =
            new Running;  // never destroyed: threads may outlive main
        return *all;
    }
    /// \return errno, or 0 and the keeper's number
    int start(const Command& command, const Preparation& preparation, pid_t& id) {
        const std::vector<std::string> arguments =
            keeper_arguments({command.time_limit_s, command.output_limit, command.program,
                              command.arguments});
        const std::scoped_lock lock(mutex_);
        if (is_over_) return ECANCELED;
        const int error = ::posix_spawn(
            &id, keeper_program, preparation.actions(), preparation.attributes(),
            pointers_to(arguments).data(), pointers_to(command.environment).data());
        if (error == 0) keepers_.push_back(id);
        return error;
    }
    /// Waits for its end; after that its number may be another's.
    int reap(pid_t id) {
        siginfo_t info{};
        while (::waitid(P_PID, static_cast<id_t>(id), &info, WEXITED | WNOWAIT) < 0 &&
               errno == EINTR)
            continue;
        const std::scoped_lock lock(mutex_);
        std::erase(keepers_, id);
        int status = 0;
        ::waitpid(id, &status, 0);
        return status;
    }
    void end_all() {
        const std::scoped_lock lock(mutex_);
        is_over_ = true;
        for (const pid_t id : keepers_) ::kill(id, SIGTERM);
    }

  private:
    std::mutex mutex_;
    std::vector<pid_t> keepers_;
    bool is_over_ = false;
};

bool is_of_launcher(std::string_view variable) {
    constexpr std::string_view prefixes[] = {
        "OMPI_", "PMIX_",  "PMI_",      "PRTE_", "ORTE_",
        "OPAL_", "HYDRA_", "MPI_LOCAL", "HYDI_", "OMP_NUM_THREADS="};
    if (variable.starts_with("OMPI_ALLOW_RUN_AS_ROOT")) return false;
    return std::ranges::any_of(
        prefixes, [&](std::string_view prefix) { return variable.starts_with(prefix); });
}

bool is_executable(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

Ended run_command(const Command& command) {
    ReportPipe pipe;
    const Preparation preparation(command, pipe);
    if (pipe.error() != 0) return {Ending::not_started, pipe.error()};
    if (preparation.error() != 0) return {Ending::not_started, preparation.error()};
    pid_t id = 0;
    const int error = Running::of_program().start(command, preparation, id);
    if (error != 0) return {Ending::not_started, error};
    pipe.close_keepers_end();
    Ended ended{Ending::killed, SIGKILL};
    const bool has_reported = pipe.read(ended);
    const int status = Running::of_program().reap(id);
    if (!has_reported && WIFSIGNALED(status)) ended.number = WTERMSIG(status);
    return ended;
}

void end_commands() {
    Running::of_program().end_all();
}

std::vector<std::string> environment_for_children() {
    std::vector<std::string> variables;
    for (char** each = environ; each != nullptr && *each != nullptr; ++each)
        if (!is_of_launcher(*each)) variables.emplace_back(*each);
    variables.emplace_back("OMP_NUM_THREADS=1");
    return variables;
}

fs::path find_program(const std::string& name, const fs::path& folder) {
    if (name.find('/') != std::string::npos) {
        const fs::path file = fs::absolute(folder / name);
        return is_executable(file) ? file : fs::path();
    }
    const char* variable = std::getenv("PATH");
    std::string_view rest = variable == nullptr ? "/usr/bin:/bin" : variable;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        const fs::path file = fs::path(rest.substr(0, end)) / name;
        if (end > 0 && is_executable(file)) return fs::absolute(file);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return {};
}

}  // namespace bemcal::external
