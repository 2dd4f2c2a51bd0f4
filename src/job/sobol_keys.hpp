/// Keys of the kinds that estimate Sobol indices, and their readers.
#pragma once

#include "schema/section.hpp"
#include "sensitivity/sensitivity.hpp"

namespace bemcal::job {

/// Of every design.
inline constexpr schema::Key design_keys[] = {
    {"study", "n_base", schema::Type::integer, "", "1024", 2, 1 << 24,
     "Base points N of Saltelli's N (d + 2); a power of two is best. Of "
     "hourly_sensitivity at least 64."},
    {"study", "scramble", schema::Type::flag, "", "true", 0, 0, "Of the Sobol sequence."},
};
/// Of indices of single numbers.
inline constexpr schema::Key index_keys[] = {
    {"study", "n_bootstrap", schema::Type::integer, "", "1000", 0, 100000,
     "For the intervals."},
    {"study", "threshold", schema::Type::number, "-", "0.05", 0, 1,
     "Total-order index above which an input counts as sensitive."},
};

void read_design(const schema::Section& section,
                 sensitivity::SensitivityOptions& options);
void read_indices(const schema::Section& section,
                  sensitivity::SensitivityOptions& options);

}  // namespace bemcal::job
