/// Masks codes and spikes, takes a register's differences, sets offsets below 0 to 0, and
/// asks where a meter seems to feed in or to count on, or a room to be in another unit.
/// Follows from the rules of `data_values`. Runs of zeros and of one value are left to
/// `check_series`.
#include "checks/values.hpp"

#include "base/nan.hpp"
#include "checks/data_readings.hpp"
#include "checks/data_values.hpp"
#include "physics/calendar.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace bemcal::checks {

namespace {

using physics::Quantity;

std::string time_of(const input::RegularSeries& series, int step) {
    return physics::format_time(series.axis.begin_of(step));
}

DataSeries data_of(const input::RegularSeries& series, Quantity quantity) {
    return data_series(series.values, series.axis, quantity);
}

double& reading(input::RegularSeries& series, int step) {
    return series.values[static_cast<std::size_t>(step)];
}

void put(input::RegularSeries& series, const std::vector<int>& steps, double value) {
    for (const int step : steps) reading(series, step) = value;
}

/// "3 readings of -9999, the first from 2021-03-05 14:00:00"
std::string words_of(const input::RegularSeries& series, const std::vector<int>& steps,
                     const std::string& what) {
    return fmt::format("{} reading{} {}, the first from {}", steps.size(),
                       steps.size() == 1 ? "" : "s", what,
                       time_of(series, steps.front()));
}

double least_of(input::RegularSeries& series, const std::vector<int>& steps) {
    double least = 0;
    for (const int step : steps) least = std::min(least, reading(series, step));
    return least;
}

/// The highest reading that is none of these steps.
double highest_but(input::RegularSeries series, const std::vector<int>& steps) {
    put(series, steps, nan);
    double highest = nan;
    for (const double value : series.values)
        if (!(value <= highest) && !std::isnan(value)) highest = value;
    return highest;
}

std::string values_at(input::RegularSeries& series, const std::vector<int>& steps) {
    constexpr std::size_t most_named = 3;
    std::string text;
    for (std::size_t k = 0; k < std::min(steps.size(), most_named); ++k)
        text += fmt::format("{}{:g}", k == 0 ? "" : ", ", reading(series, steps[k]));
    return text + (steps.size() > most_named ? ", ..." : "");
}

int n_known(const input::RegularSeries& series) {
    return static_cast<int>(std::ranges::count_if(
        series.values, [](double value) { return !std::isnan(value); }));
}

Question about_feeding_in(input::RegularSeries& series, const Negatives& found) {
    const int first = found.others.front();
    return {first,
            fmt::format(
                "{:g}, and {} of {} readings are below 0; a meter that only draws has "
                "none. Set negative = \"missing\" if they are faults, \"keep\" if it "
                "feeds in at times (the model only draws); if all readings have the "
                "other sign, write them without it",
                reading(series, first), found.others.size(), n_known(series))};
}

/// [degC], the middle reading: from cold stores to hot halls, and of most rooms.
constexpr double coldest_room = -40, hottest_room = 50;
constexpr double usual_least = 10, usual_most = 40;

/// What degC may be in truth.
struct RoomUnit {
    const char* advice;
    double factor, offset;  ///< value x factor + offset is degC
};
constexpr RoomUnit room_units[] = {{"unit = \"degF\"", 5.0 / 9, -160.0 / 9},
                                   {"unit = \"K\"", 1, -273.15},
                                   {"factor = 0.1", 0.1, 0},
                                   {"factor = 0.01", 0.01, 0}};

std::string advice_on_room(double middle, bool is_as_read) {
    std::string text;
    for (const RoomUnit& unit : room_units) {
        const double as = middle * unit.factor + unit.offset;
        if (is_as_read && as >= usual_least && as <= usual_most)
            text += (text.empty() ? "Write " : ", or ") + std::string(unit.advice);
    }
    return text.empty() ? "See unit and factor" : text;
}

}  // namespace

std::vector<Finding> mask_codes(input::RegularSeries& series, Quantity quantity) {
    std::vector<Finding> findings;
    for (const Code& code : codes_in(data_of(series, quantity))) {
        findings.push_back(
            {words_of(series, code.at,
                      fmt::format("of {:.12g}, a code for missing", code.value)),
             "masked; codes = \"keep\" would keep them"});
        put(series, code.at, nan);
    }
    return findings;
}

