/// The patterns that a change without a name is held against: a table of kinds for each
/// meter.
/// Follows from what operation changes: a level, its hours, its days of the week.
/// Leaves out patterns of several meters, which effects with a name have.
#include "stock/patterns.hpp"

#include <fmt/format.h>

namespace bemcal::stock {

namespace {

constexpr int saturday = 5;
constexpr int hours_of_quarter = 6;

/// What a unit adds to a feature of a day.
struct Cell {
    const DayFeature& feature;
    bool is_weekend;
    double predicted;
    double level;  ///< of a unit a day: spread over the quarters
};
struct Kind {
    const char* name;
    bool is_share;       ///< of what is foretold, so none of a temperature
    bool is_of_quarter;  /// of one quarter; not of meters by the day
    double (*value)(const Cell& cell);
};
template <std::size_t quarter>
double in_quarter(const Cell& cell) {
    return cell.feature.quarter == quarter ? 1 : 0;
}
constexpr Kind kinds[] = {
    {"by a share", true, false, [](const Cell& cell) { return cell.predicted; }},
    {"all hours", false, false, [](const Cell& cell) { return cell.level; }},
    {"0 to 6 h", false, true, in_quarter<0>},
    {"6 to 12 h", false, true, in_quarter<1>},
    {"12 to 18 h", false, true, in_quarter<2>},
    {"18 to 24 h", false, true, in_quarter<3>},
    {"workdays", false, false,
     [](const Cell& cell) { return cell.is_weekend ? 0 : cell.level; }},
    {"weekends", false, false,
     [](const Cell& cell) { return cell.is_weekend ? cell.level : 0; }},
};

bool has(const DayFeature& feature, bool is_temperature, const Kind& kind) {
    return !(kind.is_share && is_temperature) &&
           !(kind.is_of_quarter && feature.is_whole_day);
}

Matrix values_of(const DaySums& sums, std::size_t meter, bool is_temperature,
                 const Kind& kind) {
    Matrix values(sums.n_days(), sums.features.size());
    for (std::size_t f = 0; f < sums.features.size(); ++f) {
        const DayFeature& feature = sums.features[f];
        if (feature.meter != meter) continue;
        const double level =
            feature.is_whole_day || is_temperature ? 1 : hours_of_quarter / 24.0;
        for (std::size_t d = 0; d < sums.n_days(); ++d) {
            const bool is_weekend =
                physics::calendar_step(sums.day_at(d)).weekday >= saturday;
            values(d, f) = kind.value({feature, is_weekend, sums.predicted(d, f), level});
        }
    }
    return values;
}

}  // namespace

std::vector<Pattern> meter_patterns(const study::Case& building, const DaySums& sums) {
    std::vector<Pattern> patterns;
    std::size_t last = building.meters.size();
    for (const DayFeature& feature : sums.features) {
        if (feature.meter == last) continue;
        last = feature.meter;
        const study::Meter& meter = building.meters[last];
        const bool is_temperature = physics::is_temperature(meter.quantity);
        for (const Kind& kind : kinds)
            if (has(feature, is_temperature, kind))
                patterns.push_back({fmt::format("{}: {}", meter.name, kind.name),
                                    kind.is_share    ? "1"
                                    : is_temperature ? "K"
                                                     : "kWh/d",
                                    values_of(sums, last, is_temperature, kind)});
    }
    return patterns;
}

}  // namespace bemcal::stock
