/// Numbers that follow from others: links (a polynomial, or a table's nearest row),
/// U-values from layers, capacity and mass area from a zone's surfaces.
/// Source: ISO 6946 (layers in series); ISO 13786, effective thickness for a day; ISO
/// 13790, 12.2.2 and 12.3.1. Left out: air gaps, periods other than a day; a surface
/// without layers has no capacity.
#include "physics/derived.hpp"

#include "physics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace bemcal::physics {
namespace {

constexpr double insulating = 0.08;  ///< conductivity of insulation [W/(m K)]
constexpr double day_depth = 0.1;    ///< largest effective thickness [m]

double polynomial(const Building& building, const Link& link) {
    double sum = 0;
    for (const Link::Term& term : link.terms) {
        double product = term.factor;
        for (std::size_t k = 0; k < link.sources.size(); ++k)
            product *= std::pow(number_at(building, link.sources[k]), term.exponents[k]);
        sum += product;
    }
    return sum;
}

const Link::Row& nearest_row(const Building& building, const Link& link) {
    const double key = number_at(building, link.sources[0]);
    return *std::min_element(link.rows.begin(), link.rows.end(),
                             [&](const Link::Row& a, const Link::Row& b) {
                                 return std::abs(a.key - key) < std::abs(b.key - key);
                             });
}

void follow(const Link& link, Building& building) {
    if (link.rows.empty()) {
        const double value = polynomial(building, link);
        for (const Target& target : link.targets) number_at(building, target) = value;
        return;
    }
    const Link::Row& row = nearest_row(building, link);
    for (std::size_t k = 0; k < link.targets.size(); ++k)
        number_at(building, link.targets[k]) = row.values[k];
}

/// C_m = sum kappa A, A_m = C_m^2 / sum kappa^2 A, over the floor area.
void set_capacity(const Building& building, Zone& zone) {
    double C_m = 0, squares = 0;
    for (const Surface& surface : zone.surfaces) {
        const double kappa = areal_capacity(
            building.constructions[static_cast<std::size_t>(surface.construction)]);
        C_m += kappa * surface.area;
        squares += kappa * kappa * surface.area;
    }
    zone.heat_capacity = C_m / zone.floor_area;
    zone.mass_area_ratio = squares > 0 ? C_m * C_m / squares / zone.floor_area : 0;
}

std::string_view key_of(const Target& target) {
    return field_of(target).key;
}

}  // namespace

double u_value_of(const Construction& construction) {
    double resistance =
        construction.external_resistance + construction.internal_resistance;
    for (const Layer& layer : construction.layers)
        resistance += layer.thickness / layer.conductivity;
    return 1 / resistance;
}

double areal_capacity(const Construction& construction) {
    double whole = 0;
    for (const Layer& layer : construction.layers) whole += layer.thickness;
    double left = std::min(day_depth, whole / 2), capacity = 0;
    for (auto layer = construction.layers.rbegin();
         layer != construction.layers.rend() && layer->conductivity > insulating;
         ++layer) {
        const double depth = std::min(left, layer->thickness);
        capacity += layer->density * layer->specific_heat * depth;
        left -= depth;
    }
    return capacity;
}

void derive(Building& building) {
    for (const Link& link : building.links) follow(link, building);
    for (Construction& construction : building.constructions)
        if (!construction.layers.empty())
            construction.u_value.value = u_value_of(construction);
    for (Zone& zone : building.zones)
        if (zone.capacity_of_layers) set_capacity(building, zone);
}

bool is_derived(const Building& building, const Target& target) {
    for (const Link& link : building.links)
        for (const Target& linked : link.targets)
            if (is_same_number(linked, target)) return true;
    return follows_from_layers(building, target);
}

bool follows_from_layers(const Building& building, const Target& target) {
    const auto index = static_cast<std::size_t>(target.index);
    if (target.slot != Slot::value) return false;
    if (target.part == Part::construction)
        return key_of(target) == "u_value" &&
               !building.constructions[index].layers.empty();
    if (target.part != Part::zone) return false;
    return building.zones[index].capacity_of_layers &&
           (key_of(target) == "heat_capacity" || key_of(target) == "mass_area_ratio");
}

bool has_derived(const Building& building) {
    return !building.links.empty() ||
           std::ranges::any_of(
               building.constructions,
               [](const Construction& each) { return !each.layers.empty(); }) ||
           std::ranges::any_of(building.zones, &Zone::capacity_of_layers);
}

}  // namespace bemcal::physics
