/// What a loop around another program concludes: what the search said of the residual,
/// with the program's own runs as plain, before and after.
#pragma once

#include "loop/results.hpp"
#include "loop/simulator_runs.hpp"
#include "study/hourly_simulator.hpp"

#include <string>
#include <vector>

namespace bemcal::loop {

/// Of what a search hands on beside its datasets: effects as they are given.
inline constexpr const char* given_group = "given";

/// \param written  the twin as the job has it   \param data  what was searched
study::Conclusion conclude_search(const std::string& stage, const LoopData& written,
                                  const LoopData& data, const LoopResult& result);

struct Around {
    std::string stage;  ///< "BUILDING/STUDY"
    const LoopData& written;
    const study::HourlySimulator& simulator;
    const std::vector<SimulatorRun>& runs;
    const RunsSoFar& so_far;                         ///< of them
    std::vector<std::string> runs_are_of;            ///< [runs] "design", ...
    const std::vector<study::GivenEffect>& effects;  ///< that were tried
    const KeptEffects& kept;            ///< [effects] that the program is better with
    const study::Conclusion& searched;  ///< empty where there was no search
};
study::Conclusion conclude_around(const Around& around);

}  // namespace bemcal::loop
