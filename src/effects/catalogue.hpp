/// The catalogue: effects that buildings are known to have and models to lack, by name.
#pragma once

#include "effects/surroundings.hpp"

#include <span>

namespace bemcal::effects {

/// What a row of the catalogue is tried on, beside its shapes.
enum class Each {
    once,
    facade,         ///< all facades with windows together, and each alone
    meter,          ///< every meter of the job that it can enter
    cooling_meter,  ///< that of cooling, where the job has it
    weekday,        ///< Monday to Friday
    summer_time,    ///< gates of summer time by the rules of the EU and the US
    found_days,     ///< days that a caller finds in the data (with_days)
    data            ///< none: the data are mended or masked, the building is not changed
};

/// One row: an effect with the shapes that its name covers, and what is said of it.
struct Entry {
    Effect effect;                ///< with its first shape
    std::vector<Shape> shapes{};  ///< that are tried; empty = that of the effect
    Each each = Each::once;
    const char* sentence = "";   ///< what it is
    const char* signature = "";  ///< what it leaves in the residual
    const char* like = "";       ///< what it can be mistaken for
    const char* same_as = "";    ///< what it is in all readings; "" = nothing
    const char* separates = "";  ///< the measurement that would tell them apart
};
/// All rows; several may have the same number (forms of one effect), none the same name.
std::span<const Entry> catalogue();

/// The row's effect on days that were found in the data: `name` is that of a row with
/// Each::found_days ("holidays", "windows open on some days"). Throws
/// std::invalid_argument for another.
Effect with_days(const std::string& name, std::vector<Days> days);
/// "holidays": all schedules as on Sunday.
Effect closed_days(std::vector<Days> days);

/// Every effect that can enter this building and has a say in this period: the
/// catalogue's with all of their shapes, facades and meters; not those on found days.
/// \param meters  that are measured
std::vector<Effect> named_candidates(const Surroundings& surroundings,
                                     std::span<const physics::Quantity> meters);
/// Those of the grammar beside it: admissible hook x driver x shape x gate that the
/// catalogue does not name.
std::vector<Effect> generic_candidates(const Surroundings& surroundings,
                                       std::span<const physics::Quantity> meters);

/// The catalogue's row; nullptr for an effect of the grammar.
const Entry* entry_of(const Effect& effect);

/// What the effect is in all readings; "" = nothing else.
std::string same_as(const Effect& effect);

/// `describe effects`: the catalogue and the grammar as text.
std::string describe();

}  // namespace bemcal::effects
