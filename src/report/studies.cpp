/// Finds the studies of a result by their dataset `kind`.
/// Follows from the layout. A result of version 0.1.0 has none: there a dataset that only
/// one kind stores tells it, here and nowhere else.
/// What a kind's tables are is in `tables`.
#include "report/studies.hpp"

namespace bemcal::report {
namespace {

/// What only this kind stored.
struct Mark {
    const char *leaf, *kind;
};
constexpr Mark marks_of_0_1_0[] = {{"stock_building", "stock"},
                                   {"total_order", "sensitivity"},
                                   {"series_total_order", "hourly_sensitivity"},
                                   {"guideline_14_count", "screening"},
                                   {"objective", "optimisation"},
                                   {"unknown", "posterior"},
                                   {"structure_chosen", "loop"},
                                   {"stage_points", "grid"},
                                   {"saving_quantile", "retrofit"},
                                   {"calibration_stage", "stages"}};

std::vector<StoredStudy> studies_of_0_1_0(const store::ResultFile& result) {
    std::vector<StoredStudy> studies;
    for (const Mark& mark : marks_of_0_1_0)
        for (Group& group : groups_with(result, mark.leaf))
            studies.push_back({mark.kind, std::move(group)});
    return studies;
}

}  // namespace

std::vector<StoredStudy> studies_in(const store::ResultFile& result) {
    std::vector<StoredStudy> studies;
    for (Group& group : groups_with(result, "kind"))
        if (const Texts word = group.texts("kind"); !word.empty())
            studies.push_back({word[0], std::move(group)});
    return studies.empty() ? studies_of_0_1_0(result) : studies;
}

std::vector<Group> studies_of_kind(const store::ResultFile& result,
                                   const std::string& kind) {
    std::vector<Group> groups;
    for (StoredStudy& study : studies_in(result))
        if (study.kind == kind) groups.push_back(std::move(study.group));
    return groups;
}

}  // namespace bemcal::report
