/// Holds what meters show against the range of the model, and words what lies outside by
/// its factor, and by the units in which the same numbers would lie inside.
/// Follows from `study::ranges_of` and the table of units; Guideline 14's bias is the
/// tolerance of both.
/// A unit that is only named is not proven: a building may be described wrongly as well.
#include "job/model_range.hpp"

#include "description/words.hpp"
#include "input/units.hpp"
#include "job/kind.hpp"
#include "study/bias.hpp"
#include "study/datasets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::job {

namespace {

using study::MeterRange;

constexpr std::size_t most_units_named = 2;

/// As they are stored.
struct RangeNumber {
    const char* leaf;
    double MeterRange::* value;
};
constexpr RangeNumber range_numbers[] = {{"range_measured", &MeterRange::measured},
                                         {"range_nominal", &MeterRange::nominal},
                                         {"range_least", &MeterRange::least},
                                         {"range_most", &MeterRange::most},
                                         {"range_points", &MeterRange::n_points}};

/// By the index of the period.
std::map<std::size_t, std::set<std::string>> fitted_meters(const Job& job,
                                                           const study::Case& building) {
    std::map<std::size_t, std::set<std::string>> fitted;
    if (job.simulator) return fitted;  // studies are of the program, and not of its twin
    for (const StudySpec& study : job.studies) {
        if (study.kind->fitted == nullptr) continue;
        for (const Fitted& each : study.kind->fitted(study, building)) {
            const study::Period& period = period_of(building, each.period);
            const auto meters = each.meters.empty()
                                    ? description::names_of(building.meters)
                                    : each.meters;
            fitted[static_cast<std::size_t>(&period - building.periods.data())].insert(
                meters.begin(), meters.end());
        }
    }
    return fitted;
}

/// A unit that the numbers of a meter may be of.
struct OtherUnit {
    std::string name;
    double ratio = 1;  ///< of the total in it to the total as it was read
    double total = 0;  ///< [kWh]
};

/// \return kWh of a number of a row
double kwh_of(const input::Unit& unit, int row_s) {
    return unit.factor * (unit.kind == input::UnitKind::power ? row_s / 3600.0 : 1);
}

/// Whether a meter may be read in a unit: those of gas are for gas, and months have no
/// powers.
bool may_be(const input::Unit& unit, const study::Meter& meter) {
    const bool is_of_gas = *unit.source != '\0';
    if (unit.kind == input::UnitKind::temperature) return false;
    if (is_of_gas && meter.quantity != physics::Quantity::gas) return false;
    return unit.kind == input::UnitKind::energy ||
           meter.interval < physics::Interval::monthly;
}

/// Every unit that it may be, with its kWh.
std::vector<std::pair<std::string, double>> units_of(const study::Case& building,
                                                     const study::Meter& meter) {
    std::vector<std::pair<std::string, double>> units;
    for (const input::Unit& unit : input::units())
        if (may_be(unit, meter)) units.emplace_back(unit.name, kwh_of(unit, meter.row_s));
    units.emplace_back("kWh/m2", building.building.floor_area());
    return units;
}

bool is_new(const std::vector<OtherUnit>& units, double ratio) {
    return std::ranges::none_of(units, [&](const OtherUnit& other) {
        return std::abs(other.ratio / ratio - 1) < 1e-6;
    });
}

/// Units in which the numbers lie within the range, the nearest to the building as
/// described first.
std::vector<OtherUnit> fitting_units(const study::Case& building, const MeterRange& range,
                                     double limit) {
    const study::Meter& meter = building.meters[range.meter];
    const input::Unit* own = input::find_unit(meter.unit);
    const double kwh = own == nullptr ? 1 : kwh_of(*own, meter.row_s);
    std::vector<OtherUnit> fitting;
    for (const auto& [name, kwh_of_other] : units_of(building, meter)) {
        MeterRange other = range;
        other.measured *= kwh_of_other / kwh;
        if (other.is_reached(limit) && is_new(fitting, kwh_of_other / kwh))
            fitting.push_back({name, kwh_of_other / kwh, other.measured});
    }
    const double usual = range.nominal > 0 ? range.nominal : range.most;
    std::ranges::stable_sort(fitting, {}, [&](const OtherUnit& unit) {
        return std::abs(std::log(unit.total / usual));
    });
    if (fitting.size() > most_units_named) fitting.resize(most_units_named);
    return fitting;
}

/// "2.5" or "1/2.5"
std::string words_of_ratio(double ratio) {
    return ratio < 1 ? fmt::format("1/{:.4g}", 1 / ratio) : fmt::format("{:.4g}", ratio);
}

std::string words_of_units(const std::vector<OtherUnit>& units, const std::string& own) {
    if (units.empty()) return {};
    std::vector<std::string> words;
    words.reserve(units.size());
    for (const OtherUnit& unit : units)
        words.push_back(fmt::format("as {} {} (times {})", unit.name,
                                    study::words_of_energy(unit.total),
                                    words_of_ratio(unit.ratio)));
    return fmt::format("; its numbers were read as {}, and would lie in this range {}",
                       own, fmt::join(words, " or "));
}

/// "2.53", "2531"
std::string words_of_number(double number) {
    return number < 1000 ? fmt::format("{:.3g}", number) : fmt::format("{:.0f}", number);
}

/// "2.5 times the most that", "1/2.5 of the least that"
std::string words_of_factor(const MeterRange& range) {
    return range.measured > range.most
               ? fmt::format("{} times the most that",
                             words_of_number(range.measured / range.most))
               : fmt::format("1/{} of the least that",
                             words_of_number(range.least / range.measured));
}

}  // namespace

