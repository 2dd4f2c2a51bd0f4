/// The words for methods and statistics, in the order of their enums.
/// ArviZ's names where it has them (acceptance_rate, tree_depth, diverging). Plain
/// tables: a new enumerator needs its word here.
#include "sampling/chain.hpp"

namespace bemcal::sampling {

const char* name_of(Method method) {
    constexpr const char* names[] = {"nuts", "random_walk", "gibbs"};
    return names[static_cast<int>(method)];
}

const char* name_of(Statistic statistic) {
    constexpr const char* names[n_statistics] = {
        "log_prior", "log_likelihood", "acceptance_rate", "step_size",
        "n_steps",   "tree_depth",     "diverging",       "swap_rate"};
    return names[static_cast<int>(statistic)];
}

bool climbs_first(const SamplerOptions& options) {
    return options.climbs && options.method == Method::nuts &&
           options.inverse_temperatures.size() == 1;
}

}  // namespace bemcal::sampling
