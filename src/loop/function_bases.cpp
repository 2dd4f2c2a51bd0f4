/// Makes a basis of each driver, by the kind of its points.
/// Follows from `functions` and from `effects`, which has the drivers.
#include "loop/function_bases.hpp"

namespace bemcal::loop {
namespace {

using functions::Points;

functions::Basis basis_of(const std::string& driver,
                          const std::vector<std::vector<double>>& series, double day) {
    switch (effects::points_of_driver(driver)) {
        case Points::Kind::one:
            return functions::constant();
        case Points::Kind::hours:
            return functions::hours_of_week(driver, series[0]);
        case Points::Kind::hours_from:
            return functions::hours_from(driver, series[0], series[1], day);
        case Points::Kind::hours_at_knots:
            return functions::hours_times(driver, series[0], series[1]);
        case Points::Kind::fortnights:
            return functions::wandering(driver, series[0]);
        default:
            return functions::smooth_of(driver, series[0]);
    }
}

}  // namespace

std::vector<std::vector<double>> of_period(std::vector<std::vector<double>> all,
                                           const physics::Drive& drive) {
    for (std::vector<double>& series : all)
        series.erase(series.begin(), series.begin() + drive.n_warm_up);
    return all;
}

std::vector<functions::Basis> bases_of(const effects::FunctionDrivers& training,
                                       const physics::Drive& drive,
                                       std::optional<double> day) {
    std::vector<functions::Basis> bases;
    bases.reserve(training.size());
    for (const auto& [driver, series] : training) {
        if (effects::points_of_driver(driver) == Points::Kind::hours_from && !day)
            continue;
        bases.push_back(basis_of(driver, of_period(series, drive), day.value_or(0)));
    }
    return bases;
}

}  // namespace bemcal::loop
