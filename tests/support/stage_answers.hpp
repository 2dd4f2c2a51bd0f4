/// A stage's items one after the other, without a pool.
#pragma once

#include "study/stage.hpp"

#include <vector>

namespace bemcal::test {

/// Of all rounds, by item.
inline std::vector<study::ItemAnswer> answers_of(study::Stage& stage) {
    std::vector<study::ItemAnswer> answers;
    for (int first = 0, count = stage.n_items(); count > 0;) {
        for (int item = first; item < first + count; ++item)
            answers.push_back(stage.run(item));
        const auto round = stage.next_round(answers);
        first += count;
        count = round ? round->n_items : 0;
        if (round) stage.begin_round(first, *round);
    }
    return answers;
}

}  // namespace bemcal::test
