/// Holds what models predict against the readings, period after period.
/// Follows from `ReadingBands` and from the metrics of ASHRAE Guideline 14.
/// Where the predictions come from is left to the caller: a model, or the runs of another
/// program.
#include "loop/stored_fits.hpp"

#include "loop/late_clock.hpp"
#include "loop/level_change.hpp"
#include "loop/months.hpp"
#include "stats/distributions.hpp"
#include "stats/metrics.hpp"
#include "study/bias.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

/// \param predicted, left_out  of the channel
UnseenHours unseen_of_channel(std::span<const double> measured,
                              std::span<const double> predicted,
                              std::span<const double> left_out,
                              const std::vector<physics::Seconds>& begins) {
    UnseenHours unseen;
    if (measured.size() == begins.size())
        unseen = {begins,
                  {predicted.begin(), predicted.end()},
                  {left_out.begin(), left_out.end()}};
    for (std::size_t k = 0; k < unseen.begins.size(); ++k)
        if (std::isnan(measured[k])) unseen.residuals[k] = nan;
    return unseen;
}

void add_months(const std::vector<double>& predicted, const std::vector<Band>& bands,
                StoredPeriod::Channel& channel) {
    channel.month = predicted;
    for (const Band& band : bands) {
        channel.month_q05.push_back(band.least);
        channel.month_q95.push_back(band.most);
    }
}

/// Days, months or bills, on an axis of hours.
void add_readings(const kernel::Readings& meter, const physics::TimeAxis& axis,
                  StoredPeriod::Channel& channel) {
    const std::vector<int> bounds = physics::interval_bounds(axis, meter.interval);
    for (std::size_t k = 0; k < meter.values.size(); ++k) {
        channel.reading_begin.push_back(axis.begin_of(bounds[k]));
        channel.reading_end.push_back(axis.begin_of(bounds[k + 1]));
    }
    channel.reading_measured = meter.values;
}

}  // namespace

/// Mean outdoor temperature of each hour of the drive's period.
std::vector<double> outdoors_of(const physics::Drive& drive) {
    const auto per_hour = static_cast<std::size_t>(3600 / drive.axis.step_s);
    std::vector<double> hours;
    hours.reserve(drive.theta_e.size() / per_hour);
    for (auto k = static_cast<std::size_t>(drive.n_warm_up);
         k + per_hour <= drive.theta_e.size(); k += per_hour) {
        double sum = 0;
        for (std::size_t s = 0; s < per_hour; ++s) sum += drive.theta_e[k + s];
        hours.push_back(sum / static_cast<double>(per_hour));
    }
    return hours;
}

std::vector<UnseenHours> unseen_of(const LoopData& data,
                                   std::span<const double> predicted,
                                   std::span<const double> left_out) {
    const study::Targets& targets = data.targets;
    const physics::TimeAxis axis = study::axis_of(data.building, data.training());
    const auto begins = study::begins_of(axis, physics::Interval::hourly);
    std::vector<UnseenHours> all;
    all.reserve(data.meters.size());
    for (std::size_t c = 0; c < data.meters.size(); ++c)
        all.push_back(unseen_of_channel(targets.of(c, targets.measured),
                                        targets.of(c, predicted), targets.of(c, left_out),
                                        begins));
    return all;
}

FitsWriter::FitsWriter(const LoopData& data, const study::Case& readings,
                       const std::vector<UnseenHours>& unseen, int hours_late,
                       StoredLoop& stored)
    : data_(data), readings_(readings), hours_late_(hours_late), stored_(stored) {
    const auto& periods = data.building.periods;
    const std::size_t n_channels = data.meters.size();
    stored.fit.resize({StoredLoop::n_models, periods.size(), StoredLoop::n_resolutions,
                       n_channels, StoredLoop::n_metrics});
    stored.coverage.resize({periods.size(), StoredLoop::n_resolutions, n_channels});
    for (std::size_t c = 0; c < n_channels; ++c)
        bands_.emplace_back(unseen[c],
                            physics::is_temperature(data.targets.channels[c].quantity));
}

/// By how much a channel's level may differ from what is predicted, as a share.
double FitsWriter::level_of(const study::Period& period, std::size_t channel) const {
    const auto quantity = data_.targets.channels[channel].quantity;
    if (period.from == data_.training().from) return 0;
    const double usual = usual_level_change(quantity);
    return usual == 0 ? 0 : data_.options.level_change.value_or(usual);
}

