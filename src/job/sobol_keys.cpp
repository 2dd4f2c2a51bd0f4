/// Reads what studies of Sobol indices have in common: the design and the intervals.
/// Source: paper 1, step 1.
/// What is simulated is each kind's own.
#include "job/sobol_keys.hpp"

namespace bemcal::job {

void read_design(const schema::Section& section,
                 sensitivity::SensitivityOptions& options) {
    options.n_base = static_cast<std::size_t>(section.integer("n_base"));
    options.scramble = section.flag("scramble");
}

void read_indices(const schema::Section& section,
                  sensitivity::SensitivityOptions& options) {
    options.n_bootstrap = static_cast<int>(section.integer("n_bootstrap"));
    options.threshold = section.number("threshold");
}

}  // namespace bemcal::job
