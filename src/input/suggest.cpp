/// Finds the nearest of some words to one that is not among them, for messages.
/// Source: optimal string alignment, Levenshtein's distance with swaps of neighbours as
/// one change. Near is about a third of the letters.
/// Leaves out words of over 200 letters, and what words mean.
#include "input/suggest.hpp"

#include "base/matrix.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bemcal::input {

namespace {
constexpr std::size_t longest_compared = 200;  ///< letters; beyond it nothing is near
}

int edit_distance(std::string_view a, std::string_view b) {
    Matrix d(a.size() + 1, b.size() + 1);
    for (std::size_t i = 0; i <= a.size(); ++i) d(i, 0) = static_cast<double>(i);
    for (std::size_t j = 0; j <= b.size(); ++j) d(0, j) = static_cast<double>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const double replaced = d(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
            d(i, j) = std::min({d(i - 1, j) + 1, d(i, j - 1) + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d(i, j) = std::min(d(i, j), d(i - 2, j - 2) + 1);
        }
    }
    return static_cast<int>(d(a.size(), b.size()));
}

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
    if (word.size() > longest_compared) return "";
    std::string best;
    int least = static_cast<int>(word.size()) / 3 + 1;
    for (const std::string& other : words) {
        const int distance = edit_distance(word, other);
        if (distance > least || (distance == least && !best.empty())) continue;
        least = distance;
        best = other;
    }
    return best;
}

std::vector<std::string> by_nearness(std::string_view word,
                                     std::vector<std::string> words) {
    if (word.size() <= longest_compared)
        std::ranges::stable_sort(words, {}, [&](const std::string& other) {
            return edit_distance(word, other);
        });
    return words;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& words) {
    const std::string near = nearest(word, words);
    if (!near.empty()) return fmt::format("; did you mean \"{}\"?", near);
    if (words.empty()) return "";
    return fmt::format("; expected {}{}", words.size() > 1 ? "one of " : "",
                       fmt::join(words, ", "));
}

}  // namespace bemcal::input
