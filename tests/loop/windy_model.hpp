/// A building whose gas has wind infiltration in it, calibrated with effects.
#pragma once

#include "loop/baseline.hpp"
#include "loop/windy_case.hpp"

#include <string>
#include <vector>

namespace bemcal::test {

struct WindyModel {
    explicit WindyModel(const std::vector<std::string>& names)
        : data(measured(), options()), place(loop::make_place(data, {}, data.drive)) {
        loop::LoopModel model;
        for (const std::string& name : names) model.effects.push_back(named(name));
        standing =
            loop::calibrate(data, place, model,
                            std::vector<double>(place.unknowns.size() + names.size()));
    }
    static study::Case measured() {
        study::Case made = windy_case();
        measure(made, named("wind infiltration"), 0.08, 3);
        return made;
    }
    static loop::LoopOptions options() {
        loop::LoopOptions options;
        options.block_days = 7;
        return options;
    }

    loop::LoopData data;
    loop::Place place;
    loop::Standing standing;
};

}  // namespace bemcal::test
