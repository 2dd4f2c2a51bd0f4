/// A fit to data that the model itself made, of unknowns drawn from their priors.
#pragma once

#include "posterior/centring.hpp"
#include "posterior/posterior_density.hpp"
#include "posterior/posterior_results.hpp"
#include "sampling/normal.hpp"
#include "study/points.hpp"
#include "support/ranked_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace bemcal::test {

/// An hourly meter over the case's first period, without readings.
inline study::Meter empty_meter(const study::Case& building, physics::Quantity quantity) {
    study::Meter meter;
    meter.name = physics::name_of(quantity);
    meter.quantity = quantity;
    meter.axis = study::axis_of(building, building.periods[0]);
    meter.values.assign(static_cast<std::size_t>(meter.axis.n_steps),
                        std::numeric_limits<double>::quiet_NaN());
    return meter;
}

/// Of a building that is alone, with all unknowns in their own units.
inline std::shared_ptr<posterior::PosteriorParts> parts_of(
    std::unique_ptr<posterior::BuildingModel> model, double reading_weight = 1) {
    auto parts = std::make_shared<posterior::PosteriorParts>();
    parts->space = posterior::space_of(*model);
    parts->arrangement =
        posterior::make_arrangement(posterior::Pooling::none, parts->space, {});
    parts->reading_weight = reading_weight;
    parts->buildings.push_back(std::move(model));
    return parts;
}

class FitOfSimulatedData {
  public:
    /// The case has meters without readings.
    FitOfSimulatedData(study::Case described, posterior::PosteriorOptions options)
        : case_(std::move(described)), options_(std::move(options)) {
        for (const study::Meter& meter : case_.meters)
            choice_.names.push_back(meter.name);
        choice_.residuals = options_.residuals;
        choice_.scales = posterior::nominal_scales(model());
    }

    SimulatedFit run(std::uint64_t seed, int n_draws, int n_ranks) const {
        Stream random(seed, 1, 0);
        const auto space = posterior::space_of(model());
        const std::vector<double> truth = space->draw_position(random);
        const auto parts = parts_of(with_data(*space, truth, random));
        posterior::centre(parts);
        const auto density = posterior::make_posterior_density(parts);
        Matrix draws = draws_of(*density, options_.chains.sampler,
                                {seed, options_.chains.n_chains, n_draws});
        for (std::size_t r = 0; r < draws.rows; ++r)
            std::ranges::copy(values_at(*parts->space, draws.row(r)),
                              draws.row(r).begin());
        return ranked(names_of(*space), values_at(*space, truth), draws, n_ranks);
    }

  private:
    /// Of the free ones. [n_free]
    static std::vector<double> values_at(const study::Space& space,
                                         std::span<const double> position) {
        std::vector<double> all(space.size()), free;
        space.read(position, all);
        for (std::size_t f = 0; f < space.n_free(); ++f)
            free.push_back(all[space.index_of(f)]);
        return free;
    }
    std::unique_ptr<posterior::BuildingModel> with_data(const study::Space& space,
                                                        const std::vector<double>& truth,
                                                        Stream& random) const {
        std::vector<double> values(space.size());
        space.read(truth, values);
        Matrix point(1, case_.parameters.size());
        std::copy_n(values.begin(), point.cols, point.values.begin());
        const posterior::BuildingModel empty = model();
        study::Case filled = case_;
        std::size_t first = point.cols;
        const auto predictions = empty.predict(point);
        for (std::size_t m = 0; m < predictions.size(); ++m) {
            const auto& meter = empty.meters()[m];
            std::vector<double> normals(meter.residuals.n_normals());
            sampling::fill_standard_normal(random, normals);
            filled.meters[m].values = meter.residuals.draw(
                predictions[m].row(0),
                std::span(values).subspan(first, meter.unknowns.size()), normals);
            first += meter.unknowns.size();
        }
        return std::make_unique<posterior::BuildingModel>(filled, filled.periods[0],
                                                          choice_);
    }

    static std::vector<std::string> names_of(const study::Space& space) {
        std::vector<std::string> names;
        for (std::size_t f = 0; f < space.n_free(); ++f)
            names.push_back(space.coordinates()[space.index_of(f)].name);
        return names;
    }

    posterior::BuildingModel model() const {
        return posterior::BuildingModel(case_, case_.periods[0], choice_);
    }

    study::Case case_;
    posterior::PosteriorOptions options_;
    posterior::MeterChoice choice_;
};

}  // namespace bemcal::test