StoredPeriod FitsWriter::add(const study::Period& period, const ModelHours& hours) {
    const physics::TimeAxis axis = study::axis_of(data_.building, period);
    const auto begins = study::begins_of(axis, physics::Interval::hourly);
    const auto readings = study::readings_of(readings_, period);
    const std::size_t p = period_++;
    StoredPeriod stored;
    stored.name = period.name;
    stored.begins = begins;
    stored.months = study::begins_of(axis, physics::Interval::monthly);
    stored.outdoor_temperature = by_late_clock_throughout(hours.outdoors, hours_late_);
    for (std::size_t c = 0; c < data_.meters.size(); ++c) {
        const kernel::Readings& meter = readings[data_.meters[c]];
        const bool is_hourly = meter.values.size() == begins.size();
        const std::vector<double> measured =
            is_hourly ? meter.values : std::vector<double>(begins.size(), nan);
        const bool is_mean = meter.quantity == physics::Quantity::air_temperature;
        const double level = level_of(period, c);
        for (std::size_t m = 0; m < hours.models.size(); ++m) {
            const auto& own = hours.models[m][c];
            const Months months = is_hourly ? months_of(begins, own, measured, is_mean)
                                            : read_by_month(begins, own, meter, axis);
            set_fit({m, p, StoredLoop::hourly, c}, stats::metrics_of(own, measured));
            set_fit({m, p, StoredLoop::monthly, c},
                    stats::metrics_of(months.simulated, months.measured));
            if (m == StoredLoop::after)
                stored_.coverage.set(
                    {p, StoredLoop::monthly, c},
                    share_within(bands_[c].months(months.simulated, level),
                                 months.measured));
        }
        stored.channels.push_back(channel_of(c, measured, hours));
        if (!is_hourly) add_readings(meter, axis, stored.channels.back());
        const auto& after = hours.models.back()[c];
        const auto bands = bands_[c].hours(after, begins, level);
        stored_.coverage.set({p, StoredLoop::hourly, c}, share_within(bands, measured));
        add_hours(bands, stored.channels.back());
        const auto whole = months_of(begins, after, after, is_mean).simulated;
        add_months(whole, bands_[c].months(whole, level), stored.channels.back());
    }
    return stored;
}

/// By the meters' clocks.
StoredPeriod::Channel FitsWriter::channel_of(std::size_t channel,
                                             const std::vector<double>& measured,
                                             const ModelHours& hours) const {
    StoredPeriod::Channel stored{stored_.channels[channel].name,
                                 by_late_clock(measured, hours_late_)};
    stored.simulated.shape = {hours.models.size(), measured.size()};
    for (const auto& model : hours.models) {
        const auto stamped = by_late_clock_throughout(model[channel], hours_late_);
        auto& all = stored.simulated.values;
        all.insert(all.end(), stamped.begin(), stamped.end());
    }
    return stored;
}

/// After's intervals, by the meters' clocks.
void FitsWriter::add_hours(const std::vector<Band>& bands,
                           StoredPeriod::Channel& channel) const {
    std::vector<double> least, most;
    for (const Band& band : bands) {
        least.push_back(band.least);
        most.push_back(band.most);
    }
    channel.q05 = by_late_clock_throughout(least, hours_late_);
    channel.q95 = by_late_clock_throughout(most, hours_late_);
}

void FitsWriter::set_fit(const FitPlace& at, const stats::FitMetrics& metrics) {
    const auto set = [&](StoredLoop::Metric metric, double value) {
        stored_.fit.set({at.model, at.period, at.resolution, at.channel, metric}, value);
    };
    set(StoredLoop::n_readings, metrics.n);
    set(StoredLoop::cv_rmse, metrics.cv_rmse);
    set(StoredLoop::nmbe, metrics.nmbe);
    set(StoredLoop::rmse, metrics.rmse);
}

study::Summary summary_of(const std::string& stage, const LoopData& data,
                          const StoredLoop& stored) {
    study::Summary summary;
    summary.study = stage;
    for (std::size_t k = 0; k < stored.parameters.size(); ++k) {
        const double value = stored.parameter_value.at({StoredLoop::after, k});
        if (std::isnan(value)) continue;  // its refinement has left
        const double half =
            stats::z_90_two_sided * stored.parameter_sd.at({StoredLoop::after, k});
        summary.values.push_back(
            {stored.parameters[k].name, value, value - half, value + half});
    }
    for (std::size_t p = 0; p < stored.periods.size(); ++p)
        for (std::size_t c = 0; c < data.meters.size(); ++c) {
            const auto error = [&](StoredLoop::Model model, StoredLoop::Metric metric) {
                const double hourly =
                    stored.fit.at({model, p, StoredLoop::hourly, c, metric});
                return std::isnan(hourly)  // of bills only months are known
                           ? stored.fit.at({model, p, StoredLoop::monthly, c, metric})
                           : hourly;
            };
            summary.fits.push_back({p, data.meters[c],
                                    error(StoredLoop::plain, StoredLoop::cv_rmse),
                                    error(StoredLoop::after, StoredLoop::cv_rmse),
                                    error(StoredLoop::after, StoredLoop::nmbe)});
        }
    const auto period =
        static_cast<std::size_t>(&data.training() - data.building.periods.data());
    summary.shortfall = study::bias_beyond(data.building, period, summary.fits);
    for (const StoredLoop::Effect& effect : stored.effects)
        summary.findings.push_back(
            {"loop",
             fmt::format("found: {}, {:.3g} {}", effect.name, effect.coefficient,
                         effect.unit),
             effect.is_adequate() ? "accepted" : "accepted, not adequate"});
    return summary;
}

}  // namespace bemcal::loop
