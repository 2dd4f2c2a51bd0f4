/// Progress of a stage on stderr: one line that updates on a terminal, a plain line every
/// ten seconds in a log; ok and failed counts, rate and remaining time in both.
#pragma once

#include "run/distribute.hpp"

#include <string>

namespace bemcal::run {

class ProgressLine {
  public:
    ProgressLine(std::string stage, long long n_simulations);
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(const Progress& progress);
    void clear();  ///< wipes the line, so that other text can be printed

  private:
    std::string stage_;
    double n_simulations_;
    bool is_terminal_;
    double shown_ = 0;  ///< seconds into the stage
};

/// "office/screening: 640 of 2000 items, 655360 ok, 12 failed, 81 000/s, 0:17 left"
std::string progress_text(const std::string& stage, double n_simulations,
                          const Progress& progress);

std::string format_duration(double seconds);  ///< "0:07", "12:05", "3:12:05"

}  // namespace bemcal::run
