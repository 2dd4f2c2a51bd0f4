/// Reads and writes numbers of a building by target: part, index, field, slot. No words
/// and no allocation, since points come by the million.
/// Plain bookkeeping without a source. Ranges are not checked here; names are resolved in
/// paths.
#include "physics/numbers.hpp"

#include <utility>

namespace bemcal::physics {

namespace {

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
        case Part::radiator:
            return zone.radiator ? &*zone.radiator : nullptr;
        default:
            return &zone;
    }
}

void* part_at(Building& building, const Target& target) {
    switch (target.part) {
        case Part::construction:
            return &building.constructions[row_of(target.index)];
        case Part::layer:
            return &building.constructions[row_of(target.index)]
                        .layers[row_of(target.inner)];
        case Part::glazing:
            return &building.glazings[row_of(target.index)];
        case Part::boundary:
            return &building.boundaries[row_of(target.index)];
        case Part::air_system:
            return &building.air_systems[row_of(target.index)];
        case Part::plant:
            return &building.plant;
        case Part::meter:
            return &building.meter_factor[row_of(target.index)];
        default:
            return part_in_zone(building.zones[row_of(target.index)], target.part,
                                row_of(target.inner));
    }
}

}  // namespace

const char* name_of(Part part) {
    constexpr const char* names[] = {"construction", "glazing",   "boundary", "zone",
                                     "surface",      "window",    "flow",     "load",
                                     "plant",        "coupling",  "meter",    "layer",
                                     "radiator",     "air_system"};
    return names[static_cast<std::size_t>(part)];
}

const Field& field_of(const Target& target) {
    return fields()[row_of(target.field)];
}

const Coefficient* coefficient_at(const Building& building, const Target& target) {
    for (const Coefficient& effect : building.effects)
        for (const Target& own : effect.targets)
            if (is_same_number(own, target)) return &effect;
    return nullptr;
}

NumberInfo info_of(const Building& building, const Target& target) {
    if (const Coefficient* effect = coefficient_at(building, target))
        return {effect->name.c_str(), effect->unit.c_str(), effect->least, effect->most,
                "coefficient of the effect"};
    const Field& field = field_of(target);
    return {field.key, field.unit, field.least, field.most, field.sentence};
}

Target where_now(const Building& building, Target target) {
    for (const auto& [from, to] : building.moved) {
        if (!is_of_same_field(from, target)) continue;
        target.part = to.part;
        target.index = to.index;
        target.inner = to.inner;
        target.field = to.field;
        return target;
    }
    return target;
}

void move_input(Building& building, const Target& from, const Target& to) {
    *input_at(building, to) = std::exchange(*input_at(building, from), Input{});
    building.moved.push_back({from, to});
    const auto follow = [&](std::vector<Target>& targets) {
        for (Target& target : targets) target = where_now(building, target);
    };
    for (Coefficient& effect : building.effects) follow(effect.targets);
    for (Link& link : building.links) {
        follow(link.targets);
        follow(link.sources);
    }
}

Input* input_at(Building& building, const Target& target) {
    const Field& field = field_of(target);
    if (field.input == nullptr) return nullptr;
    return field.input(part_at(building, target));
}

double& number_at(Building& building, const Target& target) {
    const Field& field = field_of(target);
    void* part = part_at(building, target);
    if (field.constant != nullptr) return *field.constant(part);
    Input& input = *field.input(part);
    switch (target.slot) {
        case Slot::low:
            return input.low;
        case Slot::change:
            return input.changes[row_of(target.change)].amount;
        default:
            return input.value;
    }
}

double number_at(const Building& building, const Target& target) {
    return number_at(const_cast<Building&>(building), target);
}

}  // namespace bemcal::physics
