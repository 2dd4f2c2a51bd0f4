/// The list of distinct planes, which surfaces and windows share.
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
