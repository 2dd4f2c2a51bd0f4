/// Results of one job with different chains become one: draws side by side, cut to the
/// draws that each has.
/// Plain bookkeeping without a source. Convergence is computed again by posterior_tables;
/// predictions, and tables stored of single runs, stay those of the first.
#include "report/merge_chains.hpp"

#include "store/dataset_path.hpp"
#include "store/layout.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace bemcal::report {
namespace {

using store::ResultFile;
using study::Dataset;

std::string attribute(const ResultFile& result, const char* name) {
    const auto found = result.attributes.find(name);
    return found == result.attributes.end() ? std::string() : found->second;
}

/// Draws of the chains, or numbers of the sampler; not those of the prior.
bool is_of_chains(const Dataset& dataset) {
    const std::string group = store::leaf_of(store::group_of(dataset.path));
    return dataset.dims == std::vector<std::string>{"chain", "draw"} &&
           (group == "posterior" || group == "sample_stats") && dataset.texts.empty();
}

/// Numbers of chains, [first, end).
struct Chains {
    long long first = 0, end = 0;
};

Chains chains_of(const ResultFile& result) {
    const auto any = std::ranges::find_if(result.datasets, is_of_chains);
    if (any == result.datasets.end()) return {};
    const int first = std::atoi(attribute(result, "first_chain").c_str());
    return {first, first + static_cast<long long>(any->shape[0])};
}

/// A result, and which chains are in it.
struct Merged {
    ResultFile result;
    std::vector<Chains> chains;

    /// Whether the other one is of the same job, with chains that are not here.
    bool takes(const ResultFile& other) const {
        const Chains more = chains_of(other);
        return more.end > more.first && chains[0].end > chains[0].first &&
               attribute(result, "job") == attribute(other, "job") &&
               std::ranges::all_of(chains, [&](const Chains& own) {
                   return more.end <= own.first || own.end <= more.first;
               });
    }
};

/// The first draws of each chain.
std::vector<double> first_draws(const Dataset& dataset, std::size_t n_draws) {
    std::vector<double> values;
    values.reserve(dataset.shape[0] * n_draws);
    for (std::size_t chain = 0; chain < dataset.shape[0]; ++chain) {
        const auto begin = dataset.values.begin() +
                           static_cast<std::ptrdiff_t>(chain * dataset.shape[1]);
        values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(n_draws));
    }
    return values;
}

void append_chains(Dataset& to, const Dataset& from) {
    const std::size_t n_draws = std::min(to.shape[1], from.shape[1]);
    to.values = first_draws(to, n_draws);
    const std::vector<double> more = first_draws(from, n_draws);
    to.values.insert(to.values.end(), more.begin(), more.end());
    to.shape = {to.shape[0] + from.shape[0], n_draws};
}

/// What single runs said of convergence no longer holds.
void append_result(ResultFile& to, const ResultFile& from) {
    std::erase_if(to.datasets, [](const Dataset& d) {
        return d.path.ends_with("/shortfall") && !d.path.ends_with("/data/shortfall");
    });
    for (Dataset& dataset : to.datasets) {
        if (!is_of_chains(dataset)) continue;
        const auto same = std::ranges::find(from.datasets, dataset.path, &Dataset::path);
        if (same != from.datasets.end() && is_of_chains(*same))
            append_chains(dataset, *same);
    }
}

}  // namespace

std::vector<ResultFile> merge_chains(std::vector<ResultFile> results) {
    std::vector<Merged> all;
    for (ResultFile& result : results) {
        const Chains chains = chains_of(result);
        const auto same = std::ranges::find_if(
            all, [&](const Merged& merged) { return merged.takes(result); });
        if (same == all.end()) {
            all.push_back({std::move(result), {chains}});
        } else {
            append_result(same->result, result);
            same->chains.push_back(chains);
        }
    }
    std::vector<ResultFile> merged;
    merged.reserve(all.size());
    for (Merged& each : all) merged.push_back(std::move(each.result));
    return merged;
}

}  // namespace bemcal::report
