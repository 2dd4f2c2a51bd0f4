/// Units that people write, in those that the model counts in.
#pragma once

namespace bemcal {

inline constexpr double W_per_kW = 1000;

}  // namespace bemcal