std::optional<Question> doubt_of_register(const input::RegularSeries& series,
                                          Quantity quantity) {
    if (physics::is_temperature(quantity)) return std::nullopt;
    const Course course = course_of(series.values);
    if (!is_register(course)) return std::nullopt;
    return Question{
        0, fmt::format("its readings rise {} times and fall {} times: a register that "
                       "counts on, not the use of each step. Set register = "
                       "\"difference\" to take its differences, \"keep\" if each reading "
                       "is a use",
                       course.n_rises, course.n_falls)};
}

std::vector<Finding> state_bills(const input::RegularSeries& series, Quantity quantity) {
    const Course course = course_of(series.values);
    if (physics::is_temperature(quantity) || !is_register_of_bills(course)) return {};
    return {
        {fmt::format("its bills rise {} times and never fall: perhaps what a register "
                     "shows",
                     course.n_rises),
         "kept as uses; register = \"difference\" would take the use from one to the "
         "next"}};
}

std::optional<Question> doubt_of_room(const input::RegularSeries& series,
                                      bool is_as_read) {
    std::vector<double> known = known_of(series.values);
    if (known.empty()) return std::nullopt;
    const double middle = quantile_of(std::move(known), 0.5);
    const auto is_odd = [](double value) {
        return value < coldest_room || value > hottest_room;
    };
    if (!is_odd(middle)) return std::nullopt;
    const auto first = std::ranges::find_if(series.values, is_odd);
    return Question{static_cast<int>(first - series.values.begin()),
                    fmt::format("half of its readings lie {} {:.4g} degC: no air of a "
                                "room. {}",
                                middle > hottest_room ? "above" : "below", middle,
                                advice_on_room(middle, is_as_read))};
}

namespace {

/// Counts become uses, one less.
std::vector<Finding> differences_in_place(std::vector<double>& counts) {
    const Course course = course_of(counts);
    counts = differences_of(counts);
    return {{fmt::format("a register that rises {} times and falls {} times",
                         course.n_rises, course.n_falls),
             "its differences are taken"}};
}

}  // namespace

std::vector<Finding> take_differences(input::RegularSeries& series) {
    auto findings = differences_in_place(series.values);
    series.axis.n_steps = static_cast<int>(series.values.size());
    return findings;
}

std::vector<Finding> take_differences(std::vector<input::Bill>& reads) {
    if (reads.empty()) return {};
    std::vector<double> uses;
    uses.reserve(reads.size());
    for (const input::Bill& read : reads) uses.push_back(read.value);
    auto findings = differences_in_place(uses);
    for (std::size_t k = 0; k < uses.size(); ++k) {
        reads[k].to = reads[k + 1].from;
        reads[k].value = uses[k];
    }
    reads.pop_back();
    return findings;
}

std::vector<Finding> mask_spikes(input::RegularSeries& series, Quantity quantity) {
    const std::vector<int> spikes = spikes_in(data_of(series, quantity));
    if (spikes.empty()) return {};
    std::vector<Finding> findings{
        {words_of(series, spikes,
                  fmt::format("far from all others ({}; the highest other one: {:g})",
                              values_at(series, spikes), highest_but(series, spikes))),
         "masked; spikes = \"keep\" would keep them"}};
    put(series, spikes, nan);
    return findings;
}

std::vector<Finding> check_negative(input::RegularSeries& series, Quantity quantity,
                                    Handling handling,
                                    std::optional<Question>& question) {
    Negatives found = negatives_in(data_of(series, quantity));
    std::vector<Finding> findings;
    if (handling != Handling::check) {
        found.others.insert(found.others.end(), found.offsets.begin(),
                            found.offsets.end());
        found.offsets.clear();
        std::ranges::sort(found.others);
    } else if (!found.are_few) {
        question = about_feeding_in(series, found);
        return findings;
    }
    const auto state = [&](const std::vector<int>& steps, double value,
                           const char* action) {
        if (steps.empty()) return;
        findings.push_back(
            {words_of(series, steps,
                      fmt::format("below 0, down to {:g}", least_of(series, steps))),
             action});
        if (value == value || handling != Handling::keep) put(series, steps, value);
    };
    state(found.offsets, 0, "taken as 0; negative = \"keep\" would keep them");
    state(found.others, nan,
          handling == Handling::keep ? "kept; negative = \"missing\" would mask them"
          : handling == Handling::missing
              ? "masked"
              : "masked; negative = \"keep\" would keep them");
    return findings;
}

}  // namespace bemcal::checks
