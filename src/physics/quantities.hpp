/// What meters measure and what brings energy to a building: ONE row for each quantity.
///
/// The words of a job file, the units, a plant's choices, the outputs of a retrofit, the
/// places of effects and the series in a result all come from here. A new quantity is an
/// enumerator, its carrier where it has one, and a row.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>

namespace bemcal::physics {

enum class Quantity { air_temperature, heating, cooling, electricity, gas, district };

/// What a plant or a load may draw; the quantity of the same name meters it.
enum class Carrier { none, electricity, gas, district };

/// What is measured: for all who treat some quantities alike.
enum class Measured {
    temperature,  ///< averaged over time; everything else is energy and summed
    heat,         ///< to or from the zones, before the plant
    electricity,  ///< follows people more than weather
    fuel          ///< what is burnt, or heat from a network
};

struct QuantityRow {
    Quantity quantity;
    const char* name;  ///< in a job file and in a result
    const char* unit;  ///< of `predict`
    Measured measured;
    Carrier carrier;      ///< that it meters; none = it is not a carrier's
    const char* noun;     ///< in a message
    const char* meaning;  ///< of its series in a result
};

inline constexpr QuantityRow quantity_rows[] = {
    {Quantity::air_temperature, "air_temperature", "degC", Measured::temperature,
     Carrier::none, "air temperature", "mean air temperature of the step"},
    {Quantity::heating, "heating", "kWh", Measured::heat, Carrier::none, "heating",
     "heat delivered in the step"},
    {Quantity::cooling, "cooling", "kWh", Measured::heat, Carrier::none, "cooling",
     "heat removed in the step"},
    {Quantity::electricity, "electricity", "kWh", Measured::electricity,
     Carrier::electricity, "electricity", "electricity drawn in the step"},
    {Quantity::gas, "gas", "kWh", Measured::fuel, Carrier::gas, "gas",
     "gas drawn in the step"},
    {Quantity::district, "district", "kWh", Measured::fuel, Carrier::district,
     "district heat", "district heat drawn in the step"},
};

inline constexpr std::size_t n_quantities = std::size(quantity_rows);

constexpr const QuantityRow& row_of(Quantity quantity) {
    return quantity_rows[static_cast<std::size_t>(quantity)];
}
constexpr const char* name_of(Quantity quantity) {
    return row_of(quantity).name;
}
constexpr const char* unit_of(Quantity quantity) {
    return row_of(quantity).unit;
}
/// None where it is not metered by a carrier.
constexpr Carrier carrier_of(Quantity quantity) {
    return row_of(quantity).carrier;
}
constexpr bool is_temperature(Quantity quantity) {
    return row_of(quantity).measured == Measured::temperature;
}

/// Words in the order of Quantity.
inline constexpr auto quantity_names = [] {
    std::array<const char*, n_quantities> names{};
    std::ranges::transform(quantity_rows, names.begin(), &QuantityRow::name);
    return names;
}();

/// Words in the order of Carrier: "none", then the names of their quantities.
inline constexpr auto carrier_names = [] {
    constexpr auto n = std::ranges::count_if(
        quantity_rows, [](Carrier of) { return of != Carrier::none; },
        &QuantityRow::carrier);
    std::array<const char*, 1 + n> names{"none"};
    for (const QuantityRow& row : quantity_rows)
        if (row.carrier != Carrier::none)
            names[static_cast<std::size_t>(row.carrier)] = row.name;
    return names;
}();

/// All but temperatures, in the order of Quantity.
inline constexpr auto energies = [] {
    constexpr auto n = std::ranges::count_if(
        quantity_rows, [](Measured is) { return is != Measured::temperature; },
        &QuantityRow::measured);
    std::array<Quantity, n> list{};
    std::size_t k = 0;
    for (const QuantityRow& row : quantity_rows)
        if (row.measured != Measured::temperature) list[k++] = row.quantity;
    return list;
}();

/// "electricity, gas or district heat".
std::string nouns_of_carriers();

}  // namespace bemcal::physics
