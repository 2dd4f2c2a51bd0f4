/// Progress of a stage on stderr: one line that updates on a terminal, a plain line every
/// ten seconds in a log; ok and failed counts, rate and remaining time in both.
#pragma once

#include "run/distribute.hpp"

#include <chrono>
#include <string>

namespace bemcal::run {

class ProgressLine {
  public:
    ProgressLine(std::string stage, long long n_simulations);
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void begin_round(int round) { round_ = round; }
    void show(const Progress& progress);
    void clear();  ///< wipes the line, so that other text can be printed

  private:
    std::string stage_;
    double n_simulations_;
    bool is_terminal_;
    int round_ = 1;
    std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

/// "office/screening: 640 of 2000 items, 655360 ok, 12 failed, 81000/s, 0:17 left". Where
/// the number of simulations is not known (0), a stage goes on in rounds:
/// "office/posterior: round 3: 5 of 8 items, 0 failed, 0:17 left in this round".
std::string progress_text(const std::string& stage, double n_simulations,
                          const Progress& progress, int round = 1);

std::string format_duration(double seconds);  ///< "0:07", "12:05", "3:12:05"

}  // namespace bemcal::run
