/// Progress of a stage on stderr: counts, rate, and remaining time from the rate of this
/// run.
/// Plain arithmetic without a source: items are taken to be equally long. A log gets a
/// line every ten seconds, a terminal one that is written over.
#include "run/progress.hpp"

#include "base/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace bemcal::run {
namespace {

constexpr std::chrono::seconds log_interval{10};

}  // namespace

std::string format_duration(double seconds) {
    const auto total =
        static_cast<long long>(std::llround(std::min(std::max(seconds, 0.0), 1e9)));
    if (total < 3600) return fmt::format("{}:{:02}", total / 60, total % 60);
    return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
}

std::string progress_text(const std::string& stage, double n_simulations,
                          const Progress& progress, int round) {
    const bool is_known = n_simulations > 0;
    const double per_item = n_simulations / std::max(1, progress.items_total);
    const double done = progress.items_done - progress.items_known;
    const double left = progress.items_total - progress.items_done;
    const auto n_failed = static_cast<double>(progress.points_failed);
    std::string text = stage + ": ";
    if (!is_known) text += fmt::format("round {}: ", round);
    text += fmt::format("{} of {} items, ", progress.items_done, progress.items_total);
    if (is_known)
        text += fmt::format("{:.0f} ok, ",
                            std::max(0.0, per_item * progress.items_done - n_failed));
    text += fmt::format("{:.0f} failed", n_failed);
    if (!(done > 0 && progress.seconds > 0)) return text;
    if (is_known) text += fmt::format(", {:.0f}/s", per_item * done / progress.seconds);
    text += fmt::format(", {} left", format_duration(progress.seconds * left / done));
    return is_known ? text : text + " in this round";
}

ProgressLine::ProgressLine(std::string stage, long long n_simulations)
    : stage_(std::move(stage)),
      n_simulations_(static_cast<double>(n_simulations)),
      is_terminal_(::isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const Progress& progress) {
    const auto now = std::chrono::steady_clock::now();
    if (!is_terminal_ && now - shown_ < log_interval) return;
    shown_ = now;
    const std::string text = progress_text(stage_, n_simulations_, progress, round_);
    if (is_terminal_)
        print_raw(stderr, fmt::format("\r\x1b[K{:.100}", in_one_line(text)));
    else
        print(stderr, text + "\n");
}

void ProgressLine::clear() {
    if (is_terminal_) print_raw(stderr, "\r\x1b[K");
}

}  // namespace bemcal::run
