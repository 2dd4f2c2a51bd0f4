/// What a loop says of the data: decisions, structures tried, what can be seen and what
/// looks alike, alarms, and what is not explained.
/// Made from stored datasets alone. A detectability of 5 and a correlation of 0.98 are
/// the loop's limits, repeated here. Long lists are cut.
#include "report/loop_parts.hpp"
#include "report/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::report {
namespace {

constexpr double least_seen = 5;         ///< detectability
constexpr double same_signature = 0.98;  ///< correlation
constexpr std::size_t most_rows = 15, most_alarms = 10;

/// Indices of the values, the largest first, NaN last.
std::vector<std::size_t> from_the_largest(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        return values[a] > values[b] ||
               (values[a] == values[a] && values[b] != values[b]);
    });
    return order;
}

void add_power(TextTable& table, const Group& study, std::size_t k) {
    const auto number = [&](const char* leaf) {
        return three_digits(number_at(study.values(leaf), k));
    };
    table.add({text_at(study.texts("power_effect"), k), number("power_detectability"),
               percent(number_at(study.values("power_visibility"), k)),
               text_at(study.texts("power_alias"), k), number("power_alias_correlation"),
               text_at(study.texts("power_bias_parameter"), k), number("power_bias")});
}

std::string unseen_line(const Group& study) {
    std::vector<std::string> names;
    const auto& effects = study.texts("power_effect");
    for (std::size_t k = 0; k < effects.size(); ++k)
        if (!(number_at(study.values("power_detectability"), k) >= least_seen))
            names.push_back(effects[k]);
    if (names.empty()) return {};
    return wrapped(
        fmt::format("would not be seen in these data (detectability below "
                    "{:g}): {}",
                    least_seen, fmt::join(names, ", ")));
}

/// Pairs with the same signature, each once; those that the parameters are like,
/// together.
std::string alias_lines(const Group& study) {
    const std::string parameters = "the calibrated parameters themselves";
    std::vector<std::string> pairs, followed;
    const auto &effects = study.texts("power_effect"),
               &likes = study.texts("power_alias");
    for (std::size_t k = 0; k < std::min(effects.size(), likes.size()); ++k) {
        const double r = number_at(study.values("power_alias_correlation"), k);
        if (!(std::abs(r) >= same_signature)) continue;
        if (likes[k] == parameters) {
            if (number_at(study.values("power_detectability"), k) >= least_seen)
                followed.push_back(effects[k]);
        } else if (std::ranges::find(pairs, likes[k] + " and " + effects[k]) ==
                   pairs.end())
            pairs.push_back(effects[k] + " and " + likes[k]);
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

std::vector<Alarm> alarms_of(const Group& study) {
    const auto &before = study.values("localisation"),
               &after = study.values("localisation_after");
    const std::size_t n_drivers = study.texts("driver").size();
    std::vector<Alarm> alarms;
    for (std::size_t k = 0; k < before.size() && n_drivers > 0; ++k)
        if (before[k] > 1 || number_at(after, k) > 1)
            alarms.push_back(
                {k / n_drivers, k % n_drivers, before[k], number_at(after, k)});
    std::ranges::stable_sort(alarms, std::ranges::greater{}, &Alarm::before);
    return alarms;
}

}  // namespace

/// What was decided of the data: classes of effects and parameters stand with the power
/// table, and what the building's own table of its data has is not said again.
std::string loop_decision_table(const Group& study) {
    TextTable table({"data", "finding", "done about it"});
    const auto &series = study.texts("decision_series"),
               &findings = study.texts("decision_finding"),
               &effects = study.texts("power_effect");
    std::vector<std::string> shown;
    for (std::size_t k = 0; k < series.size(); ++k) {
        if (std::ranges::find(effects, series[k]) != effects.end() &&
            text_at(findings, k).starts_with("one class with "))
            continue;
        shown.push_back(text_at(findings, k));
        table.add({series[k], shown.back(), text_at(study.texts("decision_action"), k)});
    }
    const std::string& path = study.path();
    const Group data = study.elsewhere(path.substr(0, path.rfind('/')) + "/data");
    return shown == data.texts("finding") ? std::string() : text_of(table, 38);
}

std::string loop_structure_table(const Group& study) {
    const auto &names = study.texts("structure"),
               &chosen = study.texts("structure_chosen");
    TextTable table({"structure tried", "score", ""});
    for (std::size_t k = 0; k < names.size(); ++k)
        table.add({names[k], three_digits(number_at(study.values("structure_score"), k)),
                   !chosen.empty() && chosen[0] == names[k] ? "chosen" : ""});
    return text_of(table, 60);
}

std::string loop_power_table(const Group& study) {
    const auto& detectability = study.values("power_detectability");
    TextTable table({"effect in these data", "d", "visible", "most like", "r",
                     "left out it biases", "by sd"});
    const std::vector<std::size_t> order = from_the_largest(detectability);
    for (std::size_t i = 0; i < std::min(order.size(), most_rows); ++i)
        if (detectability[order[i]] >= least_seen) add_power(table, study, order[i]);
    return text_of(table, 21) + unseen_line(study) + alias_lines(study);
}

std::string loop_localisation_table(const Group& study) {
    TextTable table({"alarm: seen from", "ordered by", "before", "after"});
    const std::vector<Alarm> alarms = alarms_of(study);
    const std::size_t n = std::min(alarms.size(), most_alarms);
    for (std::size_t k = 0; k < n; ++k)
        table.add({text_at(study.texts("hook"), alarms[k].hook),
                   text_at(study.texts("driver"), alarms[k].driver),
                   three_digits(alarms[k].before), three_digits(alarms[k].after)});
    std::string text = text_of(table, 36);
    if (alarms.size() > n)
        text += fmt::format("  and {} more above 1\n", alarms.size() - n);
    return text;
}

std::string loop_unexplained_table(const Group& study) {
    TextTable table({"not explained", "of the variance", "where"});
    const auto& channels = study.texts("channel");
    for (std::size_t c = 0; c < channels.size() && study.has("unexplained"); ++c)
        table.add({channels[c], percent(number_at(study.values("unexplained"), c)),
                   text_at(study.texts("unexplained_where"), c)});
    return text_of(table, 60);
}

}  // namespace bemcal::report
