/// Numbers of a building by path (once, with words) and by target (often, without).
#include "physics/parameters.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::physics {

namespace {

using Words = std::vector<std::string>;

/// A number of the building under its full path, word by word.
struct Entry {
    Words words;
    Target target;
};

std::size_t row(int index) {
    return static_cast<std::size_t>(index);
}

void* part_in_zone(Zone& zone, Part part, std::size_t inner) {
    switch (part) {
        case Part::surface:
            return &zone.surfaces[inner];
        case Part::window:
            return &zone.windows[inner];
        case Part::flow:
            return &zone.flows[inner];
        case Part::load:
            return &zone.loads[inner];
        case Part::coupling:
            return &zone.couplings[inner];
        default:
            return &zone;
    }
}

void* part_at(Building& building, const Target& target) {
    switch (target.part) {
        case Part::construction:
            return &building.constructions[row(target.index)];
        case Part::glazing:
            return &building.glazings[row(target.index)];
        case Part::boundary:
            return &building.boundaries[row(target.index)];
        case Part::plant:
            return &building.plant;
        default:
            return part_in_zone(building.zones[row(target.index)], target.part,
                                row(target.inner));
    }
}

/// Adds an entry for every field of a part.
void add_fields(Target target, const Words& prefix, std::vector<Entry>& entries) {
    for (std::size_t field = 0; field < fields().size(); ++field) {
        if (fields()[field].part != target.part) continue;
        target.field = static_cast<int>(field);
        entries.push_back({prefix, target});
        entries.back().words.push_back(fields()[field].key);
    }
}

template <class Item>
void add_parts(Part part, const std::vector<Item>& items, std::vector<Entry>& entries) {
    for (std::size_t k = 0; k < items.size(); ++k)
        add_fields({part, static_cast<int>(k)}, {name_of(part), items[k].name}, entries);
}

template <class Item>
void add_inner(Part part, int zone, const Words& prefix, const std::vector<Item>& items,
               std::vector<Entry>& entries) {
    for (std::size_t k = 0; k < items.size(); ++k) {
        Words words = prefix;
        words.insert(words.end(), {name_of(part), items[k].name});
        add_fields({part, zone, static_cast<int>(k)}, words, entries);
    }
}

/// Couplings under the names of their other zones.
struct Named {
    std::string name;
};

std::vector<Named> coupled_zones(const Building& building, const Zone& zone) {
    std::vector<Named> names;
    for (const ZoneCoupling& coupling : zone.couplings)
        names.push_back({building.zones[row(coupling.zone)].name});
    return names;
}

void add_zone(const Building& building, int index, std::vector<Entry>& entries) {
    const Zone& zone = building.zones[row(index)];
    const Words words = {name_of(Part::zone), zone.name};
    add_fields({Part::zone, index}, words, entries);
    add_inner(Part::surface, index, words, zone.surfaces, entries);
    add_inner(Part::window, index, words, zone.windows, entries);
    add_inner(Part::flow, index, words, zone.flows, entries);
    add_inner(Part::load, index, words, zone.loads, entries);
    add_inner(Part::coupling, index, words, coupled_zones(building, zone), entries);
}

/// Every number of the building.
std::vector<Entry> entries_of(const Building& building) {
    std::vector<Entry> entries;
    add_parts(Part::construction, building.constructions, entries);
    add_parts(Part::glazing, building.glazings, entries);
    add_parts(Part::boundary, building.boundaries, entries);
    for (std::size_t zone = 0; zone < building.zones.size(); ++zone)
        add_zone(building, static_cast<int>(zone), entries);
    add_fields({Part::plant}, {name_of(Part::plant)}, entries);
    return entries;
}

Words split(const std::string& path) {
    Words words(1);
    for (char c : path) {
        if (c == '.')
            words.emplace_back();
        else
            words.back() += c;
    }
    return words;
}

/// How many words of the pattern an entry follows.
std::size_t words_in_common(const Words& pattern, const Words& words) {
    std::size_t n = 0;
    while (n < pattern.size() && n < words.size() &&
           (pattern[n] == "*" || pattern[n] == words[n]))
        ++n;
    return n;
}

/// Says where the path stops to make sense and what could stand there.
[[noreturn]] void reject_path(const std::string& path, const Words& pattern,
                              const std::vector<Entry>& entries) {
    std::size_t best = 0;
    for (const Entry& entry : entries)
        best = std::max(best, words_in_common(pattern, entry.words));
    Words next;
    for (const Entry& entry : entries)
        if (words_in_common(pattern, entry.words) == best && best < entry.words.size())
            next.push_back(entry.words[best]);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    const std::string before = fmt::format(
        "{}", fmt::join(pattern.begin(),
                        pattern.begin() + static_cast<std::ptrdiff_t>(best), "."));
    if (next.empty())
        throw std::invalid_argument(
            fmt::format("{}: nothing may follow {}", path, before));
    throw std::invalid_argument(fmt::format(
        "{}: {} {}; expected {}", path,
        best < pattern.size() ? fmt::format("there is no \"{}\"", pattern[best])
                              : std::string("the path is not complete"),
        best == 0 ? std::string("at its start") : "after " + before,
        fmt::join(next, ", ")));
}

double changed(double nominal, Effect effect, double value) {
    switch (effect) {
        case Effect::factor:
            return nominal * value;
        case Effect::offset:
            return nominal + value;
        default:
            return value;
    }
}

}  // namespace

const char* name_of(Part part) {
    constexpr const char* names[] = {"constructions", "glazings", "boundaries", "zones",
                                     "surfaces",      "windows",  "flows",      "loads",
                                     "plant",         "couplings"};
    return names[static_cast<std::size_t>(part)];
}

std::vector<Target> resolve(const Building& building, const std::string& path) {
    Words pattern = split(path);
    const bool low = pattern.size() > 1 && pattern.back() == "low";
    if (low) pattern.pop_back();
    const std::vector<Entry> entries = entries_of(building);
    std::vector<Target> targets;
    for (const Entry& entry : entries) {
        const bool matches = entry.words.size() == pattern.size() &&
                             words_in_common(pattern, entry.words) == pattern.size();
        if (!matches) continue;
        if (low && fields()[row(entry.target.field)].input == nullptr)
            throw std::invalid_argument(
                fmt::format("{}: {} does not change with time and has no low", path,
                            entry.words.back()));
        targets.push_back(entry.target);
        targets.back().low = low;
    }
    if (targets.empty()) reject_path(path, pattern, entries);
    return targets;
}

double& number_at(Building& building, const Target& target) {
    const Field& field = fields()[row(target.field)];
    void* part = part_at(building, target);
    if (field.constant != nullptr) return *field.constant(part);
    Input& input = *field.input(part);
    return target.low ? input.low : input.value;
}

double number_at(const Building& building, const Target& target) {
    return number_at(const_cast<Building&>(building), target);
}

void apply(const Building& nominal, std::span<const Parameter> parameters,
           std::span<const double> point, Building& building) {
    for (std::size_t k = 0; k < parameters.size(); ++k)
        for (const Target& target : parameters[k].targets)
            number_at(building, target) =
                changed(number_at(nominal, target), parameters[k].effect, point[k]);
}

}  // namespace bemcal::physics
