/// Progress of a stage: one line that updates on a terminal, a plain line every ten
/// seconds in a log, and the same line in a file for `status`; counts, how far the items
/// are that run, rate, remaining time and when that is over in all of them.
#pragma once

#include "run/distribute.hpp"
#include "run/progress_file.hpp"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>

namespace bemcal::run {

/// What a line says of a stage itself.
struct StageWords {
    std::string stage;
    double n_simulations = 0;  ///< 0 = not known, or spread over rounds
    int n_threads = 1;         ///< of all ranks: so many items run at a time
    int round = 1;             ///< of a stage whose simulations are not known
    const char* items = "items";
};

/// "office/screening: 640 of 2000 items, 655360 ok, 12 failed, 81000/s, 12:05 left (ends
/// about 14:35)". Where the number of simulations is not known, a stage goes on in
/// rounds: "office/posterior: round 3: 0 of 2 items, 0 failed, 0:17 left in this round;
/// draw 40 of 200, acceptance 0.81; after 200 draws R-hat 1.020, ESS 310".
std::string progress_text(const StageWords& words, const Progress& progress,
                          std::time_t now);

std::string format_duration(double seconds);  ///< "0:07", "12:05", "3:12:05"

/// " (ends about 14:35)" by the machine's clock, with the date where it is another day's;
/// nothing of less than a minute.
std::string end_text(std::time_t now, double seconds_left);

/// A line that is written over on a terminal, and one below the other in a log.
class RewrittenLine {
  public:
    explicit RewrittenLine(int stream);  ///< STDOUT_FILENO or STDERR_FILENO
    ~RewrittenLine() { clear(); }
    RewrittenLine(const RewrittenLine&) = delete;
    RewrittenLine& operator=(const RewrittenLine&) = delete;
    bool is_terminal() const { return is_terminal_; }
    void show(const std::string& text);
    void clear();  ///< wipes the line, so that other text can be printed

  private:
    std::FILE* stream_;
    bool is_terminal_;
};

/// Of one stage, on rank 0.
class ProgressLine {
  public:
    ProgressLine(const study::Stage& stage, int n_threads, ProgressFile& file);
    void begin_round(int round) { words_.round = round; }
    void show(const Progress& progress);
    void clear() { line_.clear(); }

  private:
    using Clock = std::chrono::steady_clock;

    const study::Stage& stage_;
    ProgressFile& file_;
    StageWords words_;
    RewrittenLine line_;
    Clock::time_point shown_ = Clock::now(), filed_{};
};

}  // namespace bemcal::run
