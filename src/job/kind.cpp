/// Names stages, and keeps the only one of a study.
/// Follows from the names of groups in a result.
/// What a kind does stands in its own file.
#include "job/kind.hpp"

namespace bemcal::job {

std::string stage_name(const StudySpec& study, const study::Case& building) {
    return building.name + "/" + study.name;
}

Stages only(std::unique_ptr<study::Stage> stage) {
    Stages stages;
    stages.push_back(std::move(stage));
    return stages;
}

}  // namespace bemcal::job
