/// A fit to data that the model itself made, of unknowns drawn from their priors.
#pragma once

#include "sampling/normal.hpp"
#include "study/points.hpp"
#include "study/posterior_density.hpp"
#include "study/posterior_results.hpp"
#include "support/rank_uniformity.hpp"

#include <cmath>
#include <limits>
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

struct SimulatedFit {
    std::vector<std::string> names;
    std::vector<int> ranks;  ///< of the truth among n_ranks draws, for each free unknown
};

class FitOfSimulatedData {
  public:
    /// The case has meters without readings.
    FitOfSimulatedData(study::Case described, study::PosteriorOptions options)
        : case_(std::move(described)), options_(std::move(options)) {
        for (const study::Meter& meter : case_.meters)
            choice_.names.push_back(meter.name);
        choice_.residuals = options_.residuals;
        choice_.scales = study::nominal_scales(model());
    }

    SimulatedFit run(std::uint64_t seed, int n_draws, int n_ranks) const {
        Stream random(seed, 1, 0);
        const auto space = study::space_of(model());
        const std::vector<double> truth = space->draw_position(random);
        auto parts = std::make_shared<study::PosteriorParts>();
        parts->buildings.push_back(with_data(*space, truth, random));
        parts->space = space;
        parts->arrangement = study::make_arrangement(study::Pooling::none, space, {});
        return ranked(*space, truth, draws_of(parts, seed, n_draws), n_ranks);
    }

  private:
    std::unique_ptr<study::BuildingModel> with_data(const study::Space& space,
                                                    const std::vector<double>& truth,
                                                    Stream& random) const {
        std::vector<double> values(space.size());
        space.read(truth, values);
        Matrix point(1, case_.parameters.size());
        std::copy_n(values.begin(), point.cols, point.values.begin());
        const study::BuildingModel empty = model();
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
        return std::make_unique<study::BuildingModel>(filled, filled.periods[0], choice_);
    }

    /// [draws x dimension], the chains' draws taken in turn.
    Matrix draws_of(const std::shared_ptr<study::PosteriorParts>& parts,
                    std::uint64_t seed, int n_draws) const {
        const auto density = study::make_posterior_density(parts);
        std::vector<sampling::ChainTask> tasks;
        for (int c = 0; c < options_.chains.n_chains; ++c)
            tasks.push_back({seed, static_cast<std::uint32_t>(c), 0, {}});
        const auto warm =
            sampling::run_chains(*density, options_.chains.sampler, tasks, 0);
        for (std::size_t c = 0; c < tasks.size(); ++c) {
            tasks[c].round = 1;
            tasks[c].state = warm[c].state;
        }
        const auto parts_of_chains =
            sampling::run_chains(*density, options_.chains.sampler, tasks, n_draws);
        Matrix all(tasks.size() * static_cast<std::size_t>(n_draws),
                   density->dimension());
        for (std::size_t d = 0; d < static_cast<std::size_t>(n_draws); ++d)
            for (std::size_t c = 0; c < tasks.size(); ++c)
                std::ranges::copy(parts_of_chains[c].draws.row(d),
                                  all.row(d * tasks.size() + c).begin());
        return all;
    }

    static SimulatedFit ranked(const study::Space& space,
                               const std::vector<double>& truth, const Matrix& draws,
                               int n_ranks) {
        SimulatedFit fit;
        for (std::size_t f = 0; f < space.n_free(); ++f) {
            std::vector<double> column(draws.rows);
            for (std::size_t r = 0; r < draws.rows; ++r) column[r] = draws(r, f);
            fit.names.push_back(space.coordinates()[space.index_of(f)].name);
            fit.ranks.push_back(rank_of(truth[f], column, n_ranks));
        }
        return fit;
    }

    study::BuildingModel model() const {
        return study::BuildingModel(case_, case_.periods[0], choice_);
    }

    study::Case case_;
    study::PosteriorOptions options_;
    study::MeterChoice choice_;
};

}  // namespace bemcal::test
