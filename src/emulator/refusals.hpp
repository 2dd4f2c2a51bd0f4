/// What emulators of series refuse: std::invalid_argument with a sentence.
#pragma once

#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::emulator {

template <typename... Arguments>
void refuse_if(bool condition, fmt::format_string<Arguments...> text,
               Arguments&&... arguments) {
    if (condition)
        throw std::invalid_argument(
            fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// \param values  [rows x cols]   \param what  "series", ...
inline void refuse_not_finite(std::span<const double> values, std::size_t cols,
                              const char* what) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            throw std::invalid_argument(
                fmt::format("{}: row {}, column {} is {}: expected a finite number", what,
                            i / cols + 1, i % cols + 1, values[i]));
}

}  // namespace bemcal::emulator
