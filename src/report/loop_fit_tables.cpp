/// Errors of the plain model, of that with its structure chosen, and of that with
/// effects. A temperature's are in K, its bias being NMBE times the measured mean; the
/// others in %.
/// Made from the stored `fit` alone: errors are not computed again from the series.
/// Intervals without readings are left out.
#include "base/nan.hpp"
#include "report/loop_parts.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

using loop::StoredLoop;

/// One row: a channel in a period by the hour or month; a number for each model.
struct Row {
    std::string channel, unit;
    double n = 0;            ///< of the model that has most
    bool is_partly = false;  ///< a model has none, as its program's run failed
    std::array<double, StoredLoop::n_models> error{}, bias{};
    double within = nan;  ///< share of readings in after's 90 % intervals [%]
    bool is_measured() const { return n > 0; }
};

Row row_of(const StoredLoop& loop, std::size_t period, std::size_t resolution,
           std::size_t channel) {
    Row row{loop.channels[channel].name, "%"};
    row.within = 100 * loop.coverage.at({period, resolution, channel});
    const bool is_temperature = loop.channels[channel].unit == "degC";
    if (is_temperature) row.unit = "K";
    for (std::size_t model = 0; model < StoredLoop::n_models; ++model) {
        const auto number = [&](StoredLoop::Metric metric) {
            return loop.fit.at({model, period, resolution, channel, metric});
        };
        const double n = number(StoredLoop::n_readings);
        row.is_partly = row.is_partly || !(n > 0);
        row.n = std::fmax(row.n, n);
        const double rmse = number(StoredLoop::rmse), cv = number(StoredLoop::cv_rmse);
        row.error[model] = is_temperature ? rmse : 100 * cv;
        row.bias[model] = number(StoredLoop::nmbe) * (is_temperature ? rmse / cv : 100);
    }
    return row;
}

std::string fixed(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits)
                                : std::string("-");
}

void add_row(TextTable& table, const std::string& period, const std::string& interval,
             const Row& row) {
    const int digits = row.unit == "K" ? 2 : 1;
    std::vector<std::string> cells{period, row.channel, interval, in_short(row.n)};
    for (const double error : row.error) cells.push_back(fixed(error, digits));
    for (const double bias : row.bias) cells.push_back(fixed(bias, digits));
    cells.push_back(row.unit);
    cells.push_back(fixed(row.within, 0));
    table.add(std::move(cells));
}

/// "gas from 19.0 to 12.3 % (plain 24.1)"
std::string fall_of(const Row& row) {
    const int digits = row.unit == "K" ? 2 : 1;
    return fmt::format("{} from {} to {} {} (plain {})", row.channel,
                       fixed(row.error[StoredLoop::before], digits),
                       fixed(row.error[StoredLoop::after], digits), row.unit,
                       fixed(row.error[StoredLoop::plain], digits));
}

/// By the hour; where nothing is read by the hour, by the month.
std::string falls_in(const StoredLoop& loop, std::size_t period) {
    std::string text;
    for (std::size_t c = 0; c < loop.channels.size(); ++c) {
        const Row hourly = row_of(loop, period, StoredLoop::hourly, c),
                  monthly = row_of(loop, period, StoredLoop::monthly, c);
        if (!hourly.is_measured() && !monthly.is_measured()) continue;
        text += (text.empty() ? "" : ", ") +
                fall_of(hourly.is_measured() ? hourly : monthly) +
                (hourly.is_measured() ? "" : " by the month");
    }
    return text;
}

}  // namespace

std::string loop_headline(const StoredLoop& loop) {
    std::string text;
    for (std::size_t p = 1; p < loop.periods.size(); ++p) {
        const std::string falls = falls_in(loop, p);
        if (!falls.empty())
            text += wrapped(
                fmt::format("error in {}, before and after: {}", loop.periods[p], falls));
    }
    return text.empty() ? wrapped(
                              "no readings were held out: these are errors of the "
                              "training period, which any effect lowers")
                        : text;
}

std::string loop_fit_table(const StoredLoop& loop) {
    TextTable table({"error", "", "", "n", "plain", "before", "after", "bias: plain",
                     "before", "after", "", "in 90 %"});
    bool is_partly = false;
    for (std::size_t p = 0; p < loop.periods.size(); ++p)
        for (std::size_t c = 0; c < loop.channels.size(); ++c)
            for (std::size_t r = 0; r < loop.resolutions.size(); ++r) {
                const Row row = row_of(loop, p, r, c);
                if (!row.is_measured()) continue;
                add_row(table, loop.periods[p], loop.resolutions[r], row);
                is_partly = is_partly || row.is_partly;
            }
    std::string text = text_of(table, 18);
    if (text.empty()) return text;
    return text +
           "  in 90 %: share of the readings within the 90 % intervals of after [%]\n" +
           (is_partly ? "  -: no errors, as that run of the program failed\n" : "");
}

}  // namespace bemcal::report
