/// How far the items of all ranks are, from what each rank tells.
/// Plain counting, without a source. Leaves out how ranks tell it (run/distribute).
#include "study/activity.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace bemcal::study {
namespace {

constexpr std::size_t most_texts = 4;  ///< of a line that is still read

/// Each text once; of many the first ones and a count.
std::string joined(std::vector<std::string> texts) {
    std::vector<std::string> distinct;
    for (std::string& text : texts)
        if (!text.empty() && std::ranges::find(distinct, text) == distinct.end())
            distinct.push_back(std::move(text));
    std::string all;
    for (std::size_t k = 0; k < std::min(distinct.size(), most_texts); ++k)
        all += (k == 0 ? "" : "; ") + distinct[k];
    if (distinct.size() > most_texts)
        all += fmt::format("; and of {} ranks more", distinct.size() - most_texts);
    return all;
}

}  // namespace

Activity of_all(const std::vector<Activity>& ranks) {
    Activity all;
    double least = 1;
    for (const Activity& rank : ranks) {
        all.share += rank.share * rank.n_items;
        all.n_items += rank.n_items;
        if (rank.n_items > 0) least = std::min(least, rank.share);
    }
    all.share = all.n_items > 0 ? all.share / all.n_items : 0;
    std::vector<std::string> texts;
    for (const Activity& rank : ranks)
        if (rank.n_items > 0 && rank.share <= least) texts.push_back(rank.text);
    all.text = joined(std::move(texts));
    if (!ranks.empty()) all.so_far = ranks.front().so_far;
    return all;
}

}  // namespace bemcal::study
