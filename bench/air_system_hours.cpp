/// What coils and fans take, hour by hour, from numbers of hours in a CSV.
/// Usage: air_system_hours < HOURS.csv > LOADS.csv
/// Columns have the names of AirHour's numbers in any order, and of AirKind's; those that
/// are left out keep their defaults. Prints heating,cooling,fan [W].
#include "physics/air_system.hpp"

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

using bemcal::physics::AirHour;
using bemcal::physics::AirKind;

namespace {

const struct {
    const char* name;
    double AirHour::* number;
} numbers[] = {{"heating", &AirHour::heating},
               {"cooling", &AirHour::cooling},
               {"theta_air", &AirHour::theta_air},
               {"theta_e", &AirHour::theta_e},
               {"w_e", &AirHour::w_e},
               {"q_e", &AirHour::q_e},
               {"q_inf", &AirHour::q_inf},
               {"moisture", &AirHour::moisture},
               {"heat_recovery", &AirHour::heat_recovery},
               {"available", &AirHour::available},
               {"q_design", &AirHour::q_design},
               {"least_flow", &AirHour::least_flow},
               {"fan_power", &AirHour::fan_power},
               {"fan_exponent", &AirHour::fan_exponent},
               {"fan_heat", &AirHour::fan_heat},
               {"theta_supply", &AirHour::theta_supply},
               {"bypass_factor", &AirHour::bypass_factor},
               {"coil_enthalpy", &AirHour::coil_enthalpy},
               {"economiser", &AirHour::economiser},
               {"frost_limit", &AirHour::frost_limit},
               {"least_w", &AirHour::least_w}};

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) found.push_back(cell);
    return found;
}

bool set(const std::string& name, double value, AirKind& kind, AirHour& hour) {
    if (name == "variable")
        kind.variable = value != 0;
    else if (name == "is_moist")
        kind.is_moist = value != 0;
    else if (name == "pressure")
        kind.pressure = value;
    else {
        for (const auto& known : numbers)
            if (name == known.name) {
                hour.*known.number = value;
                return true;
            }
        return false;
    }
    return true;
}

}  // namespace

int main() {
    std::string line;
    std::getline(std::cin, line);
    const std::vector<std::string> names = cells(line);
    fmt::print("heating,cooling,fan\n");
    for (int row = 2; std::getline(std::cin, line); ++row) {
        const std::vector<std::string> values = cells(line);
        AirKind kind;
        AirHour hour;
        for (std::size_t k = 0; k < names.size(); ++k)
            if (k >= values.size() ||
                !set(names[k], std::strtod(values[k].c_str(), nullptr), kind, hour)) {
                fmt::print(stderr, "row {}: no number '{}' of an hour of an air system\n",
                           row, names[k]);
                return 65;
            }
        const bemcal::physics::AirLoads loads = bemcal::physics::supply(kind, hour);
        fmt::print("{:.9g},{:.9g},{:.9g}\n", loads.heating, loads.cooling, loads.fan);
    }
}
