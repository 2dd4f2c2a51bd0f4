/// A building whose gas has wind infiltration in it, calibrated with effects.
#pragma once

#include "study/loop_baseline.hpp"
#include "study/windy_case.hpp"

#include <string>
#include <vector>

namespace bemcal::test {

struct WindyModel {
    explicit WindyModel(const std::vector<std::string>& names)
        : data(measured(), options()), place(study::make_place(data, {}, data.drive)) {
        study::LoopModel model;
        for (const std::string& name : names) model.effects.push_back(named(name));
        standing =
            study::calibrate(data, place, model,
                             std::vector<double>(place.unknowns.size() + names.size()));
    }
    static study::Case measured() {
        study::Case made = windy_case();
        measure(made, named("wind infiltration"), 0.08, 3);
        return made;
    }
    static study::LoopOptions options() {
        study::LoopOptions options;
        options.block_days = 7;
        return options;
    }

    study::LoopData data;
    study::Place place;
    study::Standing standing;
};

}  // namespace bemcal::test
