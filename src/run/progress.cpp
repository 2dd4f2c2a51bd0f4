/// Progress of a stage on stderr and in a file: counts, rate, and remaining time and end
/// from the rate of this run.
/// Plain arithmetic without a source: items are taken to be equally long. A log gets a
/// line every ten seconds, a terminal one that is written over.
#include "run/progress.hpp"

#include "base/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace bemcal::run {
namespace {

constexpr std::chrono::milliseconds terminal_interval{200};  ///< rounds may be shorter
constexpr std::chrono::seconds log_interval{10}, file_interval{1};
constexpr double least_of_clock_s = 60;  ///< below, the end is seen without a clock

/// Characters that fit into a line.
int width_of(int stream) {
    winsize size{};
    const bool is_told = ::ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return is_told ? size.ws_col - 1 : 100;
}

/// Items that this run has done, parts of those that run included.
double done_here(const StageWords& words, const Progress& progress, double share) {
    const int left = progress.items_total - progress.items_done;
    return progress.items_done - progress.items_known +
           share * std::min(left, words.n_threads);
}

std::string rate_text(const StageWords& words, const Progress& progress, double done) {
    const double per_second = done / progress.seconds;
    if (words.n_simulations > 0)
        return fmt::format(
            ", {:.0f}/s",
            words.n_simulations / std::max(1, progress.items_total) * per_second);
    const bool are_just_items = words.items == std::string_view("items");
    return are_just_items
               ? ""
               : fmt::format(", {:.3g} {} a minute", 60 * per_second, words.items);
}

}  // namespace

std::string format_duration(double seconds) {
    const auto total =
        static_cast<long long>(std::llround(std::min(std::max(seconds, 0.0), 1e9)));
    if (total < 3600) return fmt::format("{}:{:02}", total / 60, total % 60);
    return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
}

std::string end_text(std::time_t now, double seconds_left) {
    if (!(seconds_left >= least_of_clock_s)) return {};
    const std::time_t end =
        now + static_cast<std::time_t>(std::llround(std::min(seconds_left, 1e9)));
    std::tm today{}, then{};
    if (::localtime_r(&now, &today) == nullptr || ::localtime_r(&end, &then) == nullptr)
        return {};
    const bool is_today = today.tm_year == then.tm_year && today.tm_yday == then.tm_yday;
    const std::string date = is_today
                                 ? ""
                                 : fmt::format("{}-{:02}-{:02} ", then.tm_year + 1900,
                                               then.tm_mon + 1, then.tm_mday);
    return fmt::format(" (ends about {}{:02}:{:02})", date, then.tm_hour, then.tm_min);
}

std::string progress_text(const StageWords& words, const Progress& progress,
                          std::time_t now) {
    const bool is_known = words.n_simulations > 0;
    const double per_item = words.n_simulations / std::max(1, progress.items_total);
    const auto n_failed = static_cast<double>(progress.points_failed);
    std::string text = words.stage + ": ";
    if (!is_known) text += fmt::format("round {}: ", words.round);
    text += fmt::format("{} of {} {}, ", progress.items_done, progress.items_total,
                        words.items);
    if (is_known)
        text += fmt::format("{:.0f} ok, ",
                            std::max(0.0, per_item * progress.items_done - n_failed));
    text += fmt::format("{:.0f} failed", n_failed);
    const study::Activity& activity = progress.activity;
    const double share = std::clamp(activity.share, 0.0, 1.0);
    const double done = done_here(words, progress, share);
    if (done > 0 && progress.seconds > 0) {
        const double left = progress.seconds / done *
                            (progress.items_total - progress.items_known - done);
        text += rate_text(words, progress, done);
        text += fmt::format(", {} left{}{}", format_duration(left),
                            is_known ? "" : " in this round", end_text(now, left));
    }
    for (const std::string& more : {activity.text, activity.so_far})
        if (!more.empty()) text += "; " + more;
    return text;
}

RewrittenLine::RewrittenLine(int stream)
    : stream_(stream == STDOUT_FILENO ? stdout : stderr),
      is_terminal_(::isatty(stream) != 0) {}

void RewrittenLine::show(const std::string& text) {
    if (is_terminal_)
        print_raw(stream_, fmt::format("\r\x1b[K{:.{}}", in_one_line(text),
                                       width_of(::fileno(stream_))));
    else
        print(stream_, in_one_line(text) + "\n");
}

void RewrittenLine::clear() {
    if (is_terminal_) print_raw(stream_, "\r\x1b[K");
}

ProgressLine::ProgressLine(const study::Stage& stage, int n_threads, ProgressFile& file)
    : stage_(stage), file_(file), line_(STDERR_FILENO) {
    words_.stage = stage.name();
    words_.n_threads = n_threads;
    if (!stage.has_rounds())
        words_.n_simulations = static_cast<double>(stage.n_simulations());
}

void ProgressLine::show(const Progress& progress) {
    const auto now = Clock::now();
    const Clock::duration pause =
        line_.is_terminal() ? Clock::duration(terminal_interval) : log_interval;
    const bool is_to_show = now - shown_ >= pause;
    const bool is_to_file = now - filed_ >= file_interval;
    if (!is_to_show && !is_to_file) return;
    words_.items = stage_.items_are();
    const std::string text = progress_text(words_, progress, std::time(nullptr));
    if (is_to_show) {
        shown_ = now;
        line_.show(text);
    }
    if (is_to_file) {
        filed_ = now;
        file_.write(text);
    }
}

}  // namespace bemcal::run
