/// Which profiles inputs follow: what makes regimes, rows and drivers of a plan.
#pragma once

#include "physics/parameters.hpp"

#include <vector>

namespace bemcal::kernel {

/// Adds all that the input follows and is not there yet.
void add_profiles(std::vector<int>& profiles, const physics::Input& input);

/// Profiles of inputs that enter linearly.
struct LinearProfiles {
    std::vector<int> alone;   ///< may be drivers
    std::vector<int> tabled;  ///< meet another one as a factor, somewhere
    void add(const physics::Input& input);
    /// Those that may be drivers after all are added.
    std::vector<int> drivers() const;
};

/// Whether the input is or may become anything but 0.
bool is_active(const physics::Input& input);

/// Calls visit with the nominal building and the ones at both ends of all parameters'
/// ranges.
template <class Visit>
void at_range_ends(const physics::Building& nominal,
                   const std::vector<physics::Parameter>& parameters, Visit visit) {
    visit(nominal);
    physics::Building building = nominal;
    std::vector<double> point(parameters.size());
    for (double physics::Parameter::* end :
         {&physics::Parameter::least, &physics::Parameter::most}) {
        for (std::size_t p = 0; p < point.size(); ++p) point[p] = parameters[p].*end;
        physics::apply(nominal, parameters, point, building);
        visit(building);
    }
}

}  // namespace bemcal::kernel
