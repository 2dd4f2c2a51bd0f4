/// Makes a Kennedy-O'Hagan calibration a posterior for chains: inputs scaled to their
/// priors' ranges, the form of the covariance, names and units of unknowns.
/// Source: Kennedy and O'Hagan 2001; paper 1, eq. 3-13.
/// Leaves out the density (`KohDensity`), dense covariances over 10,000 rows, and
/// lognormal and gamma priors unless normalised.
#include "posterior/koh_posterior.hpp"

#include "emulator/grid.hpp"
#include "posterior/koh_results.hpp"
#include "posterior/validation_results.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace bemcal::posterior {
namespace {

using emulator::KohDensity;
using stats::PriorKind;

/// Rows of a dense covariance: 0.8 GB for each chain that runs.
constexpr std::size_t most_dense_rows = 10000;
/// Of a gradient, for each product of two numbers in its eliminations [s].
constexpr double multiplication_s = 2e-10;

/// The calibrated inputs from 0 to 1 over their priors' ranges, not over the design's.
emulator::Standardised standardised(const KohOptions& options) {
    emulator::Standardised made = emulator::standardise(options.observations);
    for (std::size_t k = 0; k < made.t.size(); ++k) {
        const stats::Prior& prior = options.calibrated.at(k).prior;
        made.t[k] = {prior.least, prior.most - prior.least};
    }
    made.data.simulated_t =
        emulator::scaled_rows(options.observations.simulated_t, made.t);
    return made;
}

emulator::ModelOptions model_of(const KohOptions& options) {
    emulator::ModelOptions model = options.model;
    model.form = options.form == KohForm::dense ? emulator::Form::dense
                                                : emulator::Form::kronecker_if_grid;
    model.priors.t.clear();
    for (const study::Coordinate& calibrated : options.calibrated)
        model.priors.t.push_back(on_unit_scale(calibrated.prior));
    return model;
}

/// What decides the form is known before the first covariance is made.
void check_form(const KohOptions& options, const emulator::Standardised& data) {
    const bool is_grid = emulator::find_grid(data.data).has_value();
    const std::size_t rows = data.data.simulated.size() + data.data.measured.size();
    if (options.form == KohForm::kronecker && !is_grid)
        throw std::invalid_argument(
            "the runs are no full grid (every design at every point, measurements at "
            "those points), so their covariance is no Kronecker product; expected "
            "\"auto\" or \"dense\"");
    if ((options.form == KohForm::dense || !is_grid) && rows > most_dense_rows)
        throw std::invalid_argument(
            fmt::format("{} runs and measurements need a dense covariance of that size; "
                        "expected at most {}, or runs on a full grid",
                        rows, most_dense_rows));
}

class KohPosterior : public Posterior {
  public:
    explicit KohPosterior(KohOptions options)
        : options_(std::move(options)),
          data_(standardised(options_)),
          model_(model_of(options_)) {
        check_form(options_, data_);
        density_ = std::make_unique<KohDensity>(data_, model_);
        name_unknowns();
    }

    const char* kind() const override { return koh_kind; }
    std::unique_ptr<sampling::Density> make_density() const override {
        return std::make_unique<KohDensity>(data_, model_);
    }
    const std::vector<Unknown>& unknowns() const override { return unknowns_; }
    void read(std::span<const double> position, std::span<double> values) const override {
        std::ranges::copy(density_->values(position), values.begin());
    }
    void conclude(const ChainDraws& draws, study::DatasetBuilder& datasets,
                  std::vector<study::Summary>&) const override {
        add_moves_of(draws, datasets);
        KohDensity density(data_, model_);
        add_koh_results(density, options_, draws, datasets);
    }

