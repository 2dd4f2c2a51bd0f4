/// Words that are compared whatever the size of their letters.
#pragma once

#include <string>
#include <string_view>

namespace bemcal {

/// ASCII letters made small; others stay.
inline std::string lower_case(std::string_view text) {
    std::string made(text);
    for (char& c : made)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return made;
}

}  // namespace bemcal
