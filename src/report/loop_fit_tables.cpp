/// Errors of the plain model, of that with its structure chosen, and of that with
/// effects. A temperature's are in K, its bias being NMBE times the measured mean; the
/// others in %.
/// Made from the stored `fit` alone: errors are not computed again from the series.
/// Intervals without readings are left out.
#include "report/loop_parts.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::report {
namespace {

constexpr std::size_t n_models = 3;

/// One row: a channel in a period by the hour or month; a number for each model.
struct Row {
    std::string channel, unit;
    double n = 0;
    std::array<double, n_models> error{}, bias{};
    bool is_measured() const { return n > 0; }
};

/// The stored fit [model x period x resolution x channel x metric].
class Fits {
  public:
    explicit Fits(const Group& study)
        : study_(study), values_(study.values("fit")), metrics_(study.texts("metric")) {}

    Row row(std::size_t period, std::size_t resolution, std::size_t channel) const {
        Row row{study_.texts("channel")[channel], "%", 0, {}, {}};
        const bool is_temperature =
            text_at(study_.texts("channel_unit"), channel) == "degC";
        if (is_temperature) row.unit = "K";
        for (std::size_t model = 0; model < n_models; ++model) {
            const auto number = [&](const char* metric) {
                return at(model, period, resolution, channel, metric);
            };
            if (model == 0) row.n = number("n");
            const double mean = number("rmse") / number("cv_rmse");
            row.error[model] = is_temperature ? number("rmse") : 100 * number("cv_rmse");
            row.bias[model] = number("nmbe") * (is_temperature ? mean : 100);
        }
        return row;
    }

  private:
    double at(std::size_t model, std::size_t period, std::size_t resolution,
              std::size_t channel, const char* metric) const {
        const auto column = static_cast<std::size_t>(std::ranges::find(metrics_, metric) -
                                                     metrics_.begin());
        const std::size_t place = (model * study_.texts("period").size() + period) *
                                      study_.texts("resolution").size() +
                                  resolution;
        return number_at(values_, (place * study_.texts("channel").size() + channel) *
                                          metrics_.size() +
                                      column);
    }

    const Group& study_;
    const std::vector<double>& values_;
    const std::vector<std::string>& metrics_;
};

std::string fixed(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits)
                                : std::string("-");
}

std::string floor_of(const Group& study, const Row& row, std::size_t channel) {
    const double floor = number_at(study.values("noise_floor"), channel);
    return row.unit == "K" ? fixed(floor, 2) : fixed(100 * floor, 1);
}

void add_row(TextTable& table, const std::string& period, const std::string& interval,
             const Row& row, const std::string& floor) {
    const int digits = row.unit == "K" ? 2 : 1;
    std::vector<std::string> cells{period, row.channel, interval, in_short(row.n)};
    for (const double error : row.error) cells.push_back(fixed(error, digits));
    cells.push_back(floor);
    for (const double bias : row.bias) cells.push_back(fixed(bias, digits));
    cells.push_back(row.unit);
    table.add(std::move(cells));
}

/// "gas from 19.0 to 12.3 % (plain 24.1)"
std::string fall_of(const Row& row) {
    const int digits = row.unit == "K" ? 2 : 1;
    return fmt::format("{} from {} to {} {} (plain {})", row.channel,
                       fixed(row.error[1], digits), fixed(row.error[2], digits), row.unit,
                       fixed(row.error[0], digits));
}

/// By the hour; where nothing is read by the hour, by the month.
std::string falls_in(const Group& study, std::size_t period) {
    const Fits fits(study);
    std::string text;
    for (std::size_t c = 0; c < study.texts("channel").size(); ++c) {
        const Row hourly = fits.row(period, 0, c), monthly = fits.row(period, 1, c);
        if (!hourly.is_measured() && !monthly.is_measured()) continue;
        text += (text.empty() ? "" : ", ") +
                fall_of(hourly.is_measured() ? hourly : monthly) +
                (hourly.is_measured() ? "" : " by the month");
    }
    return text;
}

}  // namespace

std::string loop_headline(const Group& study) {
    const auto& periods = study.texts("period");
    std::string text;
    for (std::size_t p = 1; p < periods.size() && study.has("fit"); ++p) {
        const std::string falls = falls_in(study, p);
        if (!falls.empty())
            text += wrapped(
                fmt::format("error in {}, before and after: {}", periods[p], falls));
    }
    return text.empty() ? wrapped(
                              "no readings were held out: these are errors of the "
                              "training period, which any effect lowers")
                        : text;
}

std::string loop_fit_table(const Group& study) {
    const Fits fits(study);
    const auto &periods = study.texts("period"), &resolutions = study.texts("resolution");
    TextTable table({"error", "", "", "n", "plain", "before", "after", "floor",
                     "bias: plain", "before", "after", ""});
    for (std::size_t p = 0; p < periods.size() && study.has("fit"); ++p)
        for (std::size_t c = 0; c < study.texts("channel").size(); ++c)
            for (std::size_t r = 0; r < resolutions.size(); ++r) {
                const Row row = fits.row(p, r, c);
                if (row.is_measured())
                    add_row(table, periods[p], resolutions[r], row,
                            r == 0 ? floor_of(study, row, c) : "");
            }
    return text_of(table, 18);
}

}  // namespace bemcal::report
