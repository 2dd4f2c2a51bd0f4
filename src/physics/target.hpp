/// Places in a building: which part, which of its numbers.
#pragma once

#include <cstddef>

namespace bemcal::physics {

enum class Part {
    construction,
    glazing,
    boundary,
    zone,
    surface,
    window,
    flow,
    load,
    plant,
    coupling,  ///< of a zone; its name is the other zone's
    meter,     ///< index = Quantity
    layer,     ///< of a construction
    radiator,  ///< of a zone, which has one or none
    air_system
};
const char* name_of(Part part);  ///< as in a job file: "construction", "zone", ...

/// Which of an input's numbers.
enum class Slot {
    value,
    low,
    change  ///< Input::changes[Target::change].amount
};

/// A place in a building that a parameter writes to.
struct Target {
    Part part = Part::zone;
    int index = 0;  ///< of the construction, glazing, boundary, zone or meter
    int inner = 0;  ///< of the surface, window, flow, load, coupling or layer in it
    int field = 0;  ///< row of fields()
    Slot slot = Slot::value;
    int change = 0;     ///< with Slot::change: which
    double weight = 1;  ///< with Slot::change: the parameter's value is multiplied by it
};

/// An index of a target in the list that it is of.
inline std::size_t row_of(int index) {
    return static_cast<std::size_t>(index);
}

/// Whether both are of one input, or the same constant.
inline bool is_of_same_field(const Target& a, const Target& b) {
    return a.part == b.part && a.index == b.index && a.inner == b.inner &&
           a.field == b.field;
}

/// Whether both are the same number.
inline bool is_same_number(const Target& a, const Target& b) {
    return is_of_same_field(a, b) && a.slot == b.slot && a.change == b.change;
}

}  // namespace bemcal::physics
