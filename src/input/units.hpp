/// Units that meters are published in, and what brings them to kWh or degC.
#pragma once

#include <span>
#include <string>

namespace bemcal::input {

enum class UnitKind { energy, power, temperature };

struct Unit {
    const char* name;
    UnitKind kind;
    double factor, offset;  ///< value x factor + offset is kWh, kW or degC
    const char* source;     ///< of the factor where it is not exact
};

std::span<const Unit> units();
/// nullptr for a name that is not in the table.
const Unit* find_unit(const std::string& name);

}  // namespace bemcal::input
