/// Checks one meter's readings for zeros that mean missing, constant fills and steps of
/// the unit. Certain ones are masked, or scaled to the longest stretch's unit; others
/// stated.
/// Follows from `missing_zeros`, `constant_fills`, `scale_steps`, and a table of ratios.
/// Clocks are left to `check_clocks`, shared meters to `check_shared_meters`.
#include "checks/series.hpp"

#include "base/nan.hpp"
#include "checks/data_runs.hpp"
#include "checks/data_steps.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace bemcal::checks {

namespace {

using physics::Quantity;

struct UnitRatio {
    double ratio;
    const char* units;
};
/// Of two units that energy is published in.
constexpr UnitRatio ratios[] = {
    {2.832, "100 ft3 and m3"}, {3.412, "kBtu and kWh"},
    {3.6, "MJ and kWh"},       {4, "kW and kWh of 15 min"},
    {10, "a decimal place"},   {11.2, "m3 of gas and kWh"},
    {29.31, "therm and kWh"},  {31.7, "100 ft3 of gas and kWh"},
    {35.31, "ft3 and m3"},     {100, "two decimal places"},
    {277.8, "GJ and kWh"},     {293.1, "MMBtu and kWh"},
    {1000, "Wh and kWh"},      {1163, "Gcal and kWh"}};
constexpr double tolerance = 0.12;  ///< a week of weather changes the level as well

Driver driver_of(Quantity quantity) {
    using physics::Measured;
    const Measured measured = physics::row_of(quantity).measured;
    if (measured == Measured::temperature) return Driver::temperature;
    return measured == Measured::electricity ? Driver::people : Driver::weather;
}

/// The nearest known ratio, if one is near.
const UnitRatio* known_ratio(double ratio) {
    const auto distance = [&](const UnitRatio& known) {
        return std::abs(std::abs(std::log(ratio)) - std::log(known.ratio));
    };
    const UnitRatio* best = std::ranges::min_element(ratios, {}, distance);
    return distance(*best) < std::log(1 + tolerance) ? best : nullptr;
}

/// One meter's readings under the checks.
class ReadingChecks {
  public:
    ReadingChecks(input::RegularSeries& series, Quantity quantity,
                  const CheckOptions& options)
        : series_(series),
          data_(data_series(series.values, series.axis, quantity)),
          options_(options) {}

    std::vector<Finding> check() {
        check_zeros();
        check_constant();
        check_steps();
        return std::move(findings_);
    }

    /// Days repeat more easily than hours: two weekends, a rounded base load.
    std::vector<Finding> check_long_fills() {
        constexpr double least_h = 14 * 24;
        std::vector<Run> fills = constant_fills(data_);
        std::erase_if(fills, [&](const Run& run) { return hours_of(run.n) < least_h; });
        if (options_.constant == Handling::check)
            mask_found(fills, "the same value, longer than chance allows", "constant");
        return std::move(findings_);
    }

  private:
    std::string time_of(int step) const {
        return physics::format_time(series_.axis.begin_of(step));
    }
    double hours_of(int n) const { return n * series_.axis.step_s / 3600.0; }

    void mask(const std::vector<Run>& runs) {
        for (const Run& run : runs)
            std::fill_n(series_.values.begin() + run.first, run.n, nan);
    }

    /// "3 runs of WHAT, 50 h in all; the longest: 24 h from ..."
    std::string words_of(const std::vector<Run>& runs, const std::string& what) const {
        int total = 0;
        for (const Run& run : runs) total += run.n;
        const Run& longest = *std::ranges::max_element(runs, {}, &Run::n);
        return fmt::format("{} run{} of {}, {:g} h in all; the longest: {:g} h from {}",
                           runs.size(), runs.size() == 1 ? "" : "s", what,
                           hours_of(total), hours_of(longest.n), time_of(longest.first));
    }

    void mask_found(const std::vector<Run>& runs, const char* what, const char* key) {
        if (runs.empty()) return;
        mask(runs);
        findings_.push_back({words_of(runs, what),
                             fmt::format("masked; {} = \"keep\" would keep them", key)});
    }

