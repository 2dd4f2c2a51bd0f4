/// Learns hours by coordinate rounds over schedules and kinds of days, and says how
/// certain they are.
/// Follows from -2 log likelihood with priors, of which HourSearch takes each step; hours
/// as far from the usual ones are as likely before the readings.
/// Left out: two runs a day, other hours by season, runs through midnight.
#include "loop/learn_hours.hpp"

#include "loop/decisions.hpp"
#include "loop/hour_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

namespace bemcal::loop {
namespace {

using physics::DailyRun;
using physics::DayKind;
using physics::WeekHours;

/// Of -2 log prior. Eight hours that are not the usual ones are seven times less likely,
/// which a few weeks of readings outweigh.
double cost_of_departure(const DailyRun& run, const DailyRun& usual) {
    return decisions::cost_of_hour * physics::hours_apart(run, usual);
}

/// The first and last number between which 90 % of the weight lies.
std::pair<int, int> middle_of(const std::vector<double>& weights) {
    double all = 0;
    for (const double weight : weights) all += weight;
    int least = -1, most = 0;
    double below = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        if (below <= decisions::latest_of_hours * all && weights[k] > 0)
            most = static_cast<int>(k);
        below += weights[k];
        if (least < 0 && below >= decisions::earliest_of_hours * all)
            least = static_cast<int>(k);
    }
    return {std::max(least, 0), most};
}

/// How certain the run with the least cost is, by what all of them cost.
LearnedRun certainty_of(const std::vector<TriedRun>& tried) {
    const auto best = std::ranges::min_element(tried, {}, &TriedRun::cost);
    LearnedRun learned{best->run, 0, {}, {}};
    double sum = 0;
    std::vector<double> begins(25, 0.0), ends(25, 0.0);
    for (const TriedRun& one : tried) {
        const double weight = std::exp(-0.5 * (one.cost - best->cost));
        sum += weight;
        if (one.run.is_off()) continue;
        begins[static_cast<std::size_t>(one.run.from)] += weight;
        ends[static_cast<std::size_t>(one.run.until)] += weight;
    }
    learned.probability = 1 / sum;
    std::tie(learned.least.from, learned.most.from) = middle_of(begins);
    std::tie(learned.least.until, learned.most.until) = middle_of(ends);
    return learned;
}

std::vector<SearchedSchedule> schedules_of(const LoopData& data,
                                           const std::vector<LearnedHours>& learned) {
    std::vector<SearchedSchedule> schedules;
    schedules.reserve(learned.size());
    for (const LearnedHours& one : learned)
        schedules.push_back({ScheduleHours(data, one.profile), one.hours(), one.usual});
    return schedules;
}

}  // namespace

WeekHours LearnedHours::hours() const {
    WeekHours hours;
    for (std::size_t kind = 0; kind < hours.size(); ++kind) hours[kind] = runs[kind].run;
    return hours;
}

std::vector<LearnedHours> usual_hours_of(const study::Case& building) {
    std::vector<LearnedHours> learned;
    for (const study::UnknownHours& unknown : building.unknown_hours) {
        LearnedHours& one = learned.emplace_back();
        one.profile = unknown.profile;
        one.name = building.profiles[unknown.profile].name;
        one.use = unknown.use;
        one.usual = unknown.usual;
        for (std::size_t kind = 0; kind < one.runs.size(); ++kind)
            one.runs[kind].run = unknown.usual[kind];
    }
    return learned;
}

std::vector<LearnedHours> learn_hours(const LoopData& data, const Standing& standing,
                                      std::vector<LearnedHours> so_far) {
    const Place place = make_place(data, standing.model.structure, data.drive);
    HourSearch search(data, place, standing, schedules_of(data, so_far),
                      cost_of_departure, Tries::all);
    bool is_changed = true;
    for (int round = 0; round < decisions::most_hour_rounds && is_changed; ++round) {
        is_changed = false;
        for (std::size_t kind = 0; kind < physics::n_day_kinds; ++kind)
            for (std::size_t s = 0; s < so_far.size(); ++s) {
                LearnedRun& own = so_far[s].runs[kind];
                const DailyRun before = own.run;
                const auto tried =
                    search.improve(s, static_cast<DayKind>(kind), round == 0);
                if (!tried.empty()) own = certainty_of(tried);
                own.run = search.hours(s)[kind];
                is_changed = is_changed || own.run != before;
            }
        if (is_changed) search.settle_noise();
    }
    for (LearnedHours& one : so_far)
        one.evidence += cost_of(data, standing.noise, standing) -
                        cost_of(data, standing.noise, search.standing());
    return so_far;
}

bool have_same_hours(const std::vector<LearnedHours>& one,
                     const std::vector<LearnedHours>& other) {
    return std::ranges::equal(
        one, other, [](const auto& a, const auto& b) { return a.hours() == b.hours(); });
}

study::Case with_hours(const study::Case& building,
                       const std::vector<LearnedHours>& learned) {
    study::Case made = building;
    for (const LearnedHours& one : learned)
        physics::set_hours(one.hours(), made.profiles[one.profile].schedule);
    return made;
}

std::string sentence_of(const LearnedHours& learned) {
    std::string unsure;
    for (std::size_t kind = 0; kind < physics::n_day_kinds; ++kind)
        if (learned.runs[kind].probability < decisions::certain_hours)
            unsure += fmt::format("{}{} (probability {:.2f})", unsure.empty() ? "" : ", ",
                                  physics::name_of(static_cast<DayKind>(kind)),
                                  learned.runs[kind].probability);
    return fmt::format("schedule {}: {}; learned, nobody declared it{}{}", learned.name,
                       physics::sentence_of(learned.hours()),
                       unsure.empty() ? "" : "; not certain: ", unsure);
}

}  // namespace bemcal::loop
