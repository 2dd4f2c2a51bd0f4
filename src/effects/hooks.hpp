/// Where effects enter: ONE row for each hook. Names, ranges, sites, messages, ways into
/// the building and the grammar's candidates all come from it.
///
/// A new hook is an enumerator (effect.hpp) and a row in hooks.cpp, at the same place.
#pragma once

#include "effects/hook_row.hpp"

#include <span>

namespace bemcal::effects {

/// In the order of Hook.
std::span<const HookRow> hook_rows();
const HookRow& row_of(Hook hook);

}  // namespace bemcal::effects
