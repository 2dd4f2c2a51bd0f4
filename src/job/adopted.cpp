/// Lays effects, structure, hours and functions that were found over a description, as
/// `adopt` writes them into a job, and sets the periods.
/// Follows from schema::lay_over: names that both have are one.
/// Leaves out periods that the study names: a loop's training is the first.
#include "job/adopted.hpp"

#include "description/building_readers.hpp"
#include "physics/calendar.hpp"
#include "schema/lay_over.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::job {

namespace {

/// What the building leaves out is the job's, also where something is laid over it.
void take_lists_of(const schema::Node& root, const schema::Node& over,
                   schema::Node& own) {
    for (const schema::Entry& entry : over.entries) {
        const schema::Node* shared = schema::find_node(root, entry.key);
        if (shared != nullptr && schema::find_node(own, entry.key) == nullptr)
            own.entries.push_back({entry.key, shared->line, *shared});
    }
}

/// Hours that were learned stand in place of those to be learned.
void forget_learning(const schema::Node& over, schema::Node& own) {
    const schema::Node* learned = schema::find_node(over, "schedule");
    const auto schedules =
        std::ranges::find(own.entries, "schedule", &schema::Entry::key);
    if (learned == nullptr || schedules == own.entries.end()) return;
    for (schema::Entry& schedule : schedules->node.entries)
        for (const schema::Entry& other : learned->entries) {
            const schema::Node* name = schema::find_node(schedule.node, "name");
            if (name == nullptr ||
                name->text != schema::find_node(other.node, "name")->text)
                continue;
            std::erase_if(schedule.node.entries, [](const schema::Entry& key) {
                return key.key == "hours" || key.key == "use";
            });
        }
}

/// From the begin of training to the end of the last period, by the description.
study::Period whole_period(const schema::Node& own, const schema::Section& root,
                           const std::string& file) {
    const schema::Section section(own, "building", file);
    const auto periods = description::read_periods({section, root});
    study::Period whole = periods.front();
    for (const study::Period& period : periods) whole.to = std::max(whole.to, period.to);
    return whole;
}

/// Training, and what has come since; without an earlier training, the last days.
std::string periods_text(const Adopted& adopted, const study::Period& whole) {
    const physics::Seconds end = whole.to;
    const auto line = [](const char* name, physics::Seconds from, physics::Seconds to) {
        return fmt::format("{} = [\"{}\", \"{}\"]\n", name, physics::format_time(from),
                           physics::format_time(to));
    };
    const study::Period& known = adopted.known;
    if (known.from >= known.to)
        return "[periods]\n" +
               line(known_period,
                    std::max(whole.from, end - std::chrono::days(static_cast<int>(
                                                   adopted.window_days))),
                    end);
    return "[periods]\n" + line(known_period, known.from, known.to) +
           (end > known.to ? line(new_period, known.to, end) : "");
}

}  // namespace

void lay_adopted(const Adopted& adopted, const schema::Section& root,
                 const std::string& file, schema::Node& own) {
    const study::Period whole = whole_period(own, root, file);
    const schema::Node over =
        schema::parse_document(adopted.text + periods_text(adopted, whole), file);
    take_lists_of(root.root(), over, own);
    forget_learning(over, own);
    schema::lay_over(over, own);
}

}  // namespace bemcal::job
