/// The list of distinct planes: a plane that is there already is shared, so that its
/// irradiance is computed once.
/// Plain bookkeeping without a source. Only planes that are exactly equal are shared; the
/// search is linear.
#include "physics/building.hpp"

#include <algorithm>

namespace bemcal::physics {

int Building::plane_index(const Plane& plane) {
    const auto found = std::find(planes.begin(), planes.end(), plane);
    if (found != planes.end()) return static_cast<int>(found - planes.begin());
    planes.push_back(plane);
    return static_cast<int>(planes.size()) - 1;
}

}  // namespace bemcal::physics
