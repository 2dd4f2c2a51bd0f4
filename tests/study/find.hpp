/// Finds a dataset by the last part of its path.
#pragma once

#include "study/stage.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace bemcal::test {

inline bool has(const std::vector<study::Dataset>& datasets, const std::string& leaf) {
    for (const auto& dataset : datasets)
        if (dataset.path.ends_with("/" + leaf)) return true;
    return false;
}

inline const study::Dataset& find(const std::vector<study::Dataset>& datasets,
                                  const std::string& leaf) {
    for (const auto& dataset : datasets)
        if (dataset.path.ends_with("/" + leaf)) return dataset;
    throw std::out_of_range("no dataset " + leaf);
}

}  // namespace bemcal::test
