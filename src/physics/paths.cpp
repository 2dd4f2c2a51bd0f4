/// Numbers of a building by path: matched word by word against the paths of all its
/// numbers. What does not match is explained from the same list.
/// Plain bookkeeping without a source. A star stands for a name only; changes of inputs
/// have no path. It makes the whole list anew, so it is not for points.
#include "physics/meters.hpp"
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
void add_inner(Part part, int index, const Words& prefix, const std::vector<Item>& items,
               std::vector<Entry>& entries) {
    for (std::size_t k = 0; k < items.size(); ++k) {
        Words words = prefix;
        words.insert(words.end(), {name_of(part), items[k].name});
        add_fields({part, index, static_cast<int>(k)}, words, entries);
    }
}

/// Couplings under the names of their other zones.
struct Named {
    std::string name;
};

std::vector<Named> coupled_zones(const Building& building, const Zone& zone) {
    std::vector<Named> names;
    names.reserve(zone.couplings.size());
    for (const ZoneCoupling& coupling : zone.couplings)
        names.push_back({building.zones[row_of(coupling.zone)].name});
    return names;
}

void add_layers(const Building& building, int index, std::vector<Entry>& entries) {
    const Construction& construction = building.constructions[row_of(index)];
    add_inner(Part::layer, index, {name_of(Part::construction), construction.name},
              construction.layers, entries);
}

void add_zone(const Building& building, int index, std::vector<Entry>& entries) {
    const Zone& zone = building.zones[row_of(index)];
    const Words words = {name_of(Part::zone), zone.name};
    add_fields({Part::zone, index}, words, entries);
    add_inner(Part::surface, index, words, zone.surfaces, entries);
    add_inner(Part::window, index, words, zone.windows, entries);
    add_inner(Part::flow, index, words, zone.flows, entries);
    add_inner(Part::load, index, words, zone.loads, entries);
    add_inner(Part::coupling, index, words, coupled_zones(building, zone), entries);
    if (zone.radiator)
        add_fields({Part::radiator, index}, {words[0], words[1], name_of(Part::radiator)},
                   entries);
}

/// Meters are named by what they show.
void add_meters(const Building& building, std::vector<Entry>& entries) {
    for (std::size_t k = 0; k < building.meter_factor.size(); ++k) {
        const auto quantity = static_cast<Quantity>(k);
        if (quantity != Quantity::air_temperature)
            add_fields({Part::meter, static_cast<int>(k)},
                       {name_of(Part::meter), name_of(quantity)}, entries);
    }
}

/// Every number of the building.
std::vector<Entry> entries_of(const Building& building) {
    std::vector<Entry> entries;
    add_parts(Part::construction, building.constructions, entries);
    for (std::size_t k = 0; k < building.constructions.size(); ++k)
        add_layers(building, static_cast<int>(k), entries);
    add_parts(Part::glazing, building.glazings, entries);
    add_parts(Part::boundary, building.boundaries, entries);
    for (std::size_t zone = 0; zone < building.zones.size(); ++zone)
        add_zone(building, static_cast<int>(zone), entries);
    add_parts(Part::air_system, building.air_systems, entries);
    add_fields({Part::plant}, {name_of(Part::plant)}, entries);
    add_meters(building, entries);
    return entries;
}

/// Declared effects: their coefficient, in all places where it stands.
void add_effects(const Building& building, std::vector<Entry>& entries) {
    for (const Coefficient& effect : building.effects)
        for (const Target& target : effect.targets)
            entries.push_back({{"effect", effect.name}, target});
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

/// Names stand at odd places, but never last; only they may be a star.
bool matches_word(const Words& pattern, const Words& words, std::size_t n) {
    const bool is_name = n % 2 == 1 && n + 1 < words.size();
    return pattern[n] == words[n] || (is_name && pattern[n] == "*");
}

/// How many words of the pattern an entry follows.
std::size_t words_in_common(const Words& pattern, const Words& words) {
    std::size_t n = 0;
    while (n < pattern.size() && n < words.size() && matches_word(pattern, words, n)) ++n;
    return n;
}

bool matches(const Words& pattern, const Words& words) {
    return pattern.size() == words.size() &&
           words_in_common(pattern, words) == words.size();
}

std::size_t longest_match(const Words& pattern, const std::vector<Entry>& entries) {
    std::size_t longest = 0;
    for (const Entry& entry : entries)
        longest = std::max(longest, words_in_common(pattern, entry.words));
    return longest;
}

/// The words that may follow the first n of the pattern, sorted.
Words next_words(const Words& pattern, std::size_t n, const std::vector<Entry>& entries) {
    Words next;
    for (const Entry& entry : entries)
        if (words_in_common(pattern, entry.words) == n && n < entry.words.size())
            next.push_back(entry.words[n]);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    return next;
}

/// Says where the path stops to make sense and what could stand there.
[[noreturn]] void reject_path(const std::string& path, const Words& pattern,
                              const std::vector<Entry>& entries) {
    if (path.empty())
        throw std::invalid_argument(
            "is empty; expected a path like zone.office.flow.infiltration.air_change");
    const std::size_t n = longest_match(pattern, entries);
    const Words next = next_words(pattern, n, entries);
    const Words good(pattern.begin(), pattern.begin() + static_cast<std::ptrdiff_t>(n));
    const std::string place =
        n == 0 ? "at its start" : fmt::format("after {}", fmt::join(good, "."));
    std::string what = "the path is not complete";
    if (n < pattern.size()) what = fmt::format("there is no \"{}\"", pattern[n]);
    if (next.empty()) what = "nothing may stand";
    const std::string instead =
        next.empty() ? "" : fmt::format("; expected {}", fmt::join(next, ", "));
    throw std::invalid_argument(fmt::format("{}: {} {}{}", path, what, place, instead));
}

void check_low(const std::string& path, const Entry& entry) {
    if (field_of(entry.target).input == nullptr)
        throw std::invalid_argument(fmt::format(
            "{}: {} does not change with time and has no low", path, entry.words.back()));
}

}  // namespace

std::vector<Target> resolve(const Building& building, const std::string& path) {
    Words pattern = split(path);
    const bool low = pattern.size() > 1 && pattern.back() == "low";
    if (low) pattern.pop_back();
    std::vector<Entry> entries = entries_of(building);
    add_effects(building, entries);
    std::vector<Target> targets;
    for (const Entry& entry : entries) {
        if (!matches(pattern, entry.words)) continue;
        if (low) check_low(path, entry);
        targets.push_back(where_now(building, entry.target));
        if (low) targets.back().slot = Slot::low;
    }
    if (targets.empty()) reject_path(path, pattern, entries);
    return targets;
}

std::string path_of(const Building& building, const Target& target) {
    for (const Entry& entry : entries_of(building)) {
        Target place = entry.target;
        place.slot = target.slot;
        if (!is_same_number(place, target)) continue;
        const char* part = target.slot == Slot::low ? ".low" : "";
        return fmt::format("{}{}", fmt::join(entry.words, "."), part);
    }
    throw std::invalid_argument("a number without a path");
}

std::vector<Target> inputs_of(const Building& building) {
    std::vector<Target> targets;
    for (const Entry& entry : entries_of(building))
        if (field_of(entry.target).input != nullptr) targets.push_back(entry.target);
    return targets;
}

std::vector<Target> inputs_that_follow(const Building& building, int profile) {
    Building copy = building;  // input_at() takes what may be written to
    std::vector<Target> targets = inputs_of(building);
    std::erase_if(targets, [&](const Target& target) {
        return input_at(copy, target)->profile != profile;
    });
    return targets;
}

}  // namespace bemcal::physics
