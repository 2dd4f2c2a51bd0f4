/// The catalogue: effects that buildings are known to have and models to lack, by name.
#pragma once

#include "effects/entry.hpp"
#include "effects/surroundings.hpp"

#include <span>

namespace bemcal::effects {

/// All rows; several may have the same number (forms of one effect), none the same name.
std::span<const Entry> catalogue();

/// The row's effect on days that were found in the data: `name` is that of a row with
/// Each::found_days ("holidays", "holidays with the plant running", "windows open on some
/// days"). Throws
/// std::invalid_argument for another.
Effect with_days(const std::string& name, std::vector<Days> days);
inline constexpr const char* name_of_other_hours = "other hours than declared";
/// The effect of that name.
Effect with_hours(OtherHours hours);
/// "holidays": all schedules as on Sunday.
Effect closed_days(std::vector<Days> days);

/// Every effect that can enter this building and has a say in this period: the
/// catalogue's with all of their shapes, facades and meters; not those on found days and
/// hours.
/// \param meters  that are measured
std::vector<Effect> named_candidates(const Surroundings& surroundings,
                                     std::span<const physics::Quantity> meters);
/// Those of the grammar beside it: admissible hook x driver x shape x gate that the
/// catalogue does not name.
std::vector<Effect> generic_candidates(const Surroundings& surroundings,
                                       std::span<const physics::Quantity> meters);

/// The row of that name; nullptr where the catalogue has none.
const Entry* entry_named(const std::string& name);
/// The catalogue's row; nullptr for an effect of the grammar.
const Entry* entry_of(const Effect& effect);

/// What the effect is in all readings; "" = nothing else.
std::string same_as(const Effect& effect);

/// `describe effects`: the catalogue and the grammar as text.
std::string describe();

}  // namespace bemcal::effects
