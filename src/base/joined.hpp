/// Words of a table in one text, made when the program is compiled: "gas|oil".
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace bemcal {

/// The words with a | between them, as the schema lists the words of a choice.
/// \tparam words  a constexpr array of const char*
template <const auto& words>
inline constexpr auto joined = [] {
    constexpr std::size_t size = [] {
        std::size_t n = 0;
        for (const char* word : words) n += std::string_view(word).size() + 1;
        return n;
    }();
    std::array<char, size> text{};
    std::size_t at = 0;
    for (const char* word : words) {
        if (at > 0) text[at++] = '|';
        for (const char letter : std::string_view(word)) text[at++] = letter;
    }
    return text;
}();

}  // namespace bemcal
