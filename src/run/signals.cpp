#include "run/signals.hpp"

#include <csignal>

namespace bemcal::run {
namespace {

constexpr int stop_signals[] = {SIGINT, SIGTERM, SIGUSR1};
volatile std::sig_atomic_t requested = 0;
int n_watches = 0;

void request_stop(int) {
    requested = 1;
}

}  // namespace

SignalWatch::SignalWatch() {
    if (n_watches++ > 0) return;
    requested = 0;
    struct sigaction action{};
    action.sa_handler = request_stop;
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
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