  private:
    void name_unknowns() {
        const std::vector<std::string> names = density_->names();
        for (std::size_t k = 0; k < names.size(); ++k) {
            const emulator::Coordinate& free = density_->coordinates().free()[k];
            study::Coordinate coordinate{names[k], "1", free.prior};
            if (free.role == emulator::Role::t)
                coordinate = options_.calibrated[free.argument];
            unknowns_.push_back({coordinate.name, coordinate.unit});
            coordinates_.push_back(std::move(coordinate));
        }
    }
    /// Coefficients with a flat prior cannot be compared with it.
    void add_moves_of(const ChainDraws& draws, study::DatasetBuilder& datasets) const {
        if (std::ranges::any_of(density_->coordinates().free(),
                                &emulator::Coordinate::is_flat))
            return;
        Matrix values(draws.positions.rows, unknowns_.size());
        for (std::size_t r = 0; r < values.rows; ++r)
            read(draws.positions.row(r), values.row(r));
        std::vector<ParameterMove> moves = moves_of(coordinates_, values);
        for (std::size_t k = 0; k < moves.size(); ++k)
            if (density_->coordinates().free()[k].role == emulator::Role::correlation &&
                moves[k].finding == Finding::at_edge && moves[k].posterior_mean > 0.5)
                moves[k].words = "hardly any dependence on this input";
        add_moves(moves, datasets);
    }

    KohOptions options_;
    emulator::Standardised data_;
    emulator::ModelOptions model_;
    std::unique_ptr<const KohDensity> density_;  ///< for names and scales only
    std::vector<study::Coordinate> coordinates_;
    std::vector<Unknown> unknowns_;
};

/// Multiplications of a gradient.
double gradient_size(const KohOptions& options) {
    const emulator::Standardised data = standardised(options);
    const auto cube = [](std::size_t n) {
        const auto x = static_cast<double>(n);
        return x * x * x;
    };
    const std::size_t n = data.data.measured.size(), m = data.data.simulated.size();
    const auto grid = emulator::find_grid(data.data);
    if (options.form == KohForm::dense || !grid) return cube(n + m);
    return 2 * cube(grid->t.rows) + 2 * cube(grid->x.rows) + cube(n);
}

}  // namespace

stats::Prior on_unit_scale(const stats::Prior& prior) {
    const double width = prior.most - prior.least;
    stats::Prior made = prior;
    made.least = 0;
    made.most = 1;
    switch (prior.kind) {
        case PriorKind::uniform:
            return {PriorKind::uniform, 0, 1, 0, 1, false};
        case PriorKind::fixed:
            made.a = (prior.a - prior.least) / width;
            return made;
        case PriorKind::beta:
            return made;
        default:
            break;
    }
    if (prior.is_normalised) return made;
    if (prior.kind != PriorKind::normal)
        throw std::invalid_argument(
            fmt::format("a {} prior is not known from 0 to 1; expected normalised = true",
                        stats::name_of(prior.kind)));
    made.a = (prior.a - prior.least) / width;
    made.b = prior.b / width;
    return made;
}

std::shared_ptr<const Posterior> make_koh_posterior(const KohOptions& options) {
    return std::make_shared<KohPosterior>(options);
}

std::unique_ptr<study::Stage> make_koh_stage(std::string name,
                                             const KohOptions& options) {
    return make_chain_stage(std::move(name), make_koh_posterior(options), options.chains);
}

double koh_seconds(const KohOptions& options) {
    const sampling::SamplerOptions& sampler = options.chains.sampler;
    const double transitions =
        sampler.n_warm_up + static_cast<double>(sampler.thin) * options.chains.most_draws;
    const auto dimension =
        static_cast<double>(make_koh_posterior(options)->make_density()->dimension());
    double evaluations = 1;
    if (sampler.method == sampling::Method::nuts) evaluations = 16;
    if (sampler.method == sampling::Method::gibbs) evaluations = dimension;
    return options.chains.n_chains * transitions * evaluations *
           static_cast<double>(sampler.inverse_temperatures.size()) *
           (1e-5 + gradient_size(options) * multiplication_s);
}

}  // namespace bemcal::posterior
