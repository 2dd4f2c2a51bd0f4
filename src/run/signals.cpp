/// Signals that mean "stop soon", kept in a flag; a second one after more than a second
/// ends the program at once.
/// Source: POSIX sigaction. The handler does nothing else; who looks at the flag is
/// distribute. SIGHUP and SIGQUIT are left as they are.
#include "run/signals.hpp"

#include <csignal>
#include <ctime>

namespace bemcal::run {
namespace {

constexpr int stop_signals[] = {SIGINT, SIGTERM, SIGUSR1};
volatile std::sig_atomic_t requested = 0;
volatile std::time_t requested_at = 0;  ///< [s]
int n_watches = 0;

std::time_t now_s() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec;
}

void request_stop(int signal) {
    if (requested != 0 && now_s() > requested_at + 1) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
        return;
    }
    if (requested == 0) requested_at = now_s();
    requested = 1;
}

}  // namespace

SignalWatch::SignalWatch() {
    if (n_watches++ > 0) return;
    requested = 0;
    struct sigaction action{};
    action.sa_handler = request_stop;
    action.sa_flags = static_cast<int>(SA_RESTART);
    for (const int signal : stop_signals) ::sigaction(signal, &action, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);
}

SignalWatch::~SignalWatch() {
    if (--n_watches > 0) return;
    for (const int signal : stop_signals) std::signal(signal, SIG_DFL);
}

bool SignalWatch::stop_requested() {
    return requested != 0;
}

}  // namespace bemcal::run
