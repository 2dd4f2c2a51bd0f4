/// Puts together a calibration by MCMC of the simulator itself: buildings that train,
/// those that are predicted only, what they share, and what follows from the draws.
/// Follows from `posterior_density`, `arrangement` and `chain_stage`.
/// NUTS needs buildings with derivatives; pooling needs the same parameters and meters.
/// Predictions are in `posterior_results`.
#include "posterior/posterior.hpp"

#include "kernel/response.hpp"
#include "posterior/centring.hpp"
#include "posterior/chain_stage.hpp"
#include "posterior/function_results.hpp"
#include "posterior/posterior_density.hpp"
#include "posterior/posterior_results.hpp"
#include "posterior/validation_results.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

/// Buildings of one posterior measure their noise by what their descriptions predict,
/// which is known of unseen ones too.
std::unique_ptr<BuildingModel> model_of(const study::Case& building,
                                        const study::Period& period, MeterChoice choice,
                                        const PosteriorOptions& options,
                                        std::shared_ptr<const ResponseSource> source) {
    auto model =
        std::make_unique<BuildingModel>(building, period, choice, std::move(source));
    if (options.pooling == Pooling::none) return model;
    choice.scales = nominal_scales(*model);
    return std::make_unique<BuildingModel>(building, period, choice);
}

bool is_unseen(const study::Case& building, const PosteriorOptions& options) {
    return std::ranges::find(options.unseen, building.name) != options.unseen.end();
}

void check_alike(const BuildingModel& first, const BuildingModel& other) {
    const auto fail = [&](const std::string& what) {
        throw std::invalid_argument(
            fmt::format("{} and {} have other {}; a pooled posterior needs the same in "
                        "every building",
                        first.building().name, other.building().name, what));
    };
    const auto name = [](const auto& thing) { return thing.name; };
    if (!std::ranges::equal(first.building().parameters, other.building().parameters, {},
                            name, name))
        fail("parameters");
    if (!std::ranges::equal(first.meters(), other.meters(), {}, name, name))
        fail("meters");
}

std::shared_ptr<PosteriorParts> parts_of(
    const std::vector<study::Case>& buildings, const PosteriorOptions& options,
    const std::shared_ptr<const ResponseSource>& source) {
    auto parts = std::make_shared<PosteriorParts>();
    parts->n_errors = source->n_errors();
    std::vector<std::string> names;
    for (const study::Case& building : buildings) {
        if (is_unseen(building, options)) continue;
        const study::Period& period = training_period(building, options);
        parts->buildings.push_back(model_of(building, period,
                                            training_choice(building, period, options),
                                            options, source));
        names.push_back(building.name);
        if (parts->buildings.back()->meters().empty())
            throw std::invalid_argument(fmt::format("{}: no meter has a reading in {}",
                                                    building.name, period.name));
        check_alike(*parts->buildings[0], *parts->buildings.back());
    }
    if (parts->buildings.empty())
        throw std::invalid_argument(
            "all buildings are unseen: none is left to learn from");
    parts->space = space_of(*parts->buildings[0]);
    parts->arrangement = make_arrangement(options.pooling, parts->space, names);
    parts->reading_weight = options.reading_weight;
    centre(parts);
    return parts;
}

class DirectPosterior : public Posterior {
  public:
    /// \param functions  that parameters of the buildings sample
    DirectPosterior(const std::vector<study::Case>& buildings,
                    const PosteriorOptions& options,
                    const std::shared_ptr<const ResponseSource>& source,
                    std::vector<study::SampledFunction> functions = {})
        : parts_(parts_of(buildings, options, source)),
          options_(options),
          functions_(std::move(functions)) {
        for (const study::Case& building : buildings)
            if (is_unseen(building, options)) unseen_.push_back(building);
        drop_errors(parts_->arrangement->reported());
        for (const study::Coordinate& coordinate : reported_)
            unknowns_.push_back({coordinate.name, coordinate.unit});
    }

    const char* kind() const override { return "posterior"; }
    std::unique_ptr<sampling::Density> make_density() const override {
        return make_posterior_density(parts_);
    }
    const std::vector<Unknown>& unknowns() const override { return unknowns_; }
    void read(std::span<const double> position, std::span<double> values) const override {
        if (parts_->n_errors == 0) return parts_->arrangement->read(position, values);
        std::vector<double> all(values.size() + parts_->n_errors);
        parts_->arrangement->read(position, all);
        all.erase(all.begin() + first_error_, all.begin() + end_of_errors());
        std::ranges::copy(all, values.begin());
    }
    void conclude(const ChainDraws& draws, study::DatasetBuilder& datasets,
                  std::vector<study::Summary>& summaries) const override {
        Matrix values(draws.positions.rows, unknowns_.size());
        for (std::size_t r = 0; r < values.rows; ++r)
            read(draws.positions.row(r), values.row(r));
        add_moves(moves_of(reported_, values), datasets);
        summaries[0].points = points_of(values, of_all());
        add_functions(functions_, summaries[0].points, datasets);
        add_steps(draws.positions, summaries[0].points);
        for (std::size_t b = 0; b < n_apart(); ++b) {
            study::Summary own;
            own.study = summaries[0].study;
            own.building = parts_->buildings[b]->building().name;
            own.points = points_of(values, parts_->arrangement->reported_of(b));
            summaries.push_back(std::move(own));
        }
        auto predicted = add_predictions({*parts_, unseen_, options_}, draws, datasets);
        summaries[0].fits = std::move(predicted.fits);
        summaries[0].shortfall = std::move(predicted.bias);
    }

