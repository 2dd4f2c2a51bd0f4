/// Finds working days on which a building was closed: each day's residual as a share of
/// what closing it would do, every third day simulated at a time; days far from the
/// others' shares are closed. First comes the calendar whose days they are.
/// Follows from least squares of a single day and the median of distances (times 1.4826).
/// Leaves out half days, extra working days, and meters read by the month.
#include "loop/closed_days.hpp"

#include "base/error.hpp"
#include "effects/catalogue.hpp"
#include "loop/calendar_days.hpp"
#include "loop/decisions.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace bemcal::loop {
namespace {

using decisions::days_closed_apart;

int day_of(physics::Seconds time) {
    return static_cast<int>(
        std::chrono::floor<std::chrono::days>(time).time_since_epoch().count());
}

/// Sums of a day: of its signature with the residual, and with itself.
struct DaySums {
    double with_residual = 0, with_itself = 0;
};

bool is_by_the_day(const kernel::Channel& channel) {
    return channel.interval != physics::Interval::monthly &&
           channel.interval != physics::Interval::annual;
}

/// Rows of the catalogue: all is closed, or people stay away.
constexpr const char* ways_to_close[] = {"holidays", "holidays with the plant running"};

/// Adds the sums of those days of the period whose number leaves `pass`.
/// \param way  of ways_to_close
void add_days(const LoopData& data, const Place& place, const Standing& standing,
              const char* way, int pass, std::map<int, DaySums>& sums) {
    const int first = day_of(data.training().from), last = day_of(data.training().to);
    std::vector<effects::Days> days;
    for (int day = first + pass; day < last; day += days_closed_apart)
        days.push_back({day, day, false});
    std::vector<effects::Effect> all = standing.model.effects;
    all.push_back(effects::with_days(way, std::move(days)));
    const BuiltModel built = build(place, all);
    Matrix point(1, built.unknowns.size());
    for (std::size_t k = 0; k + 1 < point.cols; ++k)
        point(0, k) = standing.built.unknowns[k].value(standing.fit.at.x[k]);
    point(0, point.cols - 1) = 1;
    const Matrix predicted = built.fit_model->predict(point);
    for (std::size_t c = 0; c < data.targets.n_channels(); ++c) {
        const ChannelNoise& noise = standing.noise[c];
        if (noise.share < decisions::closed_meter_share ||
            !is_by_the_day(data.targets.channels[c]))
            continue;
        for (std::size_t k = data.targets.first[c]; k < data.targets.first[c + 1]; ++k) {
            const int day = day_of(data.begins[k]);
            if ((day - first) % days_closed_apart != pass ||
                std::isnan(data.targets.measured[k]))
                continue;
            const double moved =
                (predicted(0, k) - standing.fit.at.predicted[k]) / noise.sigma;
            DaySums& of_day = sums[day];
            of_day.with_residual += moved * standing.residuals[k] / noise.sigma;
            of_day.with_itself += moved * moved;
        }
    }
}

/// Of an even number the upper one of the two in the middle.
double upper_median(std::vector<double> values) {
    std::ranges::nth_element(values,
                             values.begin() + static_cast<long>(values.size() / 2));
    return values[values.size() / 2];
}

/// Each day's share of a Sunday, of those days that would show it.
std::map<int, double> shares_of(const std::map<int, DaySums>& sums) {
    std::vector<double> sizes;
    sizes.reserve(sums.size());
    for (const auto& [day, of_day] : sums) sizes.push_back(of_day.with_itself);
    if (sizes.empty()) return {};
    const double typical = upper_median(std::move(sizes));
    std::map<int, double> shares;
    for (const auto& [day, of_day] : sums)
        if (of_day.with_itself > decisions::least_share_of_signature * typical &&
            of_day.with_itself > 0)
            shares[day] = of_day.with_residual / of_day.with_itself;
    return shares;
}

/// How the shares of ordinary days spread, by the median of their distances.
double spread_of(const std::map<int, double>& shares, double middle) {
    std::vector<double> distances;
    distances.reserve(shares.size());
    for (const auto& [day, share] : shares) distances.push_back(std::abs(share - middle));
    return 1.4826 * upper_median(std::move(distances));
}

DayShares distributed(std::map<int, double> shares) {
    if (shares.empty()) return {};
    std::vector<double> values;
    values.reserve(shares.size());
    for (const auto& [day, share] : shares) values.push_back(share);
    const double middle = upper_median(std::move(values));
    const double spread = spread_of(shares, middle);
    return {std::move(shares), middle, spread};
}

}  // namespace

std::vector<int> days_alone(const DayShares& days,
                            const std::optional<KeptCalendar>& calendar) {
    std::vector<int> closed;
    for (const auto& [day, share] : days.shares)
        if (share - days.middle > decisions::least_closed_deviation * days.spread &&
            share > decisions::least_closed_share &&
            share < decisions::most_closed_share && !(calendar && calendar->holds(day)))
            closed.push_back(day);
    return closed;
}

namespace {

bool is_weekend(int day) {
    return (day + 3) % 7 >= 5;  // 1 January 1970 was a Thursday
}

/// Those that a holiday changes.
DayShares working_days(DayShares days) {
    std::erase_if(days.shares, [](const auto& day) { return is_weekend(day.first); });
    return days;
}

/// Whether only a weekend lies between two days.
bool is_next_working_day(int day, int next) {
    for (int between = day + 1; between < next; ++between)
        if (!is_weekend(between)) return false;
    return true;
}

}  // namespace

std::vector<effects::Days> runs_of(const std::vector<int>& days) {
    std::vector<effects::Days> runs;
    for (const int day : days) {
        if (is_weekend(day)) continue;
        if (runs.empty() || !is_next_working_day(runs.back().last, day))
            runs.push_back({day, day, true});
        runs.back().last = day;
    }
    for (effects::Days& run : runs) {
        if (run.last - run.first + 1 < decisions::least_long_run) continue;
        while (is_weekend(run.first - 1)) --run.first;
        while (is_weekend(run.last + 1)) ++run.last;
    }
    return runs;
}

namespace {

std::optional<effects::Effect> closed_in(const LoopData& data, const Place& place,
                                         const Standing& standing, const char* way) {
    std::map<int, DaySums> sums;
    try {
        for (int pass = 0; pass < days_closed_apart; ++pass)
            add_days(data, place, standing, way, pass, sums);
    } catch (const CannotSimulate&) {
        return std::nullopt;  // nothing is scheduled
    }
    const DayShares days = distributed(shares_of(sums));
    if (days.shares.size() < decisions::least_days_shown) return std::nullopt;
    const study::YearSpan years = study::years_of(data.building.periods);
    const auto calendar = kept_calendar(working_days(days), years.first, years.last);
    std::vector<effects::Days> closed;
    if (calendar) closed = calendar->days;
    std::ranges::copy(runs_of(days_alone(days, calendar)), std::back_inserter(closed));
    if (closed.empty()) return std::nullopt;
    effects::Effect effect = effects::with_days(way, std::move(closed));
    if (calendar) effect.calendar = calendar->place;
    return effect;
}

}  // namespace

std::vector<effects::Effect> closed_days(const LoopData& data, const Place& place,
                                         const Standing& standing) {
    std::vector<effects::Effect> all;
    for (const char* way : ways_to_close)
        if (auto effect = closed_in(data, place, standing, way))
            all.push_back(std::move(*effect));
    return all;
}

}  // namespace bemcal::loop
