/// How a command came to its end.
#pragma once

namespace bemcal::external {

enum class Ending { exited, killed, time_limit, not_started };

struct Ended {
    Ending how = Ending::exited;
    int number = 0;  ///< exit code, signal, or errno where it did not start
};

}  // namespace bemcal::external
