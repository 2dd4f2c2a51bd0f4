/// The log posterior density of one or several buildings' unknowns, for a sampler.
#pragma once

#include "posterior/arrangement.hpp"
#include "posterior/building_model.hpp"
#include "sampling/density.hpp"

#include <memory>
#include <vector>

namespace bemcal::posterior {

/// What a posterior is made of, shared by all threads. Each building's unknowns are its
/// parameters, then the residual parameters of its meters.
struct PosteriorParts {
    std::vector<std::unique_ptr<BuildingModel>> buildings;
    std::shared_ptr<const study::Space> space;
    std::unique_ptr<Arrangement> arrangement;
    double reading_weight = 1;  ///< power of the likelihood
    std::size_t n_errors = 0;   ///< of the response's own, the last of the parameters

    std::size_t n_parameters() const { return buildings.at(0)->n_parameters(); }
    /// Room for n points of a building.
    BuildingModel::Points make_points(std::size_t n) const;
    /// A building's position in its space, as row r of its points.
    void write_point(std::span<const double> own, std::size_t r,
                     BuildingModel::Points& points) const;
};

/// A building's unknowns with their priors.
std::shared_ptr<const study::Space> space_of(const BuildingModel& model);

std::unique_ptr<sampling::Density> make_posterior_density(
    std::shared_ptr<const PosteriorParts> parts);

}  // namespace bemcal::posterior