std::string words_of_range(const study::Case& building, const MeterRange& range) {
    const study::Meter& meter = building.meters.at(range.meter);
    const double limit = study::bias_limit(meter.interval);
    if (range.is_reached(limit)) return {};
    const std::string metered = fmt::format("{} in {}: metered {}", meter.name,
                                            building.periods[range.period].name,
                                            study::words_of_energy(range.measured));
    if (!(range.most > 0))
        return fmt::format(
            "{}, but the model has none at any of {:.0f} points over the "
            "ranges of its parameters: see [plant] and the meter's quantity",
            metered, range.n_points);
    return fmt::format(
        "{}, {} the model reaches, {} to {} ({:.0f} points over the ranges "
        "of its parameters){}",
        metered, words_of_factor(range), study::words_of_energy(range.least),
        study::words_of_energy(range.most), range.n_points,
        words_of_units(fitting_units(building, range, limit), meter.unit));
}

std::vector<FittedRange> fitted_ranges(const Job& job, const study::Case& building) {
    std::vector<FittedRange> ranges;
    for (const auto& [period, names] : fitted_meters(job, building))
        for (const MeterRange& range :
             study::ranges_of(building, period, {names.begin(), names.end()}))
            ranges.push_back({range, words_of_range(building, range)});
    return ranges;
}

std::vector<study::Dataset> range_datasets(const study::Case& building,
                                           const std::vector<FittedRange>& ranges) {
    if (ranges.empty()) return {};
    std::vector<std::string> meters, periods, beyond;
    for (const auto& [range, sentence] : ranges) {
        meters.push_back(building.meters[range.meter].name);
        periods.push_back(building.periods[range.period].name);
        beyond.push_back(sentence);
    }
    study::DatasetBuilder datasets(building.name + "/data");
    datasets.texts("range_meter", "range", std::move(meters));
    datasets.texts("range_period", "range", std::move(periods));
    for (const auto& [leaf, value] : range_numbers) {
        std::vector<double> column;
        column.reserve(ranges.size());
        for (const FittedRange& each : ranges) column.push_back(each.range.*value);
        datasets.vector(leaf, "range", std::move(column));
    }
    const std::string said = study::joined_sentences(beyond);
    if (!said.empty()) datasets.text("shortfall", said);
    return datasets.take();
}

}  // namespace bemcal::job
