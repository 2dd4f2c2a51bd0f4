#include "run/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace bemcal::run {
namespace {

constexpr double log_interval = 10;  ///< [s]

}  // namespace

std::string format_duration(double seconds) {
    const auto total =
        static_cast<long long>(std::llround(std::min(std::max(seconds, 0.0), 1e9)));
    if (total < 3600) return fmt::format("{}:{:02}", total / 60, total % 60);
    return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
}

std::string progress_text(const std::string& stage, double n_simulations,
                          const Progress& progress) {
    const double per_item = n_simulations / std::max(1, progress.items_total);
    const double done = progress.items_done - progress.items_known;
    const double left = progress.items_total - progress.items_done;
    const auto n_failed = static_cast<double>(progress.points_failed);
    std::string text =
        fmt::format("{}: {} of {} items, {:.0f} ok, {:.0f} failed", stage,
                    progress.items_done, progress.items_total,
                    std::max(0.0, per_item * progress.items_done - n_failed), n_failed);
    if (done > 0 && progress.seconds > 0)
        text += fmt::format(", {:.0f}/s, {} left", per_item * done / progress.seconds,
                            format_duration(progress.seconds * left / done));
    return text;
}

ProgressLine::ProgressLine(std::string stage, long long n_simulations)
    : stage_(std::move(stage)),
      n_simulations_(static_cast<double>(n_simulations)),
      is_terminal_(::isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const Progress& progress) {
    if (!is_terminal_ && progress.seconds - shown_ < log_interval) return;
    shown_ = progress.seconds;
    const std::string text = progress_text(stage_, n_simulations_, progress);
    if (is_terminal_)
        fmt::print(stderr, "\r\x1b[K{:.100}", text);
    else
        fmt::print(stderr, "{}\n", text);
    std::fflush(stderr);
}

void ProgressLine::clear() {
    if (is_terminal_) fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

}  // namespace bemcal::run
