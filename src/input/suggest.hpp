/// "Did you mean ...?": the nearest of some words to one that is not among them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bemcal::input {

/// Levenshtein distance with swaps of neighbours counted once (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The nearest word, or an empty one where none is near (more than a third of the
/// letters).
std::string nearest(std::string_view word, const std::vector<std::string>& words);

/// The same words, the nearest first; those as near as others in their order.
std::vector<std::string> by_nearness(std::string_view word,
                                     std::vector<std::string> words);

/// "; did you mean \"x\"?", else "; expected one of a, b, c", else an empty text.
std::string suggestion(std::string_view word, const std::vector<std::string>& words);

}  // namespace bemcal::input
