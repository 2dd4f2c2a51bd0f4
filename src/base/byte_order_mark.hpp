/// The mark by which some programs begin a text in UTF-8; it is no part of it.
#pragma once

#include <string_view>

namespace bemcal {

inline std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (text.starts_with(mark)) text.remove_prefix(mark.size());
    return text;
}

}  // namespace bemcal
