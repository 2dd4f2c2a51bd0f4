/// Signals that mean "stop soon": SIGINT, SIGTERM, and SIGUSR1, which batch systems send
/// before a time limit.
#pragma once

namespace bemcal::run {

/// Catches them while it lives (one inside another changes nothing). Launchers pass on
/// what they get, so that a rank may get the same signal twice: one more within a second
/// changes nothing, a later one ends the program at once. Also ignores SIGXFSZ, so that a
/// file-size limit is an error of write() like a full disk.
class SignalWatch {
  public:
    SignalWatch();
    ~SignalWatch();
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;

    static bool stop_requested();
};

}  // namespace bemcal::run
