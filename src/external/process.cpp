/// Runs a program in a process group of its own, within a time limit: SIGTERM, then
/// SIGKILL to the whole group; without our open files and MPI's variables.
/// Source: POSIX (posix_spawn, waitid). A program that leaves its group escapes. Memory
/// and processor time are not limited; Linux only.
#include "external/process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bemcal::external {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::duration;

/// Between SIGTERM and SIGKILL.
constexpr duration<double> grace{2};

/// Pointers to texts that outlive it, with the null pointer that C wants at the end.
std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    pointers.reserve(texts.size() + 1);
    for (const std::string& text : texts)
        pointers.push_back(const_cast<char*>(text.c_str()));
    pointers.push_back(nullptr);
    return pointers;
}

/// What happens in the child before the program starts.
class Preparation {
  public:
    explicit Preparation(const Command& command) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
        open(STDIN_FILENO, "/dev/null", O_RDONLY);
        open(STDOUT_FILENO, command.folder / command.output,
             O_WRONLY | O_CREAT | O_TRUNC);
        open(STDERR_FILENO, command.folder / command.error, O_WRONLY | O_CREAT | O_TRUNC);
        note(posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1));
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
    /// Every signal as a program expects it, and a group of its own.
    void set_signals() {
        sigset_t all, none;
        sigfillset(&all);
        sigdelset(&all, SIGKILL);
        sigdelset(&all, SIGSTOP);
        sigemptyset(&none);
        note(posix_spawnattr_setsigdefault(&attributes_, &all));
        note(posix_spawnattr_setsigmask(&attributes_, &none));
        note(posix_spawnattr_setpgroup(&attributes_, 0));
        note(posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP |
                                                        POSIX_SPAWN_SETSIGDEF |
                                                        POSIX_SPAWN_SETSIGMASK));
    }

    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
    int error_ = 0;
};

/// The groups that run now, so that none outlives us where their threads cannot wait for
/// them: the one thing of this program that is known everywhere in it.
class Running {
  public:
    static Running& of_program() {
        static auto* const all =
            new Running;  // never destroyed: threads may outlive main
        return *all;
    }
    /// \return errno, or 0 and the child's number
    int start(const Command& command, const Preparation& preparation, pid_t& id) {
        const std::scoped_lock lock(mutex_);
        if (is_over_) return ECANCELED;
        const int error =
            ::posix_spawn(&id, command.program.c_str(), preparation.actions(),
                          preparation.attributes(), pointers_to(command.arguments).data(),
                          pointers_to(command.environment).data());
        if (error == 0) groups_.push_back(id);
        return error;
    }
    /// Before it is reaped: after that its number may be another's.
    void forget(pid_t id) {
        const std::scoped_lock lock(mutex_);
        std::erase(groups_, id);
    }
    void end_all() {
        const std::scoped_lock lock(mutex_);
        is_over_ = true;
        for (const pid_t id : groups_) ::kill(-id, SIGKILL);
    }

  private:
    std::mutex mutex_;
    std::vector<pid_t> groups_;
    bool is_over_ = false;
};

/// A child that we started and have not reaped, so that its number is still its own, and
/// that of its group.
class Child {
  public:
    explicit Child(pid_t id) : id_(id) {}

    bool has_ended() const {
        siginfo_t info{};
        return ::waitid(P_PID, static_cast<id_t>(id_), &info,
                        WEXITED | WNOHANG | WNOWAIT) == 0 &&
               info.si_pid == id_;
    }
    /// Looks again after a while that grows to 20 ms. \return whether it has ended
    bool ends_before(Clock::time_point end) const {
        duration<double> pause{2e-4};
        while (!has_ended()) {
            if (Clock::now() >= end) return false;
            std::this_thread::sleep_for(pause);
            pause = std::min(pause * 1.5, duration<double>(0.02));
        }
        return true;
    }
    void signal_group(int signal) const { ::kill(-id_, signal); }
    Ended reap() const {
        Running::of_program().forget(id_);
        int status = 0;
        while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
        if (WIFSIGNALED(status)) return {Ending::killed, WTERMSIG(status)};
        return {Ending::exited, WEXITSTATUS(status)};
    }

  private:
    pid_t id_;
};

Clock::time_point after(duration<double> time) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
}

Ended wait_for(const Child& child, double limit_s) {
    const bool in_time = child.ends_before(after(duration<double>(limit_s)));
    if (!in_time) {
        child.signal_group(SIGTERM);
        child.ends_before(after(grace));
    }
    child.signal_group(SIGKILL);  // what is left of the group
    const Ended ended = child.reap();
    return in_time ? ended : Ended{Ending::time_limit, 0};
}

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
    const Preparation preparation(command);
    if (preparation.error() != 0) return {Ending::not_started, preparation.error()};
    pid_t id = 0;
    const int error = Running::of_program().start(command, preparation, id);
    if (error != 0) return {Ending::not_started, error};
    return wait_for(Child(id), command.time_limit_s);
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
