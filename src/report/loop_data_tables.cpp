/// What a loop says of the data: decisions, structures tried, what can be seen and what
/// looks alike, alarms, and what is not explained.
/// Made from what is stored alone, the loop's limits too. Long lists are cut.
#include "report/loop_parts.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

using loop::StoredLoop;

constexpr std::size_t most_effects = 15, most_alarms = 10, longest_structure = 60;

/// Whether the data can show it.
bool can_be_seen(const StoredLoop& loop, const StoredLoop::Seen& effect) {
    return effect.detectability >= loop.least_detectability;
}

/// Those that can be seen, the most clearly seen first.
std::vector<const StoredLoop::Seen*> clearest_first(const StoredLoop& loop) {
    std::vector<const StoredLoop::Seen*> order;
    for (const StoredLoop::Seen& effect : loop.seen)
        if (can_be_seen(loop, effect)) order.push_back(&effect);
    std::ranges::stable_sort(order, std::ranges::greater{},
                             &StoredLoop::Seen::detectability);
    return order;
}

std::string unseen_line(const StoredLoop& loop) {
    std::vector<std::string> names;
    for (const StoredLoop::Seen& effect : loop.seen)
        if (!can_be_seen(loop, effect)) names.push_back(effect.effect);
    if (names.empty()) return {};
    return wrapped(
        fmt::format("would not be seen in these data (detectability below "
                    "{:g}): {}",
                    loop.least_detectability, fmt::join(names, ", ")));
}

/// What a structure ends with: those that were tried last differ there.
std::string end_of_structure(const std::string& name) {
    if (name.size() <= longest_structure) return name;
    const std::size_t from = name.find(" + ", name.size() - longest_structure + 2);
    return from == std::string::npos ? name : ".." + name.substr(from);
}

/// Pairs with the same signature, each once; those that the parameters are like,
/// together.
std::string alias_lines(const StoredLoop& loop) {
    const std::string_view of_parameters = name_of(loop::AliasKind::parameters);
    std::vector<std::string> pairs, followed;
    std::string parameters;  // in the words of the alias
    for (const StoredLoop::Seen& effect : loop.seen) {
        if (!(std::abs(effect.correlation) >= loop.same_signature)) continue;
        if (effect.alias_kind == of_parameters) {
            if (can_be_seen(loop, effect)) followed.push_back(effect.effect);
            parameters = effect.alias;
        } else if (std::ranges::find(pairs, effect.alias + " and " + effect.effect) ==
                   pairs.end())
            pairs.push_back(effect.effect + " and " + effect.alias);
    }
    std::string text;
    if (!pairs.empty())
        text += wrapped(fmt::format("cannot be told apart: {}", fmt::join(pairs, "; ")));
    if (!followed.empty())
        text += wrapped(
            fmt::format("{} do nearly the same as (told apart only where large): {}",
                        parameters, fmt::join(followed, ", ")));
    return text;
}

/// A cell of the localisation.
struct Alarm {
    std::size_t hook, driver;
    double before, after;
};

std::vector<Alarm> alarms_of(const StoredLoop& loop) {
    std::vector<Alarm> alarms;
    for (std::size_t h = 0; h < loop.hooks.size(); ++h)
        for (std::size_t d = 0; d < loop.drivers.size(); ++d) {
            const Alarm alarm{h, d, loop.localisation.at({h, d}),
                              loop.localisation_after.at({h, d})};
            if (alarm.before > 1 || alarm.after > 1) alarms.push_back(alarm);
        }
    std::ranges::stable_sort(alarms, std::ranges::greater{}, &Alarm::before);
    return alarms;
}

}  // namespace

std::string loop_decision_table(const StoredLoop& loop,
                                const std::vector<std::string>& of_data) {
    std::string lines;
    std::vector<std::string> shown;
    for (const StoredLoop::Decision& decision : loop.decisions) {
        if (decision.is_of_class()) continue;  // it stands with the power table
        shown.push_back(decision.finding);
        lines += finding_line(decision.series, decision.finding, decision.action);
    }
    return shown == of_data ? std::string() : lines;
}

std::string loop_structure_table(const StoredLoop& loop) {
    TextTable table({"structure tried", "score", ""});
    for (const StoredLoop::Structure& tried : loop.structures)
        table.add({end_of_structure(tried.name), three_digits(tried.score),
                   tried.name == loop.structure_chosen ? "chosen" : ""});
    std::string text = text_of(table, longest_structure), names, lines;
    for (const StoredLoop::Refinement& one : loop.refinements) {
        names += (names.empty() ? "" : " + ") + one.name;
        lines += wrapped(fmt::format("{}: {}", one.name, one.what));
    }
    if (!names.empty() && names != loop.structure_chosen)
        text += "  of it, needed beside the effects found:\n";
    return text + lines;
}

std::string loop_power_table(const StoredLoop& loop) {
    TextTable table({"effect in these data", "d", "visible", "most like", "r",
                     "left out it biases", "by sd"});
    const auto order = clearest_first(loop);
    for (std::size_t k = 0; k < std::min(order.size(), most_effects); ++k) {
        const StoredLoop::Seen& effect = *order[k];
        table.add({effect.effect, three_digits(effect.detectability),
                   percent(effect.visibility), effect.alias,
                   three_digits(effect.correlation), effect.parameter,
                   three_digits(effect.bias)});
    }
    return text_of(table, 21) + unseen_line(loop) + alias_lines(loop);
}

std::string loop_localisation_table(const StoredLoop& loop) {
    TextTable table({"pattern: seen from", "ordered by", "before", "after"});
    const std::vector<Alarm> alarms = alarms_of(loop);
    const std::size_t n = std::min(alarms.size(), most_alarms);
    for (std::size_t k = 0; k < n; ++k)
        table.add({loop.hooks[alarms[k].hook], loop.drivers[alarms[k].driver],
                   three_digits(alarms[k].before), three_digits(alarms[k].after)});
    std::string text = text_of(table, 36);
    if (alarms.size() > n)
        text += fmt::format("  and {} more above 1\n", alarms.size() - n);
    return text;
}

std::string loop_unexplained_table(const StoredLoop& loop) {
    TextTable table({"not explained", "of the variance", "where"});
    bool is_known = false;
    for (const StoredLoop::Channel& channel : loop.channels) {
        table.add(
            {channel.name, percent(channel.unexplained), channel.unexplained_where});
        is_known = is_known || !std::isnan(channel.unexplained);
    }
    return is_known ? text_of(table, 60) : std::string();
}

}  // namespace bemcal::report
