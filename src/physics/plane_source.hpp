/// Irradiance on planes that somebody has computed already.
#pragma once

#include "physics/sky.hpp"

#include <memory>
#include <vector>

namespace bemcal::physics {

/// Belongs to one weather; many buildings that share it ask for the same planes.
class PlaneSource {
  public:
    using Series = std::shared_ptr<const std::vector<double>>;
    virtual ~PlaneSource() = default;
    /// irradiance_series of the whole weather [W/m2]; called by several threads.
    virtual Series series(const Plane& plane, SkyModel sky) = 0;
};

}  // namespace bemcal::physics
