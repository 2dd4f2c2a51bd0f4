/// Which parameters a residual model has by its options, their names, and whether they
/// are in range.
/// Plain bookkeeping without a source. Priors are left to the callers.
#include "stats/residual_model_parameters.hpp"

namespace bemcal::stats {

std::vector<std::string> residual_parameters(const ResidualOptions& options) {
    static constexpr std::array names{"constant", "proportional", "phi", "share",
                                      "timescale"};
    std::vector<std::string> list;
    list.reserve(names.size());
    for (const auto parameter : residual::parameters_of(options))
        list.emplace_back(names[parameter]);
    return list;
}

namespace residual {

std::vector<Parameter> parameters_of(const ResidualOptions& options) {
    std::vector<Parameter> list{constant, proportional};
    if (options.autocorrelated) list.push_back(phi);
    if (options.discrepancy) list.insert(list.end(), {share, timescale});
    return list;
}

Eigen::Array<bool, width, 1> are_in_range(const ParameterLanes& p) {
    return p[phi] >= 0 && p[phi] < 1 && p[share] >= 0 && p[share] <= 1 &&
           p[timescale] > 0;
}

}  // namespace residual

}  // namespace bemcal::stats
