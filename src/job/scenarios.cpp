/// Reads how a scenario changes a number, and holds scenarios to names of their own.
/// Follows from the keys: one of them stands in each change; insulation is thickness over
/// conductivity.
/// What a change is made to is read by those who know its target.
#include "job/scenarios.hpp"

#include <set>

#include <fmt/format.h>

namespace bemcal::job {
namespace {

using retrofit::ChangeBy;

constexpr Way ways[] = {{"value", ChangeBy::value},
                        {"factor", ChangeBy::factor},
                        {"offset", ChangeBy::offset},
                        {"insulation", ChangeBy::resistance}};

}  // namespace

Way read_way(const schema::Section& change) {
    const Way* found = nullptr;
    for (const Way& way : ways) {
        if (!change.has(way.key)) continue;
        if (found != nullptr)
            change.fail(way.key, fmt::format("stands beside {}; expected one of value, "
                                             "factor, offset and insulation",
                                             found->key));
        found = &way;
    }
    if (found == nullptr)
        change.fail("target",
                    "has no change; expected value, factor, offset or insulation");
    Way way = *found;
    way.amount = change.number(way.key);
    const bool is_layer = way.by == ChangeBy::resistance;
    if (is_layer && !change.has("conductivity"))
        change.fail("insulation",
                    "has no conductivity beside it; expected that of the layer, as "
                    "conductivity = 0.035");
    if (!is_layer && change.has("conductivity"))
        change.fail("conductivity", "is of insulation, which is missing beside it");
    if (is_layer) way.amount /= change.number("conductivity");
    return way;
}

void each_scenario(const schema::Section& root,
                   const std::function<void(const schema::Section&)>& read) {
    std::set<std::string> names;
    const auto read_one = [&](const schema::Section& section) {
        read(section);
        if (!names.insert(section.text("name")).second)
            section.fail_value("name", "another scenario has this name");
    };
    if (!root.each("scenario", "scenario", read_one)) throw schema::Follows();
    if (names.empty())
        root.fail("scenario",
                  "is missing; expected sections [[scenario]], which a study "
                  "of kind \"retrofit\" applies");
}

}  // namespace bemcal::job
