/// Lists the units that meters are published in, and what brings each to kWh, kW or degC.
/// Source: Great Britain's Gas (Calculation of Thermal Energy) Regulations for the volume
/// correction of gas; ENERGY STAR Portfolio Manager, Technical Reference: Thermal Energy
/// Conversions, for gas by the CCF; Btu of the international table.
/// Gas of another heating value needs the meter's factor. Oil, steam and water are left
/// out.
#include "input/units.hpp"

namespace bemcal::input {

namespace {

/// Natural gas: gross calorific value 39.5 MJ/m3 with the volume correction 1.02264 of
/// Great Britain's Gas (Calculation of Thermal Energy) Regulations: 11.2 kWh/m3. 1 ft3 =
/// 0.0283168 m3.
constexpr double kwh_per_m3 = 39.5 * 1.02264 / 3.6;
constexpr double m3_per_ft3 = 0.028316846592;
constexpr double kwh_per_btu = 1055.05585262 / 3.6e6;  // international table
constexpr const char* gas = "natural gas, 39.5 MJ/m3 gross";

/// What the USA calls 100 ft3 of natural gas. 5 % less than Great Britain's, which is
/// richer and brought to another temperature.
constexpr double kbtu_per_ccf = 102.6;

constexpr Unit table[] = {
    {"kWh", UnitKind::energy, 1, 0, ""},
    {"Wh", UnitKind::energy, 1e-3, 0, ""},
    {"MWh", UnitKind::energy, 1e3, 0, ""},
    {"J", UnitKind::energy, 1 / 3.6e6, 0, ""},
    {"kJ", UnitKind::energy, 1 / 3600.0, 0, ""},
    {"MJ", UnitKind::energy, 1 / 3.6, 0, ""},
    {"GJ", UnitKind::energy, 1e3 / 3.6, 0, ""},
    {"kBtu", UnitKind::energy, 1e3 * kwh_per_btu, 0, ""},
    {"therm", UnitKind::energy, 1e5 * kwh_per_btu, 0, ""},
    {"m3", UnitKind::energy, kwh_per_m3, 0, gas},
    {"ft3", UnitKind::energy, kwh_per_m3* m3_per_ft3, 0, gas},
    {"100 ft3", UnitKind::energy, 100 * kwh_per_m3* m3_per_ft3, 0, gas},
    {"CCF", UnitKind::energy, kbtu_per_ccf * 1e3 * kwh_per_btu, 0,
     "natural gas of the USA, 102.6 kBtu"},
    {"W", UnitKind::power, 1e-3, 0, ""},
    {"kW", UnitKind::power, 1, 0, ""},
    {"MW", UnitKind::power, 1e3, 0, ""},
    {"degC", UnitKind::temperature, 1, 0, ""},
    {"K", UnitKind::temperature, 1, -273.15, ""},
    {"degF", UnitKind::temperature, 5.0 / 9, -160.0 / 9, ""},
};

}  // namespace

std::span<const Unit> units() {
    return table;
}

const Unit* find_unit(const std::string& name) {
    for (const Unit& unit : table)
        if (name == unit.name) return &unit;
    return nullptr;
}

}  // namespace bemcal::input
