/// Computes the log density of unknowns for a sampler, with gradients: of each building's
/// own part of a position the prior and the likelihood, by the chain rule through the
/// transforms.
/// Source: Miller and Dunson 2019 for the likelihood's power.
/// Transforms are in `space`, simulation and residuals in `building_model`.
#include "posterior/posterior_density.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bemcal::posterior {
namespace {

class PosteriorDensity : public sampling::Density {
  public:
    explicit PosteriorDensity(std::shared_ptr<const PosteriorParts> parts)
        : parts_(std::move(parts)), own_(parts_->space->n_free()) {
        for (const auto& building : parts_->buildings)
            works_.push_back(building->make_work());
    }

    std::size_t dimension() const override { return parts_->arrangement->dimension(); }
    std::vector<int> levels() const override { return parts_->arrangement->levels(); }
    std::vector<char> held_in_climb() const override {
        return parts_->arrangement->held_in_climb();
    }
    std::size_t width() const override {
        return static_cast<std::size_t>(parts_->buildings.at(0)->lanes());
    }
    std::vector<double> draw_start(Stream& random) const override {
        return parts_->arrangement->draw_start(random);
    }
    void evaluate(const Matrix& points, bool gradients,
                  sampling::Evaluations& out) override;

  private:
    void write_points(const Matrix& positions, std::size_t building);
    void add_gradients(const Matrix& positions, std::size_t building,
                       sampling::Evaluations& out);

    std::shared_ptr<const PosteriorParts> parts_;
    std::vector<BuildingModel::Work> works_;  ///< [buildings]
    BuildingModel::Points points_;
    BuildingModel::Likelihood likelihood_;
    std::vector<double> own_;
};

void PosteriorDensity::write_points(const Matrix& positions, std::size_t building) {
    points_ = parts_->make_points(positions.rows);
    for (std::size_t r = 0; r < positions.rows; ++r) {
        parts_->arrangement->take(positions.row(r), building, own_);
        parts_->write_point(own_, r, points_);
    }
}

void PosteriorDensity::add_gradients(const Matrix& positions, std::size_t building,
                                     sampling::Evaluations& out) {
    const std::size_t n = parts_->n_parameters();
    std::vector<double> by_value(parts_->space->size()), gradient(own_.size());
    for (std::size_t r = 0; r < positions.rows; ++r) {
        for (std::size_t k = 0; k < by_value.size(); ++k)
            by_value[k] =
                parts_->reading_weight * (k < n ? likelihood_.by_parameter(r, k)
                                                : likelihood_.by_residual(r, k - n));
        parts_->arrangement->take(positions.row(r), building, own_);
        parts_->space->pull_back(own_, by_value, gradient);
        parts_->arrangement->give(gradient, building, out.likelihood_gradient.row(r));
    }
}

void PosteriorDensity::evaluate(const Matrix& points, bool gradients,
                                sampling::Evaluations& out) {
    out.prior.assign(points.rows, 0);
    out.likelihood.assign(points.rows, 0);
    out.prior_gradient = Matrix(points.rows, dimension());
    out.likelihood_gradient = Matrix(points.rows, dimension());
    for (std::size_t r = 0; r < points.rows; ++r)
        out.prior[r] =
            parts_->arrangement->log_prior(points.row(r), out.prior_gradient.row(r));
    for (std::size_t b = 0; b < parts_->buildings.size(); ++b) {
        write_points(points, b);
        parts_->buildings[b]->evaluate(points_, gradients, likelihood_, works_[b]);
        for (std::size_t r = 0; r < points.rows; ++r)
            out.likelihood[r] += parts_->reading_weight * likelihood_.value[r];
        if (gradients) add_gradients(points, b, out);
    }
}

}  // namespace

BuildingModel::Points PosteriorParts::make_points(std::size_t n) const {
    return {Matrix(n, n_parameters()), Matrix(n, space->size() - n_parameters())};
}

void PosteriorParts::write_point(std::span<const double> own, std::size_t r,
                                 BuildingModel::Points& points) const {
    std::vector<double> values(space->size());
    space->read(own, values);
    std::copy_n(values.begin(), n_parameters(), points.parameters.row(r).begin());
    std::copy(values.begin() + static_cast<std::ptrdiff_t>(n_parameters()), values.end(),
              points.residuals.row(r).begin());
}

std::shared_ptr<const study::Space> space_of(const BuildingModel& model) {
    std::vector<study::Coordinate> coordinates;
    const auto priors = study::priors_of(model.building());
    for (std::size_t k = 0; k < model.n_parameters(); ++k) {
        const physics::Parameter& parameter = model.building().parameters[k];
        coordinates.push_back({parameter.name, parameter.unit, priors[k].prior,
                               priors[k].values, priors[k].in, 1, priors[k].step});
    }
    for (const MeterModel& meter : model.meters())
        coordinates.insert(coordinates.end(), meter.unknowns.begin(),
                           meter.unknowns.end());
    return std::make_shared<const study::Space>(std::move(coordinates));
}

std::unique_ptr<sampling::Density> make_posterior_density(
    std::shared_ptr<const PosteriorParts> parts) {
    return std::make_unique<PosteriorDensity>(std::move(parts));
}

}  // namespace bemcal::posterior
