/// Starts the command, waits for its end, its time limit or ours, and kills by SIGKILL
/// until nothing descends from it: what is killed leaves its own children to us.
/// Source: prctl(2): PR_SET_CHILD_SUBREAPER, PR_SET_PDEATHSIG; proc(5). Linux only. A
/// descendant of another user, or one that waits for a dead disk, is given up after ten
/// seconds. Files are limited one by one, not all together.
#include "external/keeper.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bemcal::external {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;

/// What we are called when we keep a command.
constexpr const char* keeper_name = "bemcal-keeper";
/// Between SIGTERM and SIGKILL at the time limit.
constexpr duration<double> grace{2};
/// For what SIGKILL does not end.
constexpr duration<double> patience{10};

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::optional<pid_t> number_in(std::string_view text) {
    pid_t number = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return std::nullopt;
    return number;
}

/// "12 (a name) S 11 ...": the name may hold anything.
std::optional<pid_t> parent_in(const std::string& stat) {
    const std::size_t name_end = stat.rfind(')');
    if (name_end == std::string::npos || name_end + 4 > stat.size()) return std::nullopt;
    return number_in(std::string_view(stat).substr(name_end + 4));
}

std::multimap<pid_t, pid_t> children_of_all() {
    std::multimap<pid_t, pid_t> children;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const auto id = number_in(entry.path().filename().string());
        if (!id) continue;
        if (const auto parent = parent_in(text_of(entry.path() / "stat")))
            children.emplace(*parent, *id);
    }
    return children;
}

std::vector<pid_t> descendants() {
    const std::multimap<pid_t, pid_t> children = children_of_all();
    std::vector<pid_t> found{::getpid()};
    for (std::size_t k = 0; k < found.size(); ++k) {
        const auto [first, end] = children.equal_range(found[k]);
        for (auto each = first; each != end; ++each) found.push_back(each->second);
    }
    found.erase(found.begin());
    return found;
}

void signal_all(int signal) {
    for (const pid_t id : descendants()) ::kill(id, signal);
}

void report(const Ended& ended) {
    while (::write(report_descriptor, &ended, sizeof ended) < 0 && errno == EINTR)
        continue;
}

void limit_files(double bytes) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_FSIZE, &limit) != 0) return;
    limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(bytes));
    ::setrlimit(RLIMIT_FSIZE, &limit);
}

/// What we wait for: a child's end, and the word to end all.
sigset_t watched() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGCHLD);
    sigaddset(&signals, SIGTERM);
    return signals;
}

/// \return the signal, or -1 where none came
int wait_for_signal(duration<double> at_most) {
    const double seconds = std::clamp(at_most.count(), 0.0, 1e6);
    const auto whole = static_cast<std::time_t>(seconds);
    const timespec time{whole,
                        static_cast<long>((seconds - static_cast<double>(whole)) * 1e9)};
    const sigset_t signals = watched();
    return ::sigtimedwait(&signals, nullptr, &time);
}

class Keeper {
  public:
    explicit Keeper(const Kept& kept) : kept_(kept) {}

    void run() {
        if (!start()) return report({Ending::not_started, errno});
        const Ended ended = wait();
        end_all();
        report(ended);
    }

  private:
    bool start() {
        stand_in_ = ::fork();
        if (stand_in_ == 0) become_stand_in();
        return stand_in_ > 0;
    }
    /// The program's parent, so that what it sends to its parent does not reach us. Ends
    /// as the program does.
    [[noreturn]] void become_stand_in() {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        const pid_t program = ::fork();
        if (program == 0) become_program();
        if (program < 0) report({Ending::not_started, errno});
        int status = 0;
        while (::waitpid(program, &status, 0) < 0 && errno == EINTR) continue;
        if (WIFSIGNALED(status)) end_by(WTERMSIG(status));
        ::_exit(WEXITSTATUS(status));
    }
    [[noreturn]] static void end_by(int signal) {
        const rlimit no_core{0, 0};
        ::setrlimit(RLIMIT_CORE, &no_core);
        ::signal(signal, SIG_DFL);
        sigset_t none;
        sigemptyset(&none);
        ::sigprocmask(SIG_SETMASK, &none, nullptr);
        ::raise(signal);
        ::_exit(127);
    }
    [[noreturn]] void become_program() {
        sigset_t none;
        sigemptyset(&none);
        ::sigprocmask(SIG_SETMASK, &none, nullptr);
        ::setsid();
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        limit_files(kept_.output_limit);
        std::vector<char*> words;
        words.reserve(kept_.arguments.size() + 1);
        for (std::string& word : kept_.arguments) words.push_back(word.data());
        words.push_back(nullptr);
        ::execve(kept_.program.c_str(), words.data(), environ);
        report({Ending::not_started, errno});
        ::_exit(127);
    }

    Ended wait() {
        const auto end = Clock::now() + duration<double>(kept_.time_limit_s);
        if (!ends_before(end) && !is_over_) {
            signal_all(SIGTERM);
            ends_before(Clock::now() + grace);
            return {Ending::time_limit, 0};
        }
        if (is_over_ || !status_) return {Ending::killed, SIGTERM};
        if (WIFSIGNALED(*status_)) return {Ending::killed, WTERMSIG(*status_)};
        return {Ending::exited, WEXITSTATUS(*status_)};
    }
    template <class Time>
    bool ends_before(Time end) {
        while (has_children(), !status_ && !is_over_ && Clock::now() < end)
            is_over_ = wait_for_signal(end - Clock::now()) == SIGTERM;
        return status_.has_value();
    }
    /// Reaps those that have ended.
    bool has_children() {
        int status = 0;
        pid_t id = 0;
        while ((id = ::waitpid(-1, &status, WNOHANG)) > 0)
            if (id == stand_in_) status_ = status;
        return id == 0;
    }
    void end_all() {
        const auto end = Clock::now() + patience;
        while (has_children() && Clock::now() < end) {
            signal_all(SIGKILL);
            wait_for_signal(duration<double>(0.02));
        }
    }

    Kept kept_;
    pid_t stand_in_ = -1;
    std::optional<int> status_;
    bool is_over_ = false;
};

std::vector<std::string> words_of(const std::string& command_line) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < command_line.size(); at += words.back().size() + 1)
        words.emplace_back(command_line.c_str() + at);
    return words;
}

/// Arguments: our name, the process that wants it, limits, the program and its words.
void keep(const std::vector<std::string>& words) {
    if (words.size() < 6) return;
    ::fcntl(report_descriptor, F_SETFD, FD_CLOEXEC);
    const sigset_t signals = watched();
    ::sigprocmask(SIG_BLOCK, &signals, nullptr);
    ::prctl(PR_SET_NAME, keeper_name);
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != number_in(words[1])) return;  // it has gone
    Keeper({std::strtod(words[2].c_str(), nullptr),
            std::strtod(words[3].c_str(), nullptr),
            words[4],
            {words.begin() + 5, words.end()}})
        .run();
}

/// Before main, in every program that can start a command: no main has to know of it.
[[gnu::constructor]] void become_keeper() {
    const std::vector<std::string> words = words_of(text_of("/proc/self/cmdline"));
    if (words.empty() || words[0] != keeper_name) return;
    keep(words);
    ::_exit(0);
}

}  // namespace

std::vector<std::string> keeper_arguments(const Kept& kept) {
    std::vector<std::string> words{std::string(keeper_name), std::to_string(::getpid()),
                                   std::to_string(kept.time_limit_s),
                                   std::to_string(kept.output_limit), kept.program};
    words.insert(words.end(), kept.arguments.begin(), kept.arguments.end());
    return words;
}

}  // namespace bemcal::external