  private:
    /// Errors of the response are nobody's question. They are of one building that is
    /// alone, where all that is free is reported, the parameters first.
    void drop_errors(std::vector<study::Coordinate> all) {
        const study::Space& space = *parts_->space;
        const std::size_t first = parts_->n_parameters() - parts_->n_errors;
        for (std::size_t f = 0; f < space.n_free(); ++f)
            if (space.index_of(f) < first) ++first_error_;
        if (parts_->n_errors > 0)
            all.erase(all.begin() + first_error_, all.begin() + end_of_errors());
        reported_ = std::move(all);
    }
    std::ptrdiff_t end_of_errors() const {
        return first_error_ + static_cast<std::ptrdiff_t>(parts_->n_errors);
    }
    /// Buildings with unknowns of their own.
    std::size_t n_apart() const {
        return options_.pooling == Pooling::partial ? parts_->buildings.size() : 0;
    }
    /// Of what is the same for all buildings, or what they scatter around.
    std::vector<std::size_t> of_all() const {
        std::vector<std::size_t> all(parts_->space->n_free());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }
    /// The draws of the parameters among some of the reported. \param values  [draws x
    /// reported] \param reported  [n_free]
    study::FoundPoints points_of(const Matrix& values,
                                 const std::vector<std::size_t>& reported) const {
        study::FoundPoints points;
        std::vector<std::size_t> columns;
        const study::Space& space = *parts_->space;
        for (std::size_t f = 0; f < space.n_free(); ++f) {
            if (space.index_of(f) >= parts_->n_parameters() - parts_->n_errors) continue;
            points.parameters.push_back(space.coordinates()[space.index_of(f)].name);
            columns.push_back(reported[f]);
        }
        points.rows = Matrix(values.rows, columns.size());
        for (std::size_t r = 0; r < values.rows; ++r)
            for (std::size_t c = 0; c < columns.size(); ++c)
                points.rows(r, c) = values(r, columns[c]);
        return points;
    }
    /// And what follows from draws of a step's moment: its share of each day.
    void add_steps(const Matrix& positions, study::FoundPoints& points) const {
        const study::Space& space = *parts_->space;
        std::vector<std::size_t> days;
        for (std::size_t k = 0; k < space.size(); ++k)
            if (space.coordinates()[k].step) days.push_back(k);
        if (days.empty()) return;
        Matrix rows(positions.rows, points.rows.cols + days.size());
        std::vector<double> all(space.size());
        for (std::size_t r = 0; r < rows.rows; ++r) {
            space.read(positions.row(r), all);
            const auto to =
                std::ranges::copy(points.rows.row(r), rows.row(r).begin()).out;
            std::ranges::transform(days, to, [&](std::size_t k) { return all[k]; });
        }
        for (const std::size_t k : days)
            points.parameters.push_back(space.coordinates()[k].name);
        points.rows = std::move(rows);
    }

    std::shared_ptr<const PosteriorParts> parts_;
    PosteriorOptions options_;
    std::vector<study::SampledFunction> functions_;
    std::vector<study::Case> unseen_;
    std::vector<study::Coordinate> reported_;  ///< without the response's errors
    std::ptrdiff_t first_error_ = 0;           ///< in what the arrangement reports
    std::vector<Unknown> unknowns_;
};

/// Parameters that are not named stay nominal.
study::Case with_others_fixed(study::Case building,
                              const std::vector<std::string>& names) {
    if (names.empty()) return building;
    building.priors = study::priors_of(building);
    for (std::size_t k = 0; k < building.parameters.size(); ++k) {
        const physics::Parameter& parameter = building.parameters[k];
        if (std::ranges::find(names, parameter.name) != names.end()) continue;
        building.priors[k] = {};
        building.priors[k].prior = stats::fixed_prior(parameter.nominal);
    }
    return building;
}

void check_differentiable(const std::vector<study::Case>& buildings,
                          const PosteriorOptions& options) {
    if (options.chains.sampler.method != sampling::Method::nuts) return;
    for (const study::Case& building : buildings)
        if (!kernel::has_derivatives(building.building))
            throw std::invalid_argument(
                building.name +
                " has coupled zones, a radiator or linked numbers, which have no "
                "derivatives; choose sampler = \"random_walk\" or \"gibbs\"");
}

}  // namespace

std::unique_ptr<study::Stage> make_posterior(std::string name,
                                             const std::vector<study::Case>& buildings,
                                             const PosteriorOptions& options) {
    check_differentiable(buildings, options);
    std::vector<study::Case> calibrated;
    std::vector<study::SampledFunction> functions;
    for (const study::Case& building : buildings) {
        study::Case own = with_others_fixed(building, options.parameters);
        if (options.pooling == Pooling::none)
            own =
                study::with_sampled_shapes(own, training_period(own, options), functions);
        else if (study::has_sampled_shapes(own))
            throw std::invalid_argument(
                own.name +
                " has an effect with spread or since_within, which is of one building "
                "alone; expected pooling = \"none\"");
        calibrated.push_back(std::move(own));
    }
    return make_chain_stage(
        std::move(name),
        std::make_shared<DirectPosterior>(calibrated, options, own_model(), functions),
        options.chains);
}

std::shared_ptr<const Posterior> make_posterior_through(
    const std::shared_ptr<const ResponseSource>& source, const study::Case& building,
    const PosteriorOptions& options) {
    return std::make_shared<DirectPosterior>(std::vector{building}, options, source);
}

}  // namespace bemcal::posterior
