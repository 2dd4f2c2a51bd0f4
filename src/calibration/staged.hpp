/// Calibration in stages (paper 2): each stage calibrates some parameters on some
/// periods, starts from what another stage found, and hands on what it finds; the last
/// word have periods that no stage has seen.
///
/// A stage minimises an objective of optimisation.hpp over its periods taken together
/// (their readings as one series), by the methods of optimise/methods.hpp. A parameter
/// may have another value in another stage (paper 2's shading and air change by season):
/// a period is then judged with the values of the stage it names.
#pragma once

#include "calibration/period_model.hpp"
#include "calibration/staged_options.hpp"
#include "study/case.hpp"
#include "study/stage.hpp"

#include <memory>
#include <stdexcept>
#include <string>

namespace bemcal::calibration {

/// What is wrong with a stage, by its number in StagedOptions::stages.
struct StageFault : std::invalid_argument {
    StageFault(std::size_t n, const std::string& what)
        : std::invalid_argument(what), stage(n) {}
    std::size_t stage;
};

/// Throws StageFault for a stage's name that is not there, a range that is none, or no
/// reading in a period; std::invalid_argument for no stage, or a validation period that
/// overlaps one that a stage sees.
/// \param model  of each period
std::unique_ptr<study::Stage> make_staged(
    std::string name, const study::Case& building, StagedOptions options,
    const MakePeriodModel& model = own_period_model);

}  // namespace bemcal::calibration
