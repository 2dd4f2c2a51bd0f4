/// Looks up summaries of studies, and values in them, by name.
/// Plain search without a source, linear in their number.
/// What a summary says is made by each kind of study.
#include "study/summary.hpp"

#include <algorithm>

namespace bemcal::study {

const Summary* find_summary(const std::vector<Summary>& summaries,
                            const std::string& study, const std::string& building) {
    const Summary* of_all = nullptr;
    for (const Summary& summary : summaries) {
        if (summary.study != study) continue;
        if (summary.building == building) return &summary;
        if (summary.building.empty()) of_all = &summary;
    }
    return of_all;
}

const FoundValue* find_value(const Summary& summary, const std::string& name) {
    const auto found = std::ranges::find(summary.values, name, &FoundValue::name);
    return found == summary.values.end() ? nullptr : &*found;
}

}  // namespace bemcal::study