    /// Runs longer than the job's limit, whatever they mean.
    void state_long(bool zeros, int hours, Handling handling) {
        const int least = static_cast<int>(3600LL * hours / series_.axis.step_s) + 1;
        const auto runs = constant_runs(series_.values, least, zeros);
        if (runs.empty()) return;
        const bool masked = handling == Handling::missing;
        if (masked) mask(runs);
        findings_.push_back(
            {words_of(runs, fmt::format("{} over {} h",
                                        zeros ? "zeros" : "the same value", hours)),
             masked ? "masked"
                    : fmt::format("kept; {} = \"missing\" would mask them",
                                  zeros ? "zeros" : "constant")});
    }

    void check_zeros() {
        if (options_.zeros == Handling::check)
            mask_found(missing_zeros(data_),
                       "zeros where it is well above 0 at the same hours of the days "
                       "around",
                       "zeros");
        state_long(true, options_.zero_run_h, options_.zeros);
    }

    void check_constant() {
        if (options_.constant == Handling::check)
            mask_found(constant_fills(data_), "the same value, longer than chance allows",
                       "constant");
        state_long(false, options_.constant_run_h, options_.constant);
    }

    /// Whether a step is one of the unit for certain.
    bool is_certain(const ScaleStep& step) const {
        return known_ratio(step.ratio) != nullptr &&
               (data_.driver == Driver::people || step.proof > Proof::scatter);
    }

    std::string words_of(const ScaleStep& step) const {
        const UnitRatio* known = known_ratio(step.ratio);
        return fmt::format("a step by {:.3g} from {} on, of all hours of the day alike{}",
                           step.ratio, time_of(step.at),
                           known == nullptr ? ", near no known ratio of units"
                                            : fmt::format(", near the {:g} of {}",
                                                          known->ratio, known->units));
    }

    void check_steps() {
        std::vector<ScaleStep> steps = scale_steps(data_);
        std::erase_if(steps, [&](const ScaleStep& step) {
            if (options_.steps == StepHandling::check && is_certain(step)) return false;
            findings_.push_back({words_of(step), "kept; [[meter.scale]] corrects it"});
            return true;
        });
        if (!steps.empty()) correct(steps);
    }

    /// Brings all stretches between steps to the unit of the longest.
    void correct(const std::vector<ScaleStep>& steps) {
        std::vector<int> bounds{0};
        std::vector<double> units{1};  ///< of each stretch, in the first one's
        for (const ScaleStep& step : steps) {
            const double known = known_ratio(step.ratio)->ratio;
            bounds.push_back(step.at);
            units.push_back(units.back() * (step.ratio > 1 ? known : 1 / known));
        }
        bounds.push_back(series_.axis.n_steps);
        std::size_t longest = 0;
        for (std::size_t i = 1; i < units.size(); ++i)
            if (bounds[i + 1] - bounds[i] > bounds[longest + 1] - bounds[longest])
                longest = i;
        for (std::size_t i = 0; i < units.size(); ++i) {
            const double factor = units[longest] / units[i];
            for (int k = bounds[i]; k < bounds[i + 1]; ++k)
                series_.values[static_cast<std::size_t>(k)] *= factor;
            if (factor != 1) note_factor(factor, bounds[i], bounds[i + 1]);
        }
        for (const ScaleStep& step : steps)
            findings_.push_back(
                {words_of(step), scaled_ + "steps = \"keep\" would keep them"});
    }

    void note_factor(double factor, int from, int to) {
        scaled_ += fmt::format("{} to {} scaled by {:.4g}; ", time_of(from), time_of(to),
                               factor);
    }

    input::RegularSeries& series_;
    DataSeries data_;
    const CheckOptions& options_;
    std::vector<Finding> findings_;
    std::string scaled_;
};

}  // namespace

DataSeries data_series(const std::vector<double>& values, const physics::TimeAxis& axis,
                       Quantity quantity) {
    const physics::CalendarStep first = physics::calendar_step(axis.start);
    const auto midnight = std::chrono::floor<std::chrono::days>(axis.start);
    return {values, physics::day_s / axis.step_s,
            static_cast<int>((axis.start - midnight).count() / axis.step_s),
            first.weekday, driver_of(quantity)};
}

std::vector<Finding> check_series(input::RegularSeries& series, Quantity quantity,
                                  const CheckOptions& options) {
    if (physics::day_s % series.axis.step_s != 0) return {};
    return ReadingChecks(series, quantity, options).check();
}

std::vector<Finding> check_days(input::RegularSeries& series, Quantity quantity,
                                const CheckOptions& options) {
    return ReadingChecks(series, quantity, options).check_long_fills();
}

}  // namespace bemcal::checks
